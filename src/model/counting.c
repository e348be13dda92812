/* The counting model: the smooth lobe times b(N, p) / (N p), a binomial count of the lit facets under the footprint.
 *
 * L = L_smooth b(N, p) / (N p): Kneiphof and Klein 2024, Eq. 21, on the grids of Deliot and Belcour 2023. The mean over
 * seeds is the smooth lobe by construction.
 */
#include "model/counting_kernel.h"

#define GLINT_LANES 1
#include "math/effects.h"
#include "math/fade.h"
#include "math/float_bits.h"
#include "math/hash.h"
#include "model/area.h"
#include "model/area_kernel.h"
#include "model/lobe.h"
#include "model/lobe_kernel.h"
#include "model/machine_lanes.h"
#include "model/stretch.h"

enum { CHUNK = LOBE_MOST }; /* points gathered for the kernels at a time; a multiple of every width */

/* Evaluates at most CHUNK queries. */
typedef void eval_chunk(const model_query *q, size_t count, counting_width width, glint_value *value);

/* What setup makes. */
typedef struct counting_baked {
    counting_width wide, narrow; /* for many points, and for one */
    eval_chunk *eval;
    int is_tinted;
    tint_palette palette;
} counting_baked;

/* The arrays that counting_points points to. */
typedef struct gathered {
    double u[CHUNK], v[CHUNK];
    float dudx[CHUNK], dudy[CHUNK], dvdx[CHUNK], dvdy[CHUNK], density[CHUNK], hx[CHUNK], hy[CHUNK], cap[CHUNK],
        p[CHUNK];
    uint32_t seed[CHUNK], draw[CHUNK], place[CHUNK];
} gathered;

counting_width counting_widest(size_t max_lanes)
{
    switch (machine_lanes(max_lanes)) {
#if defined(__x86_64__)
    case 16:
        return (counting_width){ 16, counting_kernel_16, counting_tinted_16, counting_drawn_16 };
    case 8:
        return (counting_width){ 8, counting_kernel_8, counting_tinted_8, counting_drawn_8 };
#endif
#if defined(__x86_64__) || defined(__aarch64__)
    case 4:
        return (counting_width){ 4, counting_kernel_4, counting_tinted_4, counting_drawn_4 };
#endif
    default:
        return (counting_width){ 1, counting_kernel_1, counting_tinted_1, counting_drawn_1 };
    }
}

counting_width counting_narrowest(size_t max_lanes)
{
#if defined(__x86_64__)
    if (machine_lanes(max_lanes) >= 8)
        return (counting_width){ 1, counting_alone_avx2, counting_tinted_alone, counting_drawn_1 };
#endif
#if defined(__x86_64__) || defined(__aarch64__)
    if (machine_lanes(max_lanes) >= 4)
        return (counting_width){ 1, counting_alone, counting_tinted_alone, counting_drawn_1 };
#endif
    return counting_widest(1);
}

/* What points make of their lights: the smooth reflection, and which facets are lit. */
static void find_one(const model_query *q, lobe_lit *l, size_t i)
{
    area_value a;
    if (LIBRARY_AREA_LIGHTS && q->area_light) {
        area_eval(q, &a);
    } else {
        lobe_value lobe;
        lobe_eval(q, &lobe);
        const float solid_angle = lobe_lit_solid_angle(q, &lobe);
        a = (area_value){ .lit_probability = lobe_lit_probability(q, &lobe, solid_angle), .h = lobe.h };
        a.cap = solid_angle * lobe.h.z;
        memcpy(a.specular, lobe.specular, sizeof(a.specular));
        memcpy(a.diffuse, lobe.diffuse, sizeof(a.diffuse));
    }
    for (int c = 0; c < 3; c++) {
        l->specular[c][i] = a.specular[c];
        l->diffuse[c][i] = a.diffuse[c];
    }
    l->h[0][i] = a.h.x;
    l->h[1][i] = a.h.y;
    l->cap[i] = a.cap;
    l->p[i] = a.lit_probability;
}

static void find_lit(const model_query *q, size_t number, lobe_lit *l)
{
    if (number > 1)
        (LIBRARY_AREA_LIGHTS && q->area_light ? area_eval_many : lobe_eval_many)(q, number, 1, l);
    else
        find_one(q, l, 0);
}

/* Whether there is anything to count at this point. */
static int is_discrete(const model_query *q)
{
    return q->footprint && (q->solid_angle_sr > 0.0F || (LIBRARY_AREA_LIGHTS && q->area_light)) &&
           (!LIBRARY_DISCRETENESS || q->surface->discreteness > 0.0F) && q->surface->facets_per_m2 > 0.0F;
}

