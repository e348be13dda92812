/* What one call of the library costs for each model and light, beside the smooth model: whole batches, with lobes,
 * lights and counts.
 *
 * bench/eval FILE.json [rounds]; bench/eval count CASE N: N batches of 1024 points of one case and nothing else, for
 * batch_cost.sh to count instructions. Points come in groups of 16 neighbouring pixels that look alike, N p log-uniform
 * in .01 to 1000.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "glint.h"
#include "race.h"
#include "statistics.h"

enum { POINTS = 1024, GROUP = 16 };

typedef struct points {
    double u[POINTS], v[POINTS];
    float dudx[POINTS], dudy[POINTS], dvdx[POINTS], dvdy[POINTS], wo[3][POINTS], wi[3][POINTS], solid_angle[POINTS];
    float rgb[3][POINTS];
    uint32_t seed[POINTS];
    glint_surface surface[POINTS];
    glint_area_light rectangle[POINTS], sun[POINTS];
} points;

static points all;

static void direction(uint64_t *random, float *x, float *y, float *z)
{
    const double cosine = random_between(random, 0.3, 0.95), turn = random_between(random, 0.0, 6.2831853);
    const double sine = sqrt(1.0 - cosine * cosine);
    *x = (float)(sine * cos(turn));
    *y = (float)(sine * sin(turn));
    *z = (float)cosine;
}

/* A round light of this solid angle around w, and a square one, one metre away. */
static void lights(int i, const float w[3], float solid_angle)
{
    glint_area_light sun = { .kind = GLINT_AREA_SUN, .solid_angle_sr = solid_angle };
    glint_area_light square = { .kind = GLINT_AREA_RECTANGLE, .two_sided = 1 };
    memcpy(sun.center, w, sizeof sun.center);
    memcpy(square.center, w, sizeof square.center);
    const float half = 0.5F * sqrtf(solid_angle), level = sqrtf(w[0] * w[0] + w[1] * w[1]);
    const float x[3] = { -w[1] / level, w[0] / level, 0.0F };
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        square.half_x[k] = half * x[k];
        square.half_y[k] = half * (w[a] * x[b] - w[b] * x[a]);
    }
    all.sun[i] = sun;
    all.rectangle[i] = square;
}

static void fill(void)
{
    const glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    glint_material *m = NULL;
    if (glint_material_create(&o, &m, NULL, 0) != GLINT_OK)
        exit(1);
    uint64_t random = 8;
    float wo[3] = { 0 }, wi[3] = { 0 };
    double size = 0.0, minor = 0.0, turn = 0.0, lit = 0.0, sr = 0.0;
    for (int i = 0; i < POINTS; i++) {
        if (i % GROUP == 0) {
            direction(&random, &wo[0], &wo[1], &wo[2]);
            direction(&random, &wi[0], &wi[1], &wi[2]);
            size = random_log_between(&random, 1e-4, 1e-2);
            minor = size / random_log_between(&random, 1.0, 8.0);
            turn = random_between(&random, 0.0, 6.2831853);
            lit = random_log_between(&random, 0.01, 1e3);
            sr = random_log_between(&random, 1e-4, 1e-2);
            all.u[i] = random_between(&random, -1.0, 1.0);
            all.v[i] = random_between(&random, -1.0, 1.0);
        } else {
            all.u[i] = all.u[i - 1] + size * cos(turn);
            all.v[i] = all.v[i - 1] + size * sin(turn);
        }
        all.dudx[i] = (float)(size * cos(turn));
        all.dvdx[i] = (float)(size * sin(turn));
        all.dudy[i] = (float)(-minor * sin(turn));
        all.dvdy[i] = (float)(minor * cos(turn));
        for (int k = 0; k < 3; k++) {
            all.wo[k][i] = wo[k];
            all.wi[k][i] = wi[k];
        }
        all.solid_angle[i] = (float)sr;
        all.surface[i] = o.surface;
        const glint_footprint f = { all.u[i], all.v[i], all.dudx[i], all.dudy[i], all.dvdx[i], all.dvdy[i], 0 };
        const glint_light light = { GLINT_LIGHT_CAP, all.solid_angle[i] };
        glint_value value;
        glint_eval_value(m, NULL, &f, wo, wi, &light, &value);
        const double p = fmax((double)value.lit_probability, 1e-9);
        all.surface[i].facets_per_m2 = (float)fmin(lit / p / (size * minor), 1e14);
        lights(i, wi, all.solid_angle[i]);
    }
    glint_material_destroy(m);
}

typedef struct runner {
    glint_material_options options;
    const glint_area_light *area_lights;
    glint_material *material;
} runner;

