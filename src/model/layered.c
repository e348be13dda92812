/* The layered model: a coat over a base, each a material of its own (Xing et al. 2024, section 6.4).
 *
 * f = f_base (1 - w (1 - T)) + w f_coat (Eq. 10), w the share of the surface that the coat covers and T what the coat
 * lets through, in at one angle and out at the other, in the frame of the coat:
 *
 *     T(wo, wi) = min(t(wo), t(wi), t(wo) t(wi) / t(n)),    t = 1 - R.
 *
 * Head-on this is the paper's 1 - F. It is symmetric, so that two reciprocal layers with one normal stay reciprocal. It
 * is at most t(wo), so that the sum gives no more light than came in, provided that R is at least what the coat
 * reflects: see layered_coat.c.
 */
#include "math/uniform.h"
#include "model/area.h"
#include "model/layered_coat.h"
#include "model/lobe.h"

enum { CHUNK = 64 }; /* queries handed to the layers at a time */

/* What is baked. */
typedef struct layered {
    glint_coat own; /* where a call brings none */
    float slant;    /* see coat_measured_slant */
} layered;

/* Both layers at one point. */
typedef struct point {
    model_query base, coat;
    vec3 x, y, z;             /* frame of the coat, in that of the base */
    float weight, slant;      /* of the coat */
    float out[3];             /* t(wo) */
    int base_seen, coat_seen; /* from wo */
    int base_lit, coat_lit;   /* from wi too */
} point;

/* 1 - w (1 - T): what is left of the base. */
static void find_kept(const point *p, float kept[3])
{
    kept[0] = kept[1] = kept[2] = 1.0F;
    if (!(p->weight > 0.0F))
        return;
    float in[3], straight[3]; /* t(wi), t(n) */
    coat_transmit(&p->coat, p->slant, p->coat.wi.z, in);
    coat_transmit(&p->coat, p->slant, 1.0F, straight);
    for (int c = 0; c < 3; c++) {
        const float least = in[c] < p->out[c] ? in[c] : p->out[c];
        const float both = straight[c] > 0.0F ? in[c] * p->out[c] / straight[c] : 0.0F;
        kept[c] = 1.0F - p->weight * (1.0F - (both < least ? both : least));
    }
}

/* ---- a point and its layers ---- */

/* A tangent that lies along the normal gives way to any other. */
static void set_frame(point *p, const glint_coat *coat)
{
    p->z = vec3_normalize(vec3_from(coat->normal));
    const vec3 along = vec3_from(coat->tangent);
    p->x = vec3_normalize(vec3_add(along, vec3_scale(p->z, -vec3_dot(along, p->z))));
    if (!(vec3_dot(p->x, p->x) > 0.5F)) {
        const vec3 other = fabsf(p->z.x) < 0.7F ? (vec3){ 1.0F, 0.0F, 0.0F } : (vec3){ 0.0F, 1.0F, 0.0F };
        p->x = vec3_normalize(vec3_add(other, vec3_scale(p->z, -vec3_dot(other, p->z))));
    }
    p->y = vec3_cross(p->z, p->x);
}

static vec3 to_coat(const point *p, vec3 v)
{
    return (vec3){ vec3_dot(v, p->x), vec3_dot(v, p->y), vec3_dot(v, p->z) };
}

/* All but wi. */
static void find_point(const model_query *q, point *p)
{
    const struct glint_material *material = q->material;
    const layered *l = material->baked;
    const glint_coat *coat = q->surface->coat ? q->surface->coat : &l->own;
    p->base = p->coat = *q;
    p->base.material = material->base;
    p->coat.material = material->coat;
    p->coat.surface = &coat->surface;
    p->coat.total_area = coat == &l->own ? material->coat->total_area : 0.0F;
    if (coat->footprint)
        p->coat.footprint = coat->footprint;
    set_frame(p, coat);
    p->coat.wo = to_coat(p, q->wo);
    p->weight = coat->weight;
    p->base_seen = q->wo.z > 0.0F;
    p->coat_seen = p->coat.wo.z > 0.0F && p->weight > 0.0F;
    if (!(p->weight > 0.0F))
        return;
    p->slant = coat_slant(material->coat, l->slant, &coat->surface);
    coat_transmit(&p->coat, p->slant, p->coat.wo.z, p->out);
}