/* Fills point k. */
static void gather_point(const model_query *q, gathered *g, size_t k)
{
    const glint_material_options *o = &q->material->options;
    const glint_footprint f = LIBRARY_ELONGATION ? stretch_footprint(q->footprint, o->elongation) : *q->footprint;
    g->u[k] = f.u;
    g->v[k] = f.v;
    g->dudx[k] = f.dudx;
    g->dudy[k] = f.dudy;
    g->dvdx[k] = f.dvdx;
    g->dvdy[k] = f.dvdy;
    g->density[k] = q->surface->facets_per_m2;
    g->seed[k] = hash_full(o->seed * HASH_X + f.seed * HASH_Y);
}

/* Fills light i, at point k, from query j. */
static void gather_light(const model_query *q, const lobe_lit *lit, size_t j, gathered *g, size_t i, size_t k)
{
    g->hx[i] = lit->h[0][j];
    g->hy[i] = lit->h[1][j];
    g->cap[i] = lit->cap[j];
    g->p[i] = lit->p[j];
    g->draw[i] = q[j].footprint->draw;
    g->place[i] = (uint32_t)k;
}

/* Whether two queries of one material see the same facets. */
static int is_one_point(const model_query *a, const model_query *b)
{
    return a->footprint->u == b->footprint->u &&
           memcmp(a->footprint, b->footprint, offsetof(glint_footprint, draw)) == 0 &&
           bits_of_float(a->surface->facets_per_m2) == bits_of_float(b->surface->facets_per_m2);
}

/* factor: by channel. g: the share of the facets' light that is counted. */
static void combine(const lobe_lit *lit, size_t i, float g, const float factor[3], glint_value *value)
{
    for (int c = 0; c < 3; c++) {
        value->smooth[c] = lit->specular[c][i] + lit->diffuse[c][i];
        const float shown = LIBRARY_DISCRETENESS ? (1.0F - g) + g * factor[c] : factor[c];
        value->rgb[c] = lit->specular[c][i] * shown + lit->diffuse[c][i];
    }
}

static const float smooth_factor[3] = { 1.0F, 1.0F, 1.0F };

/* Those queries of a chunk for which facets are counted in the same way. */
typedef struct counted {
    gathered all;
    size_t points, count;
    size_t index[CHUNK]; /* index[i]: the query of light i */
    float share[CHUNK];  /* see combine */
} counted;

/* Lights that follow one another at a point share it, where they may. */
static void add(counted *c, const model_query *q, const lobe_lit *lit, size_t index, float share, int may_share)
{
    if (!may_share || c->count == 0 || !is_one_point(&q[c->index[c->count - 1]], &q[index]))
        gather_point(&q[index], &c->all, c->points++);
    gather_light(q, lit, index, &c->all, c->count, c->points - 1);
    c->index[c->count] = index;
    c->share[c->count++] = share;
}

/* Rounds up to the width, with the last point and the last light repeated; returns how many lights there are then. */
static size_t pad(counted *c, const model_query *q, const lobe_lit *lit, size_t lanes)
{
    const size_t last = c->index[c->count - 1];
    size_t lights = c->count;
    for (size_t k = c->points; k % lanes != 0; k++)
        gather_point(&q[last], &c->all, k);
    for (; lights % lanes != 0; lights++)
        gather_light(q, lit, last, &c->all, lights, c->points - 1);
    return lights;
}

static counting_points points_of(const counted *c)
{
    const gathered *g = &c->all;
    return (counting_points){ g->u,
                              g->v,
                              g->dudx,
                              g->dudy,
                              g->dvdx,
                              g->dvdy,
                              g->density,
                              g->seed,
                              g->hx,
                              g->hy,
                              g->cap,
                              g->p,
                              c->points < c->count ? g->place : NULL };
}

static void put(const counted *c, const lobe_lit *lit, float *const factor[3], const float *facets, glint_value *value)
{
    for (size_t i = 0; i < c->count; i++) {
        glint_value *v = &value[c->index[i]];
        const float of_point[3] = { factor[0][i], factor[1][i], factor[2][i] };
        combine(lit, c->index[i], c->share[i], of_point, v);
        v->facet_count = facets[i];
        v->lit_probability = c->all.p[i];
    }
}

static void count(counted *c, const model_query *q, const lobe_lit *lit, counting_width width, glint_value *value)
{
    const counting_baked *baked = q->material->baked;
    if (c->count == 0)
        return;
    float factor[3][CHUNK], facets[CHUNK];
    const counting_points points = points_of(c);
    const size_t padded = pad(c, q, lit, width.lanes);
    if (LIBRARY_TINTS && baked->is_tinted) {
        float *const factors[3] = { factor[0], factor[1], factor[2] };
        width.tinted(&points, padded, &baked->palette, factors, facets);
        put(c, lit, factors, facets, value);
    } else {
        float *const factors[3] = { factor[0], factor[0], factor[0] };
        width.kernel(&points, padded, factor[0], facets);
        put(c, lit, factors, facets, value);
    }
}

