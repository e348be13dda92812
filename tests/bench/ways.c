/* The ways that `glint study` compares by time, for programs that count instructions: no test depends on a time.
 *
 *     ways count WAY N     takes the way N times over its cases and says nothing
 *     ways list            names them all
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "material_or_exit.h"
#include "statistics.h"
#include "study/area_cases.h"
#include "study/law.h"
#include "study/look_ups.h"

typedef struct way {
    const char *name;
    void (*run)(const struct way *way, long times);
    union {
        law_draw *draw;
        counting_kernel *kernel;
        glint_model model;
        int points; /* of a light; 0: the fast integral, -1: the exact one */
    };
} way;

/* What comes out, kept so that nothing is left out of the program. */
static double kept;

/* Counts of pixels: the trials and chances of the study, twelve draws each. */
static void run_law(const way *w, long times)
{
    static const float trials[] = { 0.3F, 1.5F, 2.0F, 5.0F, 10.0F, 30.0F, 100.0F, 1000.0F, 10000.0F };
    static const float chances[] = { 1e-3F, 0.01F, 0.1F, 0.3F, 0.6F, 0.95F };
    enum { TRIALS = sizeof trials / sizeof trials[0], CHANCES = sizeof chances / sizeof chances[0] };
    uint64_t random = 63, state = 62;
    for (long n = 0; n < times; n++)
        for (int i = 0; i < TRIALS * CHANCES; i++) {
            float draws[LAW_DRAWS];
            law_source source = { .state = &state };
            if (trials[i / CHANCES] * chances[i % CHANCES] < 0.1F)
                continue;
            for (int k = 0; k < 2 * LAW_DRAWS; k++)
                source.uniform[k / LAW_DRAWS][k % LAW_DRAWS] = (uint32_t)(random_bits(&random) >> 32);
            w->draw(trials[i / CHANCES], chances[i % CHANCES], &source, draws);
            kept += (double)draws[0];
        }
}

/* As the study has them: pixels of a millimetre with thirty lit facets, 64 samples each. */
static void run_look_ups(const way *w, long times)
{
    enum { SAMPLES = 4096 };
    static double u[SAMPLES], v[SAMPLES];
    static float step[SAMPLES], none[SAMPLES], density[SAMPLES], h[SAMPLES], cap[SAMPLES], p[SAMPLES], factor[SAMPLES],
        facets[SAMPLES];
    static uint32_t seed[SAMPLES], draw[SAMPLES];
    uint64_t random = 81;
    for (int i = 0; i < SAMPLES; i++) {
        const int pixel = i / 64;
        u[i] = (pixel + random_uniform(&random)) * 1e-3;
        v[i] = random_uniform(&random) * 1e-3;
        step[i] = 1e-3F / 8.0F;
        density[i] = 1500e6F;
        h[i] = 0.1F;
        cap[i] = 1e-3F;
        p[i] = 0.02F;
        seed[i] = 0x51ed270bU;
        draw[i] = (uint32_t)(random_bits(&random) >> 32);
    }
    const counting_points points = { u, v, step, none, none, step, density, seed, h, h, cap, p };
    for (long n = 0; n < times; n++) {
        if (w->kernel)
            w->kernel(&points, SAMPLES, factor, facets);
        else
            counting_drawn_1(&points, draw, SAMPLES, factor, facets);
        kept += (double)factor[n % SAMPLES];
    }
}

/* The light of a rectangle: at points in it, which are evaluated as lights of their own, or as a whole. */
static double light_of(const glint_material *m, const area_case *c, int points, uint64_t *random)
{
    glint_surface s = glint_material_surface(m);
    s.alpha_x = s.alpha_y = (float)c->lobe.alpha_x;
    glint_value v;
    if (points <= 0) {
        glint_eval_area(m, &s, NULL, c->wo, &c->light, &v);
        return (double)v.smooth[0];
    }
    double sum = 0.0;
    for (int i = 0; i < points; i++) {
        const float x = (float)random_between(random, -1.0, 1.0), y = (float)random_between(random, -1.0, 1.0);
        float wi[3], rgb[3];
        for (int k = 0; k < 3; k++)
            wi[k] = c->light.center[k] + x * c->light.half_x[k] + y * c->light.half_y[k];
        area_unit(wi);
        glint_eval(m, &s, NULL, c->wo, wi, NULL, rgb);
        sum += (double)rgb[0] / points;
    }
    return sum;
}

