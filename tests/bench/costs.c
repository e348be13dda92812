/* Measures what the plan reckons with, and prints it as src/plan/cost_table.c: `./dev bench costs` builds it, then
 *
 *     build/release/bench/costs > src/plan/cost_table.c
 *
 * Each number is the least CPU time of several rounds, which a busy machine disturbs least; in a round everything takes
 * its turn, so that a change of the processor's pace falls on all. What a renderer does to a sample is the difference
 * of two pictures' times, over samples; set-up cancels in pictures of few and of many samples.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch_points.h"
#include "plan/cost_table.h"
#include "preview/preview.h"
#include "race.h"
#include "scenes.h"
#include "statistics.h"

enum { ROUNDS = 9, CALLS = 1500, FACETS = 100, SIDE = 48, FEW = 4, MANY = 16 };

static double cost[PLAN_COST_COUNT];
static double ltc_error[2], ltc_flips[2];

static const char *const names[PLAN_COST_COUNT] = {
    [PLAN_COST_CAMERA_RAY] = "CAMERA_RAY",
    [PLAN_COST_BOUNCE_RAY] = "BOUNCE_RAY",
    [PLAN_COST_SHADOW_RAY] = "SHADOW_RAY",
    [PLAN_COST_SMOOTH] = "SMOOTH",
    [PLAN_COST_COUNTED] = "COUNTED",
    [PLAN_COST_COUNTED_COLORS] = "COUNTED_COLORS",
    [PLAN_COST_DRAWN] = "DRAWN",
    [PLAN_COST_FADED] = "FADED",
    [PLAN_COST_DICTIONARY] = "DICTIONARY",
    [PLAN_COST_EXAMPLE] = "EXAMPLE",
    [PLAN_COST_EXPLICIT_FACET] = "EXPLICIT_FACET",
    [PLAN_COST_POINTS] = "POINTS",
    [PLAN_COST_LTC] = "LTC",
    [PLAN_COST_QUADRATURE] = "QUADRATURE",
    [PLAN_COST_COAT] = "COAT",
    [PLAN_COST_TEXTURE] = "TEXTURE",
    [PLAN_COST_NORMAL_MAP] = "NORMAL_MAP",
    [PLAN_COST_ALPHA] = "ALPHA",
    [PLAN_COST_ANISOTROPY] = "ANISOTROPY",
};

static void stop(const char *what)
{
    fprintf(stderr, "costs: %s\n", what);
    exit(1);
}

/* ---- calls of the library ---- */

static batch_points points;
static glint_surface surfaces[CALLS];
static glint_area_light lights[CALLS];
static glint_value values[CALLS];

/* Pixels of 100 facets, half vectors within the lobe, in a batch as the renderer has them. */
static void place(const glint_material_options *o, const glint_area_light *area)
{
    uint64_t random = 1;
    for (int i = 0; i < CALLS; i++) {
        const float x = (float)random_between(&random, -0.4, 0.4), y = (float)random_between(&random, -0.4, 0.4);
        const float wo[3] = { x, y, sqrtf(1.0F - x * x - y * y) }, wi[3] = { -y, x, wo[2] };
        glint_footprint f = { .dudx = 1e-3F, .dvdx = 2e-4F, .dvdy = 1e-3F };
        f.u = random_between(&random, -1.0, 1.0);
        f.v = random_between(&random, -1.0, 1.0);
        f.draw = (uint32_t)random_bits(&random);
        batch_points_place(&points, i, &f);
        batch_points_light(&points, i, wo, wi, 1e-2F);
        surfaces[i] = o->surface;
        if (area)
            lights[i] = *area;
    }
}

typedef struct contestant {
    plan_cost of;
    glint_material_options options;
    const glint_area_light *area;
    glint_material *material;
    double least_s;
} contestant;