static void light_up(point *p, vec3 wi)
{
    p->base.wi = wi;
    p->coat.wi = to_coat(p, wi);
    p->base_lit = p->base_seen && wi.z > 0.0F;
    p->coat_lit = p->coat_seen && p->coat.wi.z > 0.0F;
}

/* N of both layers together, and p so that N p is the facets of both that are expected to be lit. */
static void add_facets(const glint_value *base, const glint_value *coat, glint_value *value)
{
    const glint_value *one = coat->facet_count > 0.0F ? coat : base;
    value->facet_count = base->facet_count + coat->facet_count;
    value->lit_probability = one->lit_probability;
    if (base->facet_count > 0.0F && coat->facet_count > 0.0F) {
        const float share = base->facet_count / value->facet_count;
        const float p = share * base->lit_probability + (1.0F - share) * coat->lit_probability;
        value->lit_probability = p < 1.0F ? p : 1.0F;
    }
    value->over_limit = base->over_limit || coat->over_limit;
}

/* Eq. 10. The value of a layer that is not lit is zero. */
static void combine(const point *p, const glint_value *base, const glint_value *coat, glint_value *value)
{
    float kept[3];
    find_kept(p, kept);
    for (int c = 0; c < 3; c++) {
        value->rgb[c] = kept[c] * base->rgb[c] + p->weight * coat->rgb[c];
        value->smooth[c] = kept[c] * base->smooth[c] + p->weight * coat->smooth[c];
    }
    add_facets(base, coat, value);
}

/* What both layers give at a lit point. */
static void eval_point(const point *p, glint_value *value)
{
    glint_value base = { 0 }, coat = { 0 };
    if (p->base_lit)
        p->base.material->model->eval(&p->base, &base);
    if (p->coat_lit)
        p->coat.material->model->eval(&p->coat, &coat);
    combine(p, &base, &coat, value);
}

/* ---- contract ---- */

/* Each layer sees the light of real size in its own frame; turned: that of the coat, whose place is to be kept. What
 * the coat lets through hardly changes over the light: it is taken at the light's middle. */
static void light_up_by_area(point *p, const glint_area_light *light, glint_area_light *turned)
{
    area_light seen;
    *turned = area_turn(light, p->x, p->y, p->z);
    p->coat.area_light = turned;
    p->base_lit = p->base_seen;
    p->coat_lit = p->coat_seen;
    p->coat.wi = (vec3){ 0.0F, 0.0F, 1.0F };
    if (area_see(&p->coat, &seen) && area_measure(&seen))
        p->coat.wi = vec3d_narrow(seen.middle);
    else if (area_see(&p->base, &seen) && area_measure(&seen))
        p->coat.wi = to_coat(p, vec3d_narrow(seen.middle));
}

static void layered_eval(const model_query *q, glint_value *value)
{
    point p;
    glint_area_light turned;
    find_point(q, &p);
    if (q->area_light)
        light_up_by_area(&p, q->area_light, &turned);
    else
        light_up(&p, q->wi);
    eval_point(&p, value);
}

/* The queries of one layer at a time, those that are lit. */
typedef struct gathered {
    model_query query[CHUNK];
    glint_value value[CHUNK];
    size_t index[CHUNK], count;
} gathered;

static void gather(gathered *g, const model_query *q, size_t index)
{
    g->query[g->count] = *q;
    g->index[g->count++] = index;
}

static void eval_gathered(gathered *g, glint_value value[CHUNK])
{
    if (g->count > 0)
        g->query[0].material->model->eval_many(g->query, g->count, g->value);
    for (size_t i = 0; i < g->count; i++)
        value[g->index[i]] = g->value[i];
    g->count = 0;
}

