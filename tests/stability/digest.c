/* Prints one hash for each model of what the library gives for a large sweep of queries, one for each vector width
 * of the kernels of counting, lobes, lights and the dictionary, and one of the previewer's own numbers, with traps for
 * floating-point exceptions on. compilers.sh runs it as it was built by several compilers at several levels of
 * optimisation: every build must print the same. */
#define _GNU_SOURCE
#include "traps.h"

#include "batch_points.h"
#include "digest_preview.h"
#include "exact_inputs.h"
#include "model/area_kernel.h"
#include "model/counting_kernel.h"
#include "model/dictionary_kernel.h"
#include "model/lobe_kernel.h"

enum { EACH = 160, BATCH = 192 };

static glint_area_light exact_light(uint64_t *random)
{
    glint_area_light l = { .kind = (glint_area_kind)(random_bits(random) % 5), .two_sided = 1U };
    exact_direction(random, l.center);
    const float size = exact_solid_angle(random);
    l.solid_angle_sr = size;
    l.radius = 0.5F * size;
    for (int k = 0; k < 3; k++) {
        l.half_x[k] = size * (float)random_between(random, -0.5, 0.5);
        l.half_y[k] = size * (float)random_between(random, -0.5, 0.5);
    }
    /* A part of an octagon. */
    static const float ring[GLINT_MAX_CORNERS][2] = { { 1.0F, 0.0F },    { 0.75F, 0.75F }, { 0.0F, 1.0F },
                                                      { -0.75F, 0.75F }, { -1.0F, 0.0F },  { -0.75F, -0.75F },
                                                      { 0.0F, -1.0F },   { 0.75F, -0.75F } };
    l.corner_count = 3U + (uint32_t)(random_bits(random) % 6);
    for (uint32_t i = 0; i < l.corner_count; i++)
        for (int k = 0; k < 3; k++)
            l.corners[i][k] = l.center[k] + ring[i][0] * l.half_x[k] + ring[i][1] * l.half_y[k];
    return l;
}

static uint64_t hash_value(uint64_t hash, const glint_value *v)
{
    hash = hash_floats(hash, v->rgb, 3);
    hash = hash_floats(hash, v->smooth, 3);
    return hash_floats(hash, &v->facet_count, 2);
}

static uint64_t hash_queries(uint64_t hash, const glint_material *m, uint64_t *random)
{
    for (int i = 0; i < EACH; i++) {
        float wo[3], wi[3], u[3], through[3];
        exact_direction(random, wo);
        exact_direction(random, wi);
        for (int k = 0; k < 3; k++)
            u[k] = (float)(random_bits(random) >> 40) * 0x1p-24F;
        const glint_footprint f = exact_footprint(random);
        const glint_light light = { GLINT_LIGHT_CAP, exact_solid_angle(random) };
        glint_surface s = glint_material_surface(m);
        s.alpha_x = ldexpf(1.0F, -(int)(random_bits(random) % 13));
        s.alpha_y = i % 2 ? s.alpha_x : ldexpf(1.0F, -(int)(random_bits(random) % 13));
        s.facets_per_m2 = ldexpf(1.0F, (int)(random_bits(random) % (i % 4 ? 24 : 60)));
        const glint_surface *surface = i % 3 ? NULL : &s;
        glint_value v;
        glint_sample sample;
        glint_eval_value(m, surface, &f, wo, wi, &light, &v);
        hash = hash_value(hash, &v);
        if (i % 4 == 0) {
            const glint_area_light area = exact_light(random);
            glint_eval_area(m, surface, &f, wo, &area, &v);
            hash = hash_value(hash, &v);
        }
        glint_sample_direction(m, surface, &f, wo, u, &sample);
        hash = hash_floats(hash, sample.wi, 7);
        const float pdf = glint_pdf(m, surface, &f, wo, wi);
        hash = hash_floats(hash, &pdf, 1);
        glint_transmittance(m, NULL, wo, wi, through);
        hash = hash_floats(hash, through, 3);
    }
    return hash;
}

/* Caps, and lights of real size, at the same points. */
static uint64_t hash_batch(uint64_t hash, const glint_material *m, uint64_t *random)
{
    static batch_points points;
    static glint_area_light light[BATCH];
    for (int i = 0; i < BATCH; i++) {
        float wo[3], wi[3];
        exact_direction(random, wo);
        exact_direction(random, wi);
        glint_footprint f = exact_footprint(random);
        const float solid_angle_sr = exact_solid_angle(random);
        light[i] = exact_light(random);
        f.draw = (uint32_t)random_bits(random);
        batch_points_place(&points, i, &f);
        batch_points_light(&points, i, wo, wi, solid_angle_sr);
    }
    glint_batch b = batch_points_of(&points, BATCH);
    for (int is_area = 0; is_area < 2; is_area++) {
        b.area_lights = is_area ? light : NULL;
        glint_eval_batch(m, &b);
        for (int k = 0; k < 3; k++)
            hash = hash_floats(hash, points.rgb[k], BATCH);
    }
    return hash;
}