static void run(contestant *c)
{
    place(&c->options, c->area);
    glint_batch b = batch_points_of(&points, CALLS);
    b.surfaces = surfaces;
    b.area_lights = c->area ? lights : NULL;
    b.values = values;
    const double start = race_now();
    if (glint_eval_batch(c->material, &b) != GLINT_OK)
        stop("no batch");
    c->least_s = fmin(c->least_s, race_now() - start);
}

/* One that both integrals take points of, and one that stands in the ground, so that the horizon cuts it. */
static const glint_area_light window = { .kind = GLINT_AREA_RECTANGLE,
                                         .two_sided = 1,
                                         .center = { 0.3F, 0.2F, 1.0F },
                                         .half_x = { 0.3F, 0.0F, 0.0F },
                                         .half_y = { 0.0F, 0.2F, 0.0F } };

static const glint_area_light wall = { .kind = GLINT_AREA_RECTANGLE,
                                       .two_sided = 1,
                                       .center = { 0.3F, 1.0F, 0.5F },
                                       .half_x = { 1.0F, 0.0F, 0.0F },
                                       .half_y = { 0.0F, 0.0F, 1.0F } };

static contestant *enter(contestant *c, plan_cost of, glint_model model, const glint_area_light *area)
{
    *c = (contestant){ of, GLINT_MATERIAL_OPTIONS_INIT, area, NULL, HUGE_VAL };
    c->options.model = model;
    return c;
}

static void measure_models(void)
{
    static contestant all[PLAN_COST_COUNT];
    contestant *c = all;
    enter(c++, PLAN_COST_COUNTED, GLINT_MODEL_COUNTING, NULL);
    enter(c++, PLAN_COST_FADED, GLINT_MODEL_COUNTING, NULL)->options.smooth_deviation = 1e5F;
    enter(c++, PLAN_COST_DRAWN, GLINT_MODEL_COUNTING, NULL)->options.draw_deviation = 1e5F;
    enter(c++, PLAN_COST_COUNTED_COLORS, GLINT_MODEL_COUNTING, NULL)->options.color_variation = 0.5F;
    enter(c++, PLAN_COST_SMOOTH, GLINT_MODEL_SMOOTH, NULL);
    enter(c++, PLAN_COST_POINTS, GLINT_MODEL_SMOOTH, &window);
    enter(c++, PLAN_COST_LTC, GLINT_MODEL_SMOOTH, &wall);
    enter(c++, PLAN_COST_QUADRATURE, GLINT_MODEL_SMOOTH, &wall)->options.area_light_method = GLINT_AREA_LIGHT_EXACT;
    enter(c++, PLAN_COST_DICTIONARY, GLINT_MODEL_DICTIONARY, NULL);
    enter(c++, PLAN_COST_EXPLICIT_FACET, GLINT_MODEL_EXPLICIT, NULL);
    enter(c++, PLAN_COST_EXAMPLE, GLINT_MODEL_EXAMPLE, NULL);
    const contestant *const end = c;
    char message[256];
    for (c = all; c < end; c++)
        if (glint_material_create(&c->options, &c->material, message, sizeof message) != GLINT_OK)
            stop(message);
    for (int r = 0; r < ROUNDS; r++)
        for (c = all; c < end; c++)
            run(c);
    for (c = all; c < end; c++) {
        cost[c->of] = 1e9 * c->least_s / CALLS;
        glint_material_destroy(c->material);
    }
    cost[PLAN_COST_EXPLICIT_FACET] /= FACETS;
}

/* Lights from a tenth of a steradian up, at all angles; relative to the light that there is, and to the facets that are
 * lit. */
