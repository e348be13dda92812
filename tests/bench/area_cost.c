/* What lights of real size cost over a point light, in the counting model: the same points under the same views.
 *
 *     area_cost FILE.json [ROUNDS]   races all kinds
 *     area_cost count KIND N         evaluates N points and says nothing: for programs that count instructions
 *
 * KIND: point, sun, sphere, rectangle, disk or polygon, all of a thousandth to one steradian within 30 degrees of the
 * mirrored view, on GGX of alpha = .2; mixed: kinds, sizes, places and roughnesses at random; mixed-point: what mixed
 * is, as a point.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "race.h"
#include "study/area_cases.h"

enum { CASES = 256, KINDS = 8 };

static const char *const kind_names[KINDS] = { "point", "sun",     "sphere", "rectangle",
                                               "disk",  "polygon", "mixed",  "mixed-point" };

/* One point: its light as a shape and as a cap around the same direction. */
typedef struct cost_case {
    glint_material *material;
    glint_footprint footprint;
    float wo[3], wi[3];
    glint_light cap;
    glint_area_light light;
    int is_cap;
} cost_case;

static void turn_to(float v[3], const float from[3], const float away[3], float by)
{
    for (int k = 0; k < 3; k++)
        v[k] = from[k] + by * away[k];
    area_unit(v);
}

static glint_material *material_of(const area_truth_lobe *lobe)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.distribution = lobe->is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    o.surface.alpha_x = o.surface.alpha_y = (float)lobe->alpha_x;
    o.surface.facets_per_m2 = 1e8F;
    glint_material *m = NULL;
    if (glint_material_create(&o, &m, NULL, 0) != GLINT_OK)
        exit(1);
    return m;
}

/* A light near the mirrored view. */
static area_case near_case(uint64_t *random, glint_area_kind kind)
{
    area_case c = { .roughness = sqrt(0.2), .lobe = { 0, 0.2, 0.2 } };
    c.view = random_between(random, 0.0, 75.0 * AREA_PI / 180.0);
    c.wo[0] = (float)sin(c.view);
    c.wo[2] = (float)cos(c.view);
    const float mirrored[3] = { -c.wo[0], 0.0F, c.wo[2] };
    float away[3], d[3];
    for (int k = 0; k < 3; k++)
        away[k] = (float)random_between(random, -1.0, 1.0);
    area_unit(away);
    turn_to(d, mirrored, away, (float)random_between(random, 0.0, 0.5));
    d[2] = fabsf(d[2]);
    c.light = area_light_towards(random, kind, d, random_log_between(random, 1e-3, 1.0));
    return c;
}

static cost_case cost_case_of(uint64_t *random, int kind)
{
    const int is_mixed = kind >= 6, is_cap = kind == 0 || kind == 7;
    const area_case a =
        is_mixed ? area_case_of(random, 0) : near_case(random, kind > 0 ? (glint_area_kind)(kind - 1) : GLINT_AREA_SUN);
    cost_case c = { .material = material_of(&a.lobe),
                    .footprint = { random_between(random, 0.0, 1.0), random_between(random, 0.0, 1.0), 1e-3F, 2e-4F,
                                   -1e-4F, 2e-3F, 7U },
                    .cap = { GLINT_LIGHT_CAP, a.light.solid_angle_sr },
                    .light = a.light,
                    .is_cap = is_cap };
    memcpy(c.wo, a.wo, sizeof c.wo);
    memcpy(c.wi, a.light.center, sizeof c.wi);
    c.wi[2] = fmaxf(c.wi[2], 1e-3F);
    area_unit(c.wi);
    return c;
}

static float evaluate(const cost_case *c)
{
    glint_value v;
    if (c->is_cap)
        glint_eval_value(c->material, NULL, &c->footprint, c->wo, c->wi, &c->cap, &v);
    else
        glint_eval_area(c->material, NULL, &c->footprint, c->wo, &c->light, &v);
    return v.rgb[0];
}

static float evaluate_all(const cost_case *cases, long count)
{
    float sum = 0.0F;
    for (long i = 0; i < count; i++)
        sum += evaluate(&cases[i % CASES]);
    return sum;
}

static void make_cases(cost_case cases[CASES], int kind)
{
    uint64_t random = 17;
    for (int i = 0; i < CASES; i++)
        cases[i] = cost_case_of(&random, kind);
}

static void free_cases(cost_case cases[CASES])
{
    for (int i = 0; i < CASES; i++)
        glint_material_destroy(cases[i].material);
}

/* One racer: a kind's cases, and a sum that keeps the compiler from leaving them out. */
typedef struct cost_runner {
    cost_case cases[CASES];
    float sum;
} cost_runner;

static void run(void *user)
{
    cost_runner *r = user;
    r->sum += evaluate_all(r->cases, CASES);
}

/* Kinds from first on, over the first of them. */
static void race_kinds(FILE *json, const char *title, const int *kinds, size_t count, int rounds)
{
    static cost_runner runners[KINDS];
    racer racers[KINDS] = { { NULL, NULL, NULL } };
    race_result result[KINDS];
    for (size_t i = 0; i < count; i++) {
        make_cases(runners[i].cases, kinds[i]);
        racers[i] = (racer){ kind_names[kinds[i]], run, &runners[i] };
    }
    race(racers, count, CASES, rounds, result);
    race_print(title, racers, count, result);
    race_write(json, title, racers, count, result);
    for (size_t i = 0; i < count; i++)
        free_cases(runners[i].cases);
}

static int race_all(const char *path, int rounds)
{
    static const int near[] = { 0, 1, 2, 3, 4, 5 }, mixed[] = { 7, 6 };
    FILE *const json = fopen(path, "w");
    if (!json || rounds < 1) {
        fprintf(stderr, "area_cost: %s cannot be written\n", path);
        return 1;
    }
    fputs("{\n", json);
    race_kinds(json, "a light near the mirrored view", near, 6, rounds);
    fputs(",\n", json);
    race_kinds(json, "any light", mixed, 2, rounds);
    fputs("\n}\n", json);
    return fclose(json) != 0;
}

static int count(const char *kind, long n)
{
    static cost_case cases[CASES];
    for (int k = 0; k < KINDS; k++)
        if (strcmp(kind, kind_names[k]) == 0) {
            make_cases(cases, k);
            const float sum = evaluate_all(cases, n);
            free_cases(cases);
            return sum >= 0.0F ? 0 : 1;
        }
    fprintf(stderr, "area_cost: unknown kind '%s'\n", kind);
    return 2;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "count") == 0)
        return count(argv[2], strtol(argv[3], NULL, 10));
    if (argc == 2 || argc == 3)
        return race_all(argv[1], argc == 3 ? (int)strtol(argv[2], NULL, 10) : 200);
    fputs("usage: area_cost FILE.json [ROUNDS] | count KIND N\n", stderr);
    return 2;
}