/* At most CHUNK queries. */
static void eval_chunk(const model_query *q, size_t count, glint_value *value)
{
    point p[CHUNK];
    glint_area_light turned[CHUNK];
    gathered g = { .count = 0 };
    glint_value base[CHUNK] = { { { 0 }, { 0 }, 0, 0, 0 } }, coat[CHUNK] = { { { 0 }, { 0 }, 0, 0, 0 } };
    for (size_t i = 0; i < count; i++) {
        find_point(&q[i], &p[i]);
        if (q[i].area_light)
            light_up_by_area(&p[i], q[i].area_light, &turned[i]);
        else
            light_up(&p[i], q[i].wi);
        if (p[i].base_lit)
            gather(&g, &p[i].base, i);
    }
    eval_gathered(&g, base);
    for (size_t i = 0; i < count; i++)
        if (p[i].coat_lit)
            gather(&g, &p[i].coat, i);
    eval_gathered(&g, coat);
    for (size_t i = 0; i < count; i++)
        combine(&p[i], &base[i], &coat[i], &value[i]);
}

static void layered_eval_many(const model_query *q, size_t count, glint_value *value)
{
    for (size_t i = 0; i < count; i += CHUNK)
        eval_chunk(q + i, count - i < CHUNK ? count - i : CHUNK, value + i);
}