static void print_model(glint_model model)
{
    uint64_t random = 51, hash = HASH_START;
    for (int i = 0; i < CONFIGURATIONS; i++) {
        const configuration c = configuration_of(model, i);
        glint_material *m = create(&c.options);
        hash = hash_queries(hash, m, &random);
        hash = hash_batch(hash, m, &random);
        glint_material_destroy(m);
    }
    printf("%-12s %016llx\n", glint_model_name(model), (unsigned long long)hash);
}

/* ---- the kernel ---- */

enum { POINTS = 1 << 14 };

static struct {
    double u[POINTS], v[POINTS];
    float dudx[POINTS], dudy[POINTS], dvdx[POINTS], dvdy[POINTS], density[POINTS], hx[POINTS], hy[POINTS], cap[POINTS],
        p[POINTS];
    uint32_t seed[POINTS];
} a;

static void fill_points(void)
{
    uint64_t random = 52;
    for (int i = 0; i < POINTS; i++) {
        const glint_footprint f = exact_footprint(&random);
        const int far = (int)(random_bits(&random) % 36);
        a.u[i] = ldexp(f.u, far);
        a.v[i] = f.v;
        a.dudx[i] = f.dudx;
        a.dudy[i] = f.dudy;
        a.dvdx[i] = f.dvdx;
        a.dvdy[i] = ldexpf(f.dvdy, -(int)(random_bits(&random) % 20));
        a.density[i] = ldexpf(1.0F, (int)(random_bits(&random) % 60));
        a.hx[i] = (float)random_between(&random, -0.9, 0.9);
        a.hy[i] = (float)random_between(&random, -0.4, 0.4);
        a.cap[i] = ldexpf(1.0F, -(int)(random_bits(&random) % 40));
        const int rare = -(int)(random_bits(&random) % 40);
        a.p[i] = (float)ldexp(random_between(&random, 0.5, 1.0), rare);
        if (i % 7 == 0)
            a.p[i] = 1.0F - a.p[i];
        a.seed[i] = f.seed;
    }
}

static uint64_t hash_lobes(uint64_t hash, size_t lanes)
{
    static lobe_points p;
    static lobe_lit lit;
    uint64_t random = 53;
    for (int round = 0; round < 24; round++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.distribution = (glint_distribution)(round % 2);
        o.fresnel = (glint_fresnel)(round / 2 % 3);
        for (int i = 0; i < LOBE_MOST; i++) {
            float wo[3], wi[3];
            exact_direction(&random, wo);
            exact_direction(&random, wi);
            for (int k = 0; k < 3; k++) {
                p.wo[k][i] = wo[k];
                p.wi[k][i] = wi[k];
                p.diffuse[k][i] = (float)random_uniform(&random);
                p.f0[k][i] = (float)random_uniform(&random);
                p.f90[k][i] = 1.0F;
            }
            p.alpha_x[i] = ldexpf(1.0F, -(int)(random_bits(&random) % 13));
            p.alpha_y[i] = i % 2 ? p.alpha_x[i] : ldexpf(1.0F, -(int)(random_bits(&random) % 13));
            p.total_area[i] = i % 3 ? 0.0F : 1.25F;
            p.solid_angle[i] = exact_solid_angle(&random);
        }
        lobe_kernel_widest(lanes)(&o, &p, LOBE_MOST, 1, &lit);
        hash = hash_floats(hash, (const float *)&lit, sizeof(lit) / sizeof(float));
    }
    return hash;
}

/* Entry i: a point under a light; every ninth has a number of any bits. */
static void fill_lit_point(area_crowd *p, int i, uint64_t *random)
{
    float wo[3];
    exact_direction(random, wo);
    glint_area_light l = exact_light(random);
    float *const numbers[] = { l.center, l.half_x + 1, l.half_y + 2, &l.radius, &l.solid_angle_sr };
    const uint32_t bits = (uint32_t)random_bits(random);
    if (i % 9 == 0)
        memcpy(numbers[random_bits(random) % 5], &bits, sizeof(bits));
    for (int k = 0; k < 3; k++) {
        p->wo[k][i] = wo[k];
        p->diffuse[k][i] = i % 2 ? 0.0F : (float)random_uniform(random);
        p->f0[k][i] = (float)random_uniform(random);
        p->f90[k][i] = 1.0F;
        p->center[k][i] = l.center[k];
        p->half_x[k][i] = l.half_x[k];
        p->half_y[k][i] = l.half_y[k];
    }
    p->alpha_x[i] = ldexpf(1.0F, -(int)(random_bits(random) % 13));
    p->alpha_y[i] = i % 2 ? p->alpha_x[i] : ldexpf(1.0F, -(int)(random_bits(random) % 13));
    p->total_area[i] = i % 3 ? 0.0F : 1.25F;
    p->hidden[i] = i % 4 ? 0.0F : (float)random_uniform(random);
    const uint32_t corners = l.kind == GLINT_AREA_POLYGON ? l.corner_count : 0U;
    p->corner_count[i] = (int32_t)corners;
    for (uint32_t n = 0; n < GLINT_MAX_CORNERS; n++)
        for (int k = 0; k < 3; k++)
            p->corner[n][k][i] = corners ? l.corners[n < corners ? n : 0U][k] : 0.0F;
    p->kind[i] = (int32_t)l.kind;
    p->two_sided[i] = i % 5 != 0;
    p->size[i] = l.kind == GLINT_AREA_SPHERE ? l.radius : l.solid_angle_sr;
}

