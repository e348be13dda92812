/* The example model: a small normal map, tiled or scattered over the surface, whose normals are seen one by one or by
 * their distribution, as the footprint has it (Xing et al. 2024).
 *
 * f = F D_P(h) G / (4 cos_o cos_i) (Eq. 1), with D_P from example_density.c: P(s) / cos^4(h) of the density P of
 * slopes. G is Smith's for a Gaussian surface with the slopes' second moments.
 */
#include "model/example_density.h"

#include "model/area_points.h"

#define GLINT_LANES 1
#include "light/cap.h"
#include "math/elementary.h"
#include "math/hash.h"
#include "model/lobe.h"
#include "ndf/ndf.h"

/* Half vectors flatter than this, .06 degrees, have slopes that no example has. */
#define LEAST_COSINE 1e-3F

/* Slopes of the surface to slopes of the material: what a point of the surface asks for, over what the options say. */
typedef struct stretch {
    float x, y;
} stretch;

static stretch stretch_of(const model_query *q)
{
    const glint_surface *own = &q->material->options.surface;
    return (stretch){ q->surface->alpha_x / own->alpha_x, q->surface->alpha_y / own->alpha_y };
}

/* Side of an example at this point, m; 0: there is none. */
static float side_of(const model_query *q)
{
    const glint_material_options *o = &q->material->options;
    const float density = q->surface->facets_per_m2;
    if (!(density > 0.0F))
        return 0.0F;
    if (o->example.side_m > 0.0F && o->surface.facets_per_m2 > 0.0F)
        return o->example.side_m * sqrtf(o->surface.facets_per_m2 / density);
    return (float)o->example.size / sqrtf(density);
}

/* ---- the distribution ---- */

/* P(s) / cos^4 of a slope density; the stretch is undone in both. */
static float facet_density(vec3 h, stretch r, float slope_density)
{
    const float z2 = h.z * h.z;
    return slope_density / (r.x * r.y * z2 * z2);
}

static int is_steep(vec3 h)
{
    return !(h.z > LEAST_COSINE);
}

static void material_slope(vec3 h, stretch r, float slope[2])
{
    slope[0] = h.x / (h.z * r.x);
    slope[1] = h.y / (h.z * r.y);
}

/* Variance per axis of the slopes that a light of this solid angle takes in: a disc of half vectors of area A has
 * A / (4 pi), and a slope changes by 1 / cos^2 and 1 / cos with its direction, which 1 / cos^3 averages over areas. */
static float light_variance(const model_query *q, const lobe_value *lobe, stretch r)
{
    const float cap = cap_half_vector_solid_angle(q->solid_angle_sr, lobe->h_dot_wi);
    const float variance = cap / (4.0F * MATH_PI * lobe->h.z * lobe->h.z * lobe->h.z);
    const float mean = 0.5F * (1.0F / (r.x * r.x) + 1.0F / (r.y * r.y));
    /* Beyond this the maps have no more detail to lose. */
    return variance * mean < 4.0F ? variance * mean : 4.0F;
}

static float overall_density(const example *e, const float slope[2], float variance)
{
    return slope_maps_density(&e->overall, 0, e->overall.variance + variance, slope[0], slope[1]);
}

static float masking_over_cosine(const example *e, stretch r, const model_query *q)
{
    const float out = example_masked(&e->masking, q->wo.x * r.x, q->wo.y * r.y, q->wo.z);
    const float in = example_masked(&e->masking, q->wi.x * r.x, q->wi.y * r.y, q->wi.z);
    return ndf_correlated_masking(q->wo.z, out, q->wi.z, in);
}

/* ---- contract ---- */

/* Whether there is anything discrete at this point, and the footprint there. */
static int find_footprint(const model_query *q, const example *e, example_footprint *f)
{
    if (!q->footprint || !(q->solid_angle_sr > 0.0F) || !(q->surface->discreteness > 0.0F))
        return 0;
    const float side = side_of(q);
    return side > 0.0F && lattice_footprint(&e->lattice, q, side, f);
}

static float footprint_area(const glint_footprint *f)
{
    return fabsf((float)((double)f->dudx * (double)f->dvdy - (double)f->dudy * (double)f->dvdx));
}

static void combine(const model_query *q, lobe_value *lobe, float masking, float smooth, float density,
                    glint_value *value)
{
    lobe->density = smooth;
    lobe_shade(q, masking, lobe);
    for (int c = 0; c < 3; c++)
        value->smooth[c] = lobe->specular[c] + lobe->diffuse[c];
    lobe->density = density;
    lobe_shade(q, masking, lobe);
    for (int c = 0; c < 3; c++)
        value->rgb[c] = lobe->specular[c] + lobe->diffuse[c];
}