static void layered_transmittance(const model_query *q, int from_below, float rgb[3])
{
    point p;
    find_point(q, &p);
    if (!from_below) {
        light_up(&p, q->wi);
        find_kept(&p, rgb);
        return;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = p.weight > 0.0F ? 1.0F - p.weight * (1.0F - p.out[c]) : 1.0F;
}

/* ---- sampling ---- */

/* As find_point. A footprint is for both layers or for none; then any light asks for the f that is sampled. */
static void find_sampled_point(const model_query *q, point *p)
{
    find_point(q, p);
    const int known = (q->material->features & GLINT_FEATURE_SAMPLE_FOOTPRINT) != 0;
    if (!known)
        p->base.footprint = p->coat.footprint = NULL;
    p->base.solid_angle_sr = p->coat.solid_angle_sr = known ? 1.0F : 0.0F;
}

/* A guess of what a layer reflects; zero for black alone, since facets that face the light askew may reflect where one
 * that faces the viewer does not. */
static float reflected(const model_query *q, int channel)
{
    const float facing = lobe_facet_reflectance(q, channel, q->wo.z < 1.0F ? q->wo.z : 1.0F);
    const float grazing = lobe_facet_reflectance(q, channel, 0.0F);
    const float facets = q->material->options.coverage * (facing > 0.0F ? facing : 0.01F * grazing);
    return facets + (1.0F - facets) * q->surface->diffuse[channel];
}

/* Chance that sampling takes the coat: its share of the light, at least a tenth for each as the guess knows nothing
 * about wi. */
static float coat_chance(const point *p)
{
    if (!p->coat_seen || !p->base_seen)
        return p->coat_seen ? 1.0F : 0.0F;
    float base = 0.0F, coat = 0.0F;
    for (int c = 0; c < 3; c++) {
        base += (1.0F - p->weight * (1.0F - p->out[c])) * reflected(&p->base, c);
        coat += p->weight * reflected(&p->coat, c);
    }
    if (!(base > 0.0F) || !(coat > 0.0F))
        return coat > 0.0F ? 1.0F : 0.0F;
    const float chance = coat / (base + coat);
    return chance < 0.1F ? 0.1F : chance > 0.9F ? 0.9F : chance;
}

static float pdf_of(const point *p, float chance)
{
    float pdf = 0.0F;
    if (p->base_lit && chance < 1.0F)
        pdf += (1.0F - chance) * p->base.material->model->pdf(&p->base);
    if (p->coat_lit && chance > 0.0F)
        pdf += chance * p->coat.material->model->pdf(&p->coat);
    return pdf;
}

static float layered_pdf(const model_query *q)
{
    point p;
    find_sampled_point(q, &p);
    light_up(&p, q->wi);
    return pdf_of(&p, coat_chance(&p));
}

/* A direction from one layer, in the frame of the base. 0: there is none. */
static int sample_layer(const point *p, int from_coat, const float random[3], vec3 *wi)
{
    const model_query *q = from_coat ? &p->coat : &p->base;
    glint_sample drawn;
    if (!(from_coat ? p->coat_seen : p->base_seen) || !q->material->model->sample(q, random, &drawn))
        return 0;
    *wi = vec3_from(drawn.wi);
    if (from_coat)
        *wi = vec3_normalize(vec3_add(vec3_add(vec3_scale(p->x, drawn.wi[0]), vec3_scale(p->y, drawn.wi[1])),
                                      vec3_scale(p->z, drawn.wi[2])));
    return 1;
}

static int layered_sample(const model_query *q, const float random[3], glint_sample *sample)
{
    point p;
    find_sampled_point(q, &p);
    /* Without a coat the base has its own way. */
    if (!(p.weight > 0.0F))
        return p.base_seen && p.base.material->model->sample(&p.base, random, sample);
    const float chance = coat_chance(&p);
    const int from_coat = random[0] < chance;
    const float u[3] = { from_coat ? uniform_within(random[0], 0.0F, chance) : uniform_within(random[0], chance, 1.0F),
                         random[1], random[2] };
    vec3 wi;
    if (!sample_layer(&p, from_coat, u, &wi))
        return 0;
    light_up(&p, wi);
    const float pdf = pdf_of(&p, chance);
    if (!(pdf > 0.0F))
        return 0;
    glint_value value;
    eval_point(&p, &value);
    *sample = (glint_sample){ { wi.x, wi.y, wi.z }, pdf, { 0.0F, 0.0F, 0.0F } };
    for (int c = 0; c < 3; c++)
        sample->weight[c] = value.rgb[c] / pdf;
    return 1;
}

/* ---- set-up ---- */

/* A feature of facets is there where one layer has it, one of evaluation where both have it. A layer without facets has
 * none that its sampling would not know. */
static uint32_t features_of(const struct glint_material *material)
{
    const uint32_t either = GLINT_FEATURE_DISCRETE | GLINT_FEATURE_COLOR, known = GLINT_FEATURE_SAMPLE_FOOTPRINT;
    const uint32_t base = material->base->features, coat = material->coat->features;
    const int base_known = (base & known) || !(base & GLINT_FEATURE_DISCRETE);
    const int coat_known = (coat & known) || !(coat & GLINT_FEATURE_DISCRETE);
    const uint32_t shared = (base & coat & ~known) | ((base | coat) & either);
    return base_known && coat_known ? shared | ((base | coat) & known) : shared;
}

static glint_result layered_setup(struct glint_material *material)
{
    const glint_allocator *a = &material->options.allocator;
    glint_layers *o = &material->options.layers;
    layered *l = a->allocate(sizeof(*l), a->user);
    if (!l)
        return GLINT_ERROR_MEMORY;
    *l = (layered){ .own = { .surface = material->coat->options.surface, .weight = o->coat_weight } };
    for (int i = 0; i < 3; i++) {
        l->own.normal[i] = o->coat_normal[i];
        l->own.tangent[i] = o->coat_tangent[i];
    }
    l->slant = coat_measured_slant(material->coat);
    material->baked = l;
    material->options.surface = material->base->options.surface;
    material->options.surface.coat = &l->own;
    material->total_area = material->base->total_area;
    material->features = features_of(material);
    o->base = o->coat = NULL; /* copied; the client may free them */
    return GLINT_OK;
}

static void layered_free(struct glint_material *material)
{
    material->options.allocator.release(material->baked, material->options.allocator.user);
}

const struct model layered_model = {
    .name = "layered",
    .features = GLINT_FEATURE_DISCRETE | GLINT_FEATURE_GGX | GLINT_FEATURE_BECKMANN | GLINT_FEATURE_ANISOTROPIC |
                GLINT_FEATURE_SAMPLE | GLINT_FEATURE_VARYING_SURFACE | GLINT_FEATURE_EQUAL_AREA |
                GLINT_FEATURE_EQUAL_PROJECTED_AREA | GLINT_FEATURE_SAMPLE_FOOTPRINT | GLINT_FEATURE_COLOR,
    .setup = layered_setup,
    .free = layered_free,
    .eval = layered_eval,
    .eval_many = layered_eval_many,
    .sample = layered_sample,
    .pdf = layered_pdf,
    .transmittance = layered_transmittance,
};