static void eval_all(const model_query *q, size_t number, counting_width width, glint_value *value)
{
    lobe_lit lit;
    counted all;
    all.points = all.count = 0;
    find_lit(q, number, &lit);
    for (size_t i = 0; i < number; i++) {
        value[i] = (glint_value){ 0 };
        if (is_discrete(&q[i]))
            add(&all, q, &lit, i, q[i].surface->discreteness, 1);
        else
            combine(&lit, i, 1.0F, smooth_factor, &value[i]);
    }
    count(&all, q, &lit, width, value);
}

/* ---- within what the options allow to leave out ---- */

/* Facets under the footprint, as the kernel counts them. */
static float facets_under(const model_query *q)
{
    const glint_footprint *f = q->footprint;
    const double area = (double)f->dudx * (double)f->dvdy - (double)f->dudy * (double)f->dvdx;
    return (float)fabs(area) * q->surface->facets_per_m2;
}

static void count_drawn(counted *c, const model_query *q, const lobe_lit *lit, counting_width width, glint_value *value)
{
    float factor[CHUNK], facets[CHUNK];
    if (c->count == 0)
        return;
    const counting_points points = points_of(c);
    float *const factors[3] = { factor, factor, factor };
    width.drawn(&points, c->all.draw, pad(c, q, lit, width.lanes), factor, facets);
    put(c, lit, factors, facets, value);
}

static void eval_what_shows(const model_query *q, size_t number, counting_width width, glint_value *value)
{
    const glint_material_options *o = &q->material->options;
    const counting_baked *baked = q->material->baked;
    lobe_lit lit;
    counted all, drawn;
    all.points = all.count = drawn.points = drawn.count = 0;
    find_lit(q, number, &lit);
    for (size_t i = 0; i < number; i++) {
        value[i] = (glint_value){ 0 };
        const float facets = is_discrete(&q[i]) ? facets_under(&q[i]) : 0.0F, p = lit.p[i];
        const float deviation = fade_deviation(facets * p);
        const float share = facets > 0.0F ? fade_share(deviation, LIBRARY_FADING ? o->smooth_deviation : 0.0F) : 0.0F;
        if (!(share > 0.0F)) {
            combine(&lit, i, 1.0F, smooth_factor, &value[i]);
            value[i].facet_count = facets;
            value[i].lit_probability = facets > 0.0F ? p : 0.0F;
        } else if (LIBRARY_DRAWS && 3.0F * deviation < o->draw_deviation && !baked->is_tinted) {
            add(&drawn, q, &lit, i, share * q[i].surface->discreteness, 0);
        } else {
            add(&all, q, &lit, i, share * q[i].surface->discreteness, 1);
        }
    }
    count(&all, q, &lit, width, value);
    count_drawn(&drawn, q, &lit, width, value);
}

static void counting_eval(const model_query *q, glint_value *value)
{
    const counting_baked *baked = q->material->baked;
    baked->eval(q, 1, baked->narrow, value);
}

static void counting_eval_many(const model_query *q, size_t number, glint_value *value)
{
    const counting_baked *baked = q->material->baked;
    for (size_t i = 0; i < number; i += CHUNK)
        baked->eval(q + i, number - i < CHUNK ? number - i : CHUNK, baked->wide, value + i);
}

/* Which widths this machine runs, and the palette, are found once, when the material is made. */
static glint_result counting_setup(struct glint_material *material)
{
    const glint_material_options *o = &material->options;
    const glint_allocator *a = &o->allocator;
    counting_baked *baked = a->allocate(sizeof(*baked), a->user);
    if (!baked)
        return GLINT_ERROR_MEMORY;
    const int leaves_out =
        (LIBRARY_FADING && o->smooth_deviation > 0.0F) || (LIBRARY_DRAWS && o->draw_deviation > 0.0F);
    *baked = (counting_baked){ counting_widest(16), counting_narrowest(16), leaves_out ? eval_what_shows : eval_all,
                               tint_is_asked(o), tint_palette_of(o) };
    material->baked = baked;
    return GLINT_OK;
}

static void counting_free(struct glint_material *material)
{
    material->options.allocator.release(material->baked, material->options.allocator.user);
}

const struct model counting_model = {
    .name = "counting",
    .features = GLINT_FEATURE_DISCRETE | GLINT_FEATURE_GGX | GLINT_FEATURE_BECKMANN | GLINT_FEATURE_ANISOTROPIC |
                GLINT_FEATURE_SAMPLE | GLINT_FEATURE_VARYING_SURFACE | GLINT_FEATURE_EQUAL_AREA |
                GLINT_FEATURE_EQUAL_PROJECTED_AREA | GLINT_FEATURE_COLOR,
    .setup = counting_setup,
    .free = counting_free,
    .eval = counting_eval,
    .eval_many = counting_eval_many,
    .sample = lobe_sample,
    .pdf = lobe_pdf,
};