static void run_integrals(const way *w, long times)
{
    enum { LIGHTS = 64 };
    static area_case cases[LIGHTS];
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    uint64_t random = 71;
    o.model = GLINT_MODEL_SMOOTH;
    o.area_light_method = w->points < 0 ? GLINT_AREA_LIGHT_EXACT : GLINT_AREA_LIGHT_FAST;
    glint_material *const m = material_or_exit(&o);
    for (int i = 0; i < LIGHTS; i++) {
        cases[i] = area_case_of(&random, 0);
        cases[i].light.kind = GLINT_AREA_RECTANGLE;
    }
    for (long n = 0; n < times; n++)
        for (int i = 0; i < LIGHTS; i++)
            kept += light_of(m, &cases[i], w->points, &random);
    glint_material_destroy(m);
}

/* Pixels of a tenth of a millimetre with 1024 facets each. */
static void run_models(const way *w, long times)
{
    enum { PIXELS = 16 };
    static const float wo[3] = { 0.0F, 0.28F, 0.96F }, wi[3] = { 0.1F, -0.2F, 0.974679F };
    static const glint_light light = { GLINT_LIGHT_CAP, 1e-2F };
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = w->model;
    o.distribution = GLINT_DISTRIBUTION_BECKMANN;
    o.surface.facets_per_m2 = 1024e8F;
    o.surface.alpha_x = o.surface.alpha_y = 0.3F;
    glint_material *const m = material_or_exit(&o);
    for (long n = 0; n < times; n++)
        for (int i = 0; i < PIXELS; i++) {
            const glint_footprint f = { .u = i * 1e-4, .v = (double)n * 1e-4, .dudx = 1e-4F, .dvdy = 1e-4F };
            float rgb[3];
            glint_eval(m, NULL, &f, wo, wi, &light, rgb);
            kept += (double)rgb[0];
        }
    glint_material_destroy(m);
}

static const way ways[] = {
    { "law, as printed", run_law, { .draw = law_as_published } },
    { "law, cut at 0", run_law, { .draw = law_gated } },
    { "law, cut to [1, N]", run_law, { .draw = law_clamped } },
    { "law, libglint's", run_law, { .draw = law_ours_5 } },
    { "law, exact", run_law, { .draw = law_exact } },
    { "look-ups, all 36", run_look_ups, { .kernel = counting_kernel_1 } },
    { "look-ups, one drawn", run_look_ups, { .kernel = NULL } },
    { "look-ups, the nearest", run_look_ups, { .kernel = look_up_nearest } },
    { "light, point", run_integrals, { .points = 1 } },
    { "light, 64 points", run_integrals, { .points = 64 } },
    { "light, fast", run_integrals, { .points = 0 } },
    { "light, exact", run_integrals, { .points = -1 } },
    { "model, smooth", run_models, { .model = GLINT_MODEL_SMOOTH } },
    { "model, counting", run_models, { .model = GLINT_MODEL_COUNTING } },
    { "model, dictionary", run_models, { .model = GLINT_MODEL_DICTIONARY } },
    { "model, explicit", run_models, { .model = GLINT_MODEL_EXPLICIT } },
};
enum { WAYS = sizeof ways / sizeof ways[0] };

int main(int argc, char **argv)
{
    for (int i = 0; i < WAYS && argc == 2 && strcmp(argv[1], "list") == 0; i++)
        puts(ways[i].name);
    for (int i = 0; i < WAYS && argc == 4 && strcmp(argv[1], "count") == 0; i++)
        if (strcmp(argv[2], ways[i].name) == 0) {
            ways[i].run(&ways[i], strtol(argv[3], NULL, 10));
            return kept >= 0.0 ? 0 : 1;
        }
    if (argc == 2 && strcmp(argv[1], "list") == 0)
        return 0;
    fputs("usage: ways list | count WAY N\n", stderr);
    return 2;
}