static void run(void *user)
{
    const runner *const r = user;
    glint_batch b = GLINT_BATCH_INIT;
    b.count = POINTS;
    b.u = all.u;
    b.v = all.v;
    b.dudx = all.dudx;
    b.dudy = all.dudy;
    b.dvdx = all.dvdx;
    b.dvdy = all.dvdy;
    b.surfaces = all.surface;
    b.solid_angle_sr = all.solid_angle;
    b.area_lights = r->area_lights;
    for (int k = 0; k < 3; k++) {
        b.wo[k] = all.wo[k];
        b.wi[k] = all.wi[k];
        b.rgb[k] = all.rgb[k];
    }
    if (glint_eval_batch(r->material, &b) != GLINT_OK)
        exit(1);
}

typedef struct bench_case {
    const char *name;
    glint_model model;
    const glint_area_light *area_lights;
    float color_variation, facet_alpha;
    glint_distribution distribution;
} bench_case;

static const bench_case cases[] = {
    { "smooth", GLINT_MODEL_SMOOTH, NULL, 0.0F, 0.0F, GLINT_DISTRIBUTION_GGX },
    { "smooth, Beckmann", GLINT_MODEL_SMOOTH, NULL, 0.0F, 0.0F, GLINT_DISTRIBUTION_BECKMANN },
    { "smooth, sun", GLINT_MODEL_SMOOTH, all.sun, 0.0F, 0.0F, GLINT_DISTRIBUTION_GGX },
    { "smooth, rectangle", GLINT_MODEL_SMOOTH, all.rectangle, 0.0F, 0.0F, GLINT_DISTRIBUTION_GGX },
    { "counting", GLINT_MODEL_COUNTING, NULL, 0.0F, 0.0F, GLINT_DISTRIBUTION_GGX },
    { "counting, Beckmann", GLINT_MODEL_COUNTING, NULL, 0.0F, 0.0F, GLINT_DISTRIBUTION_BECKMANN },
    { "counting, rough facets", GLINT_MODEL_COUNTING, NULL, 0.0F, 0.01F, GLINT_DISTRIBUTION_GGX },
    { "counting, coloured", GLINT_MODEL_COUNTING, NULL, 0.5F, 0.0F, GLINT_DISTRIBUTION_GGX },
    { "counting, sun", GLINT_MODEL_COUNTING, all.sun, 0.0F, 0.0F, GLINT_DISTRIBUTION_GGX },
    { "counting, rectangle", GLINT_MODEL_COUNTING, all.rectangle, 0.0F, 0.0F, GLINT_DISTRIBUTION_GGX },
    { "dictionary", GLINT_MODEL_DICTIONARY, NULL, 0.0F, 0.0F, GLINT_DISTRIBUTION_BECKMANN },
    { "dictionary, GGX", GLINT_MODEL_DICTIONARY, NULL, 0.0F, 0.0F, GLINT_DISTRIBUTION_GGX },
    { "example", GLINT_MODEL_EXAMPLE, NULL, 0.0F, 0.0F, GLINT_DISTRIBUTION_GGX },
};
enum { CASES = sizeof cases / sizeof cases[0] };

/* Ends the program where a material cannot be made. */
static runner runner_of(const bench_case *c)
{
    const glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    runner r = { .options = o, .area_lights = c->area_lights };
    r.options.model = c->model;
    r.options.distribution = c->distribution;
    r.options.color_variation = c->color_variation;
    r.options.facet_alpha = c->facet_alpha;
    char message[200] = "";
    if (glint_material_create(&r.options, &r.material, message, sizeof message) != GLINT_OK) {
        fprintf(stderr, "bench: %s: %s\n", c->name, message);
        exit(1);
    }
    return r;
}

/* False: there is no such case. */
static int run_alone(const char *name, int batches)
{
    for (int i = 0; i < CASES; i++)
        if (strcmp(cases[i].name, name) == 0) {
            runner r = runner_of(&cases[i]);
            fill();
            for (int k = 0; k < batches; k++)
                run(&r);
            glint_material_destroy(r.material);
            return 1;
        }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "count") == 0)
        return run_alone(argv[2], atoi(argv[3])) ? 0 : 1;
    const int rounds = argc > 2 ? atoi(argv[2]) : 40;
    FILE *const json = argc > 1 ? fopen(argv[1], "w") : NULL;
    if (json == NULL || rounds < 1) {
        fprintf(stderr, "usage: %s FILE.json [ROUNDS]\n", argv[0]);
        return 2;
    }
    static runner runners[CASES];
    static racer racers[CASES];
    fill();
    for (int i = 0; i < CASES; i++) {
        runners[i] = runner_of(&cases[i]);
        racers[i] = (racer){ cases[i].name, run, &runners[i] };
    }
    race_result result[CASES];
    race(racers, CASES, POINTS, rounds, result);
    race_print("one point, one light", racers, CASES, result);
    fprintf(json, "{\n");
    race_write(json, "one point, one light", racers, CASES, result);
    fprintf(json, "\n}\n");
    for (int i = 0; i < CASES; i++)
        glint_material_destroy(runners[i].material);
    return fclose(json) != 0;
}