static void example_eval(const model_query *q, glint_value *value)
{
    if (q->area_light) {
        area_points_eval(q, value);
        return;
    }
    const example *e = q->material->baked;
    const stretch r = stretch_of(q);
    lobe_value lobe;
    lobe_halve(q, &lobe);
    *value = (glint_value){ 0 };
    const float masking = masking_over_cosine(e, r, q);
    if (is_steep(lobe.h)) {
        combine(q, &lobe, masking, 0.0F, 0.0F, value);
        return;
    }
    float slope[2];
    material_slope(lobe.h, r, slope);
    example_footprint f;
    if (!find_footprint(q, e, &f)) {
        const float smooth = facet_density(lobe.h, r, overall_density(e, slope, 0.0F));
        combine(q, &lobe, masking, smooth, smooth, value);
        return;
    }
    const float light = light_variance(q, &lobe, r);
    const float overall = overall_density(e, slope, light);
    const float share = f.share * q->surface->discreteness;
    float mixed = overall, tint[3] = { 1.0F, 1.0F, 1.0F }, seen = 0.0F;
    /* A slope that the whole surface does not have is under no footprint. */
    if (share > 0.0F && overall > 0.0F) {
        const matrix2 l = e->lattice.from_lattice;
        const float on_lattice[2] = { l.xx * slope[0] + l.yx * slope[1], l.xy * slope[0] + l.yy * slope[1] };
        const float widened = light * 0.5F * (l.xx * l.xx + l.xy * l.xy + l.yx * l.yx + l.yy * l.yy);
        const uint32_t seed = hash_full(q->material->options.seed * HASH_Y + q->footprint->seed * HASH_X);
        seen = example_density(e, &f, on_lattice, widened, seed) * fabsf(matrix2_determinant(l));
        mixed = (1.0F - share) * overall + share * seen;
        if (seen > 0.0F && tint_is_asked(&q->material->options)) {
            const tint_palette palette = tint_palette_of(&q->material->options);
            example_tint(e, &f, on_lattice, widened, seed, &palette, tint);
        }
    }
    const float smooth = facet_density(lobe.h, r, overall);
    combine(q, &lobe, masking, smooth, facet_density(lobe.h, r, mixed), value);
    for (int c = 0; c < 3; c++)
        if (tint[c] != 1.0F) {
            const float tinted = (1.0F - share) * overall + share * seen * tint[c];
            value->rgb[c] = lobe.reflectance[c] * facet_density(lobe.h, r, tinted) + lobe.diffuse[c];
        }
    const float side = side_of(q), texels = (float)e->size / side;
    const float count = footprint_area(q->footprint) * texels * texels;
    value->facet_count = count < 1e30F ? count : 1e30F;
    /* Facets are equal in projected area. */
    const float p = smooth * lobe.h.z * cap_half_vector_solid_angle(q->solid_angle_sr, lobe.h_dot_wi);
    value->lit_probability = p < 1.0F ? p : 1.0F;
}

static void example_eval_many(const model_query *q, size_t count, glint_value *value)
{
    for (size_t i = 0; i < count; i++)
        example_eval(&q[i], &value[i]);
}

/* Normals are drawn from the whole surface's distribution, whatever the footprint. */
static float example_pdf(const model_query *q)
{
    const example *e = q->material->baked;
    const stretch r = stretch_of(q);
    const float chance = lobe_specular_chance(q);
    lobe_value lobe;
    lobe_halve(q, &lobe);
    float specular = 0.0F;
    if (!is_steep(lobe.h) && lobe.h_dot_wi > 1e-6F) {
        float slope[2];
        material_slope(lobe.h, r, slope);
        /* Slopes to normals: 1 / cos^3; normals to wi: 1 / (4 h.wi). */
        specular = facet_density(lobe.h, r, overall_density(e, slope, 0.0F)) * lobe.h.z / (4.0F * lobe.h_dot_wi);
    }
    return chance * specular + (1.0F - chance) * (q->wi.z / MATH_PI);
}