static void measure_ltc(glint_distribution distribution, double *error, double *flips)
{
    static const glint_footprint pixel = { .dudx = 1e-3F, .dvdy = 1e-3F };
    uint64_t random = 3;
    double square = 0.0, light = 0.0, turned = 0.0, lit = 0.0;
    for (int k = 0; k < 600; k++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        glint_material *fast, *exact;
        o.distribution = distribution;
        o.surface.alpha_x = o.surface.alpha_y = (float)random_log_between(&random, 0.03, 1.0);
        if (glint_material_create(&o, &fast, NULL, 0) != GLINT_OK)
            stop("no material");
        o.area_light_method = GLINT_AREA_LIGHT_EXACT;
        if (glint_material_create(&o, &exact, NULL, 0) != GLINT_OK)
            stop("no material");
        for (int i = 0; i < 10; i++) {
            const double angle = random_between(&random, 0.0, 1.3);
            const float wo[3] = { (float)sin(angle), 0.0F, (float)cos(angle) };
            glint_area_light at = window;
            for (int c = 0; c < 2; c++)
                at.center[c] = (float)random_between(&random, -1.5, 1.5);
            at.half_x[0] = (float)random_log_between(&random, 0.05, 1.0);
            at.half_y[1] = (float)random_log_between(&random, 0.05, 1.0);
            glint_value a, b;
            glint_eval_area(fast, NULL, &pixel, wo, &at, &a);
            glint_eval_area(exact, NULL, &pixel, wo, &at, &b);
            const double off = (double)a.smooth[0] - (double)b.smooth[0];
            square += off * off;
            light += (double)b.smooth[0] * (double)b.smooth[0];
            turned += fabs((double)a.lit_probability - (double)b.lit_probability);
            lit += (double)b.lit_probability;
        }
        glint_material_destroy(fast);
        glint_material_destroy(exact);
    }
    *error = sqrt(square / light);
    *flips = turned / lit;
}

/* ---- samples of pictures ---- */

typedef struct setting {
    bool lit, textured, bumpy, masked, coated, stretched, ball;
    int bounces;
} setting;

static scene make_scene(const setting *c)
{
    static const uint8_t gray[16] = { 200, 200, 200, 255, 180, 180, 180, 255, 180, 180, 180, 255, 200, 200, 200, 255 };
    static const uint8_t flat[16] = { 128, 128, 255, 255, 128, 128, 255, 255, 128, 128, 255, 255, 128, 128, 255, 255 };
    static const float from[3] = { 0.2F, 1.0F, 0.3F };
    scene s = scenes_empty();
    scene_material m = scene_material_default();
    m.metallic = 0.0F;
    m.roughness = 0.5F;
    if (c->textured || c->masked)
        m.base_color_texture = scenes_add_texture(&s, gray, 2, 2);
    if (c->bumpy)
        m.normal_texture = scenes_add_texture(&s, flat, 2, 2);
    if (c->masked)
        m.alpha_mode = SCENE_ALPHA_MASK;
    if (c->stretched)
        m.anisotropy = 0.5F;
    if (c->coated)
        m.clearcoat = 1.0F;
    const int material = scenes_add_material(&s, &m);
    scenes_add_instance(&s, scenes_add_square(&s, material, 1.0F), NULL, 0);
    if (c->ball)
        scenes_add_instance(&s, scenes_add_sphere(&s, material, 0.3F, 32, 16), NULL, 1);
    /* A black one, so that there is no studio and no sky, to see which rays would leave every surface. */
    scenes_add_light(&s, SCENE_LIGHT_POINT, from, c->lit ? 1.0F : 0.0F);
    return s;
}

static double render_s(const scene *s, const preview_options *from, int spp, preview_statistics *statistics)
{
    preview_options o = *from;
    image picture;
    report r = { 0 };
    o.spp = spp;
    const double start = race_now();
    if (!preview_render(s, &o, &picture, statistics, &r))
        stop(r.error);
    const double seconds = race_now() - start;
    image_free(&picture);
    return seconds;
}

enum { BARE, DIRECT, BOUNCED, LIT, TEXTURED, BUMPY, MASKED, COATED, STRETCHED, PICTURES };

static const setting settings[PICTURES] = {
    [DIRECT] = { .ball = true, .lit = true },
    [BOUNCED] = { .ball = true, .lit = true, .bounces = 1 },
    [LIT] = { .lit = true },
    [TEXTURED] = { .textured = true },
    [BUMPY] = { .bumpy = true },
    [MASKED] = { .masked = true },
    [COATED] = { .lit = true, .coated = true },
    [STRETCHED] = { .lit = true, .stretched = true },
};

