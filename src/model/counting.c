/* The counting model: the smooth lobe times b(N, p) / (N p), a binomial count of the lit facets under the footprint.
 *
 * L = L_smooth b(N, p) / (N p): Kneiphof and Klein 2024, Eq. 21, on the grids of Deliot and Belcour 2023. The mean over
 * seeds is the smooth lobe by construction.
 */
#include "model/counting_kernel.h"

#define GLINT_LANES 1
#include "math/hash.h"
#include "model/area.h"
#include "model/lobe.h"
#include "model/stretch.h"

enum { CHUNK = 64 }; /* points gathered for the kernel at a time; a multiple of every width */

/* What setup makes. */
typedef struct counting_baked {
    counting_width width;
    int is_tinted;
    tint_palette palette;
} counting_baked;

/* The arrays that counting_points points to. */
typedef struct gathered {
    double u[CHUNK], v[CHUNK];
    float dudx[CHUNK], dudy[CHUNK], dvdx[CHUNK], dvdy[CHUNK], density[CHUNK], hx[CHUNK], hy[CHUNK], cap[CHUNK],
        p[CHUNK];
    uint32_t seed[CHUNK];
} gathered;

counting_width counting_widest(size_t max_lanes)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (max_lanes >= 16 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
        return (counting_width){ 16, counting_kernel_16, counting_tinted_16 };
    if (max_lanes >= 8 && __builtin_cpu_supports("avx2"))
        return (counting_width){ 8, counting_kernel_8, counting_tinted_8 };
    if (max_lanes >= 4 && __builtin_cpu_supports("sse4.1"))
        return (counting_width){ 4, counting_kernel_4, counting_tinted_4 };
#elif defined(__aarch64__)
    if (max_lanes >= 4)
        return (counting_width){ 4, counting_kernel_4, counting_tinted_4 };
#endif
    (void)max_lanes;
    return (counting_width){ 1, counting_kernel_1, counting_tinted_1 };
}

/* What a point makes of its light: the smooth reflection, and which facets are lit. */
typedef struct lit {
    float specular[3], diffuse[3];
    vec3 h;
    float cap; /* of the half vectors that are lit, seen from above */
    float p;
} lit;

static void light(const model_query *q, lit *l)
{
    if (q->area_light) {
        area_value area;
        area_eval(q, &area);
        *l = (lit){ { area.specular[0], area.specular[1], area.specular[2] },
                    { area.diffuse[0], area.diffuse[1], area.diffuse[2] },
                    area.h,
                    area.cap,
                    area.lit_probability };
        return;
    }
    lobe_value lobe;
    lobe_eval(q, &lobe);
    const float solid_angle = lobe_lit_solid_angle(q, &lobe);
    *l = (lit){ { lobe.specular[0], lobe.specular[1], lobe.specular[2] },
                { lobe.diffuse[0], lobe.diffuse[1], lobe.diffuse[2] },
                lobe.h,
                solid_angle * lobe.h.z,
                lobe_lit_probability(q, &lobe, solid_angle) };
}

/* Whether there is anything to count at this point. */
static int is_discrete(const model_query *q)
{
    return q->footprint && (q->solid_angle_sr > 0.0F || q->area_light) && q->surface->discreteness > 0.0F &&
           q->surface->facets_per_m2 > 0.0F;
}

/* Fills entry i. */
static void gather(const model_query *q, const lit *lobe, gathered *g, size_t i)
{
    const glint_material_options *o = &q->material->options;
    const glint_footprint f = stretch_footprint(q->footprint, o->elongation);
    g->u[i] = f.u;
    g->v[i] = f.v;
    g->dudx[i] = f.dudx;
    g->dudy[i] = f.dudy;
    g->dvdx[i] = f.dvdx;
    g->dvdy[i] = f.dvdy;
    g->density[i] = q->surface->facets_per_m2;
    g->seed[i] = hash_full(o->seed * HASH_X + f.seed * HASH_Y);
    g->hx[i] = lobe->h.x;
    g->hy[i] = lobe->h.y;
    g->cap[i] = lobe->cap;
    g->p[i] = lobe->p;
}