static uint64_t hash_lights(uint64_t hash, size_t lanes)
{
    static area_crowd p;
    static lobe_lit lit;
    uint64_t random = 55;
    for (int round = 0; round < 24; round++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        float left[LOBE_MOST];
        o.distribution = (glint_distribution)(round % 2);
        o.fresnel = (glint_fresnel)(round / 2 % 3);
        p.most_corners = GLINT_MAX_CORNERS;
        for (int i = 0; i < LOBE_MOST; i++)
            fill_lit_point(&p, i, &random);
        area_kernel_widest(lanes)(&o, &p, LOBE_MOST, 1, &lit, left);
        hash = hash_floats(hash, left, LOBE_MOST);
        hash = hash_floats(hash, (const float *)&lit, sizeof(lit) / sizeof(float));
    }
    return hash;
}

static uint64_t hash_dictionary(uint64_t hash, size_t lanes)
{
    enum { CELLS = 400 };
    static dictionary table;
    static dictionary_scratch scratch;
    static dictionary_corners corners;
    static dictionary_cells cells;
    static float weight[DICTIONARY_ROOM], density[DICTIONARY_ROOM];
    static uint32_t name[DICTIONARY_ROOM];
    static int is_built;
    const dictionary_width width = dictionary_widest(lanes);
    uint64_t random = 54;
    if (!is_built)
        dictionary_build(&table, &scratch, 5);
    is_built = 1;
    for (int round = 0; round < 24; round++) {
        for (int i = 0; i < CELLS; i++) {
            corners.row[i] = (uint32_t)random_bits(&random);
            corners.low[i] = (uint32_t)random_bits(&random);
            corners.high[i] = (uint32_t)random_bits(&random);
            corners.r2[i] = (float)random_uniform(&random);
            cells.hash[i] = (uint32_t)random_bits(&random);
            cells.log4_facets[i] = (float)random_between(&random, 0.0, 16.0);
        }
        const float x = (float)random_between(&random, -2.0, 2.0);
        width.weigh(&corners, CELLS, name, weight);
        width.look(&table, round % 2 ? NDF_GGX : NDF_BECKMANN, &cells, CELLS, x, 0.25F, density);
        hash = hash_floats(hash, weight, CELLS);
        hash = hash_floats(hash, density, CELLS);
        for (int i = 0; i < CELLS; i++)
            hash = (hash ^ name[i]) * 0x100000001b3U;
    }
    return hash;
}

/* Widths that this machine lacks are left out. */
static void print_kernels(void)
{
    static const counting_points points = { a.u,       a.v,    a.dudx, a.dudy, a.dvdx, a.dvdy,
                                            a.density, a.seed, a.hx,   a.hy,   a.cap,  a.p };
    static float factor[3][POINTS], facets[POINTS];
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.color_variation = 0.5F;
    const tint_palette palette = tint_palette_of(&o);
    fill_points();
    for (size_t lanes = 1; lanes <= 16; lanes *= 2) {
        const counting_width w = counting_widest(lanes);
        if (w.lanes != lanes)
            continue;
        w.kernel(&points, POINTS, factor[0], facets);
        uint64_t hash = hash_floats(HASH_START, factor[0], POINTS);
        hash = hash_floats(hash, facets, POINTS);
        w.drawn(&points, a.seed, POINTS, factor[0], facets);
        hash = hash_floats(hash, factor[0], POINTS);
        float *const factors[3] = { factor[0], factor[1], factor[2] };
        w.tinted(&points, POINTS, &palette, factors, facets);
        for (int k = 0; k < 3; k++)
            hash = hash_floats(hash, factor[k], POINTS);
        hash = hash_dictionary(hash_lights(hash_lobes(hash, lanes), lanes), lanes);
        printf("lanes %-6zu %016llx\n", lanes, (unsigned long long)hash);
    }
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "traps") == 0)
        feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    for (size_t i = 0; i < sizeof(MODELS) / sizeof(MODELS[0]); i++)
        print_model(MODELS[i].model);
    print_kernels();
#if defined(DIGEST_PREVIEW)
    digest_print_preview();
#endif
    return 0;
}