static int example_sample(const model_query *q, const float random[3], glint_sample *sample)
{
    const example *e = q->material->baked;
    const stretch r = stretch_of(q);
    model_query lit = *q;
    if (random[0] < lobe_specular_chance(q)) {
        float slope[2];
        slope_map_sample(&e->overall, e->overall.maps, e->row_sums, random[1], random[2], slope);
        const vec3 h = vec3_normalize((vec3){ slope[0] * r.x, slope[1] * r.y, 1.0F });
        const float cosine = vec3_dot(q->wo, h);
        if (!(cosine > 0.0F))
            return 0;
        lit.wi = vec3_normalize(vec3_add(vec3_scale(h, 2.0F * cosine), vec3_scale(q->wo, -1.0F)));
    } else {
        lit.wi = lobe_cosine_direction(random[1], random[2]);
    }
    if (!(lit.wi.z > 0.0F))
        return 0;
    lit.footprint = NULL;
    lit.solid_angle_sr = 0.0F;
    const float pdf = example_pdf(&lit);
    if (!(pdf > 0.0F))
        return 0;
    glint_value value;
    example_eval(&lit, &value);
    *sample = (glint_sample){ { lit.wi.x, lit.wi.y, lit.wi.z }, pdf, { 0.0F, 0.0F, 0.0F } };
    for (int c = 0; c < 3; c++)
        sample->weight[c] = value.smooth[c] / pdf;
    return 1;
}

/* ---- set-up ---- */

static void *allocate(const struct glint_material *m, size_t byte_count)
{
    return m->options.allocator.allocate(byte_count, m->options.allocator.user);
}

static void release(const struct glint_material *m, void *memory)
{
    if (memory)
        m->options.allocator.release(memory, m->options.allocator.user);
}

static void example_free(struct glint_material *material)
{
    example *e = material->baked;
    if (!e)
        return;
    release(material, e->codes_block);
    release(material, e->maps_block);
    release(material, e);
}

/* The example with its seeds. */
static example *make_seeds(struct glint_material *material)
{
    const glint_example *o = &material->options.example;
    uint32_t levels = 0;
    while (2U << levels <= o->size)
        levels++;
    const example sized = { .size = o->size, .levels = levels };
    const size_t quads = (size_t)o->size * o->size / 4;
    const size_t tiles = example_tiles_before(&sized, EXAMPLE_LEAST_MAP_LEVEL, levels);
    example *e = allocate(material, sizeof(*e) + quads * sizeof(example_quad) + tiles * sizeof(quarter_slopes));
    if (!e)
        return NULL;
    *e = sized;
    e->quads = (example_quad *)(e + 1);
    e->slopes = (quarter_slopes *)(e->quads + quads);
    for (uint32_t level = 0; level < levels; level++)
        e->first_chain[level] = example_tiles_before(e, EXAMPLE_LEAST_MAP_LEVEL, level);
    lattice_make(&e->lattice, o);
    e->is_flat = o->flat || !o->normals;
    example_seed(e, &material->options);
    return e;
}

/* Descriptions of the maps; the last chain is the overall one. */
static int make_maps(struct glint_material *material, example *e)
{
    const size_t tiles = example_tiles_before(e, EXAMPLE_LEAST_MAP_LEVEL, e->levels);
    e->tiles.variance = e->slope_variance;
    e->tiles.length = slope_chain_length(e->slope_variance);
    const size_t count = tiles * e->tiles.length + SLOPE_MOST_LENGTH;
    e->maps_block = allocate(material, count * sizeof(slope_map) + (SLOPE_MAP_SIDE + 1) * sizeof(float));
    if (!e->maps_block)
        return 0;
    e->tiles.maps = e->maps_block;
    e->overall.maps = e->tiles.maps + tiles * e->tiles.length;
    e->row_sums = (float *)(e->tiles.maps + count);
    return 1;
}

static int make_codes(struct glint_material *material, example *e)
{
    e->codes_block = allocate(material, example_place_maps(e));
    float *work = e->codes_block ? allocate(material, SLOPE_WORK * sizeof(float)) : NULL;
    if (!work)
        return 0;
    e->tiles.codes = e->overall.codes = e->codes_block;
    for (int i = 0; i < SLOPE_WORK; i++)
        work[i] = 0.0F;
    example_fill_maps(e, work);
    release(material, work);
    return 1;
}

static glint_result example_setup(struct glint_material *material)
{
    example *e = make_seeds(material);
    material->baked = e;
    if (e && make_maps(material, e) && make_codes(material, e)) {
        material->options.example.normals = NULL; /* copied; the client may free it */
        return GLINT_OK;
    }
    example_free(material);
    return GLINT_ERROR_MEMORY;
}

const struct model example_model = {
    .name = "example",
    .features = GLINT_FEATURE_DISCRETE | GLINT_FEATURE_GGX | GLINT_FEATURE_BECKMANN | GLINT_FEATURE_ANISOTROPIC |
                GLINT_FEATURE_SAMPLE | GLINT_FEATURE_VARYING_SURFACE | GLINT_FEATURE_EQUAL_AREA |
                GLINT_FEATURE_EQUAL_PROJECTED_AREA | GLINT_FEATURE_COLOR,
    .setup = example_setup,
    .free = example_free,
    .eval = example_eval,
    .eval_many = example_eval_many,
    .sample = example_sample,
    .pdf = example_pdf,
};