/* ns a sample; *bounce_rays: those of a sample of BOUNCED. */
static void measure_pictures(double ns[PICTURES], double *bounce_rays)
{
    static const float eye[3] = { 0.0F, 1.0F, 1e-4F }, target[3] = { 0.0F, 0.0F, 0.0F };
    const scene_camera camera = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, 0.9F);
    const double samples = (double)SIDE * SIDE * (MANY - FEW);
    double few_s[PICTURES], many_s[PICTURES];
    scene scenes[PICTURES];
    for (int i = 0; i < PICTURES; i++) {
        scenes[i] = make_scene(&settings[i]);
        few_s[i] = many_s[i] = HUGE_VAL;
    }
    for (int r = 0; r < ROUNDS; r++)
        for (int i = 0; i < PICTURES; i++) {
            preview_options o = PREVIEW_OPTIONS_INIT;
            preview_statistics few, many;
            o.width = o.height = SIDE;
            o.bounces = settings[i].bounces;
            o.threads = 1;
            o.camera = &camera;
            few_s[i] = fmin(few_s[i], render_s(&scenes[i], &o, FEW, &few));
            many_s[i] = fmin(many_s[i], render_s(&scenes[i], &o, MANY, &many));
            if (i == BOUNCED)
                *bounce_rays = (double)(many.bounce_rays - few.bounce_rays) / samples;
        }
    for (int i = 0; i < PICTURES; i++) {
        ns[i] = 1e9 * (many_s[i] - few_s[i]) / samples;
        scene_free(&scenes[i]);
    }
}

static void measure_samples(void)
{
    double ns[PICTURES], rays;
    measure_pictures(ns, &rays);
    cost[PLAN_COST_CAMERA_RAY] = ns[BARE];
    cost[PLAN_COST_BOUNCE_RAY] = (ns[BOUNCED] - ns[DIRECT]) / rays;
    cost[PLAN_COST_SHADOW_RAY] = ns[LIT] - ns[BARE] - cost[PLAN_COST_SMOOTH];
    cost[PLAN_COST_TEXTURE] = ns[TEXTURED] - ns[BARE];
    cost[PLAN_COST_NORMAL_MAP] = ns[BUMPY] - ns[BARE];
    cost[PLAN_COST_ALPHA] = ns[MASKED] - ns[TEXTURED];
    cost[PLAN_COST_COAT] = ns[COATED] - ns[LIT];
    cost[PLAN_COST_ANISOTROPY] = ns[STRETCHED] - ns[LIT];
}

int main(void)
{
    measure_models();
    measure_samples();
    measure_ltc(GLINT_DISTRIBUTION_GGX, &ltc_error[0], &ltc_flips[0]);
    measure_ltc(GLINT_DISTRIBUTION_BECKMANN, &ltc_error[1], &ltc_flips[1]);
    puts("/* What things cost and how far they are off. Measured, and written, by tests/bench/costs.c:\n"
         " *\n"
         " *     ./dev bench costs && build/release/bench/costs > src/plan/cost_table.c && ./dev format\n"
         " */\n"
         "#include \"plan/cost_table.h\"\n\n"
         "const float plan_costs[PLAN_COST_COUNT] = {");
    /* Below the noise of the measurement something costs nothing. */
    for (int i = 0; i < PLAN_COST_COUNT; i++)
        printf("    [PLAN_COST_%s] = %.1fF,\n", names[i], fmax(cost[i], 0.0));
    printf("};\n\nconst float plan_ltc_errors[2] = { %.2gF, %.2gF };\n", ltc_error[0], ltc_error[1]);
    printf("const float plan_ltc_flips[2] = { %.2gF, %.2gF };\n", ltc_flips[0], ltc_flips[1]);
    return 0;
}