static counting_points points_of(const gathered *g)
{
    return (counting_points){ g->u,       g->v,    g->dudx, g->dudy, g->dvdx, g->dvdy,
                              g->density, g->seed, g->hx,   g->hy,   g->cap,  g->p };
}

static void combine(const model_query *q, const lit *lobe, float factor, glint_value *value)
{
    const float g = q->surface->discreteness;
    for (int c = 0; c < 3; c++) {
        value->smooth[c] = lobe->specular[c] + lobe->diffuse[c];
        value->rgb[c] = lobe->specular[c] * ((1.0F - g) + g * factor) + lobe->diffuse[c];
    }
}

/* The discrete queries of a chunk, index[i] the query of entry i, for facets of different colours. */
static void eval_tinted(const model_query *q, const lit *lobe, const gathered *g, const size_t *index, size_t count,
                        size_t padded, counting_width width, glint_value *value)
{
    const counting_baked *baked = q->material->baked;
    float factor[3][CHUNK], facets[CHUNK];
    float *const factors[3] = { factor[0], factor[1], factor[2] };
    const counting_points points = points_of(g);
    width.tinted(&points, padded, &baked->palette, factors, facets);
    for (size_t i = 0; i < count; i++) {
        const lit *l = &lobe[index[i]];
        glint_value *v = &value[index[i]];
        combine(&q[index[i]], l, 1.0F, v);
        const float share = q[index[i]].surface->discreteness;
        for (int c = 0; c < 3; c++)
            v->rgb[c] = l->specular[c] * ((1.0F - share) + share * factor[c][i]) + l->diffuse[c];
        v->facet_count = facets[i];
        v->lit_probability = g->p[i];
    }
}

/* At most CHUNK queries. */
static void eval_chunk(const model_query *q, size_t count, counting_width width, glint_value *value)
{
    gathered g;
    lit lobe[CHUNK];
    size_t index[CHUNK], discrete = 0;
    for (size_t i = 0; i < count; i++) {
        light(&q[i], &lobe[i]);
        value[i] = (glint_value){ 0 };
        if (is_discrete(&q[i])) {
            gather(&q[i], &lobe[i], &g, discrete);
            index[discrete++] = i;
        } else {
            combine(&q[i], &lobe[i], 1.0F, &value[i]);
        }
    }
    if (discrete == 0)
        return;
    size_t padded = discrete;
    for (; padded % width.lanes != 0; padded++)
        gather(&q[index[discrete - 1]], &lobe[index[discrete - 1]], &g, padded);

    const counting_baked *baked = q->material->baked;
    if (baked->is_tinted) {
        eval_tinted(q, lobe, &g, index, discrete, padded, width, value);
        return;
    }
    float factor[CHUNK], facets[CHUNK];
    const counting_points points = points_of(&g);
    width.kernel(&points, padded, factor, facets);
    for (size_t i = 0; i < discrete; i++) {
        combine(&q[index[i]], &lobe[index[i]], factor[i], &value[index[i]]);
        value[index[i]].facet_count = facets[i];
        value[index[i]].lit_probability = g.p[i];
    }
}

static void counting_eval(const model_query *q, glint_value *value)
{
    eval_chunk(q, 1, (counting_width){ 1, counting_kernel_1, counting_tinted_1 }, value);
}

static void counting_eval_many(const model_query *q, size_t count, glint_value *value)
{
    const counting_baked *baked = q->material->baked;
    for (size_t i = 0; i < count; i += CHUNK)
        eval_chunk(q + i, count - i < CHUNK ? count - i : CHUNK, baked->width, value + i);
}

/* Which width this machine runs, and the palette, are found once, when the material is made. */
static glint_result counting_setup(struct glint_material *material)
{
    const glint_allocator *a = &material->options.allocator;
    counting_baked *baked = a->allocate(sizeof(*baked), a->user);
    if (!baked)
        return GLINT_ERROR_MEMORY;
    *baked =
        (counting_baked){ counting_widest(16), tint_is_asked(&material->options), tint_palette_of(&material->options) };
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
