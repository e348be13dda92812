/* Shadows of surfaces seen from behind: a back lets rays see through, but no light, however that is found. Held to a
 * path tracer of three planes that only bounces and knows nothing of lights. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "maps.h"
#include "pictures.h"
#include "scenes.h"
#include "statistics.h"

#define PI 3.14159265358979323846

enum { BOUNCES = 2, SIDE = 32 };

/* A rectangle at one height; facing: 1 up, -1 down. */
typedef struct plate {
    double height, low[2], high[2];
    int facing;
    double albedo, glow;
} plate;

enum { FLOOR, LAMP, SHADE, PLATES };

/* The floor below a lamp, of which a plate hides a part. */
static void lay_out(plate p[PLATES], int shade_faces, double glow)
{
    p[FLOOR] = (plate){ 0.0, { -5.0, -5.0 }, { 5.0, 5.0 }, 1, 0.5, 0.0 };
    p[LAMP] = (plate){ 1.0, { -0.5, -0.5 }, { 0.5, 0.5 }, -1, 0.3, glow };
    p[SHADE] = (plate){ 0.5, { 0.05, -1.0 }, { 2.0, 1.0 }, shade_faces, 0.8, 0.0 };
}

/* ---- the tracer ---- */

static int meets(const plate *p, const double from[3], const double to[3], double *distance)
{
    if (to[1] == 0.0)
        return 0;
    *distance = (p->height - from[1]) / to[1];
    const double x = from[0] + *distance * to[0], z = from[2] + *distance * to[2];
    return *distance > 1e-9 && x > p->low[0] && x < p->high[0] && z > p->low[1] && z < p->high[1];
}

/* The nearest front; *back: the nearest back. */
static int nearest(const plate p[PLATES], const double from[3], const double to[3], double *distance, double *back)
{
    int found = -1;
    *distance = *back = (double)INFINITY;
    for (int i = 0; i < PLATES; i++) {
        double d;
        if (!meets(&p[i], from, to, &d))
            continue;
        const int is_front = p[i].facing * to[1] < 0.0;
        if (!is_front)
            *back = fmin(*back, d);
        if (is_front && d < *distance) {
            *distance = d;
            found = i;
        }
    }
    return found;
}

/* Light that leaves the floor's middle upwards, by one path. */
static double path(const plate p[PLATES], double sky, uint64_t *random)
{
    double from[3] = { 0.0, 0.0, 0.0 }, throughput = p[FLOOR].albedo, sum = 0.0;
    int at = FLOOR;
    for (int bounce = 0; bounce <= BOUNCES; bounce++) {
        const double r2 = random_uniform(random), turn = random_between(random, 0.0, 2.0 * PI), r = sqrt(r2);
        const double to[3] = { r * cos(turn), p[at].facing * sqrt(1.0 - r2), r * sin(turn) };
        double distance, back;
        const int found = nearest(p, from, to, &distance, &back);
        const int is_lit = back > distance || (found < 0 && isinf(back));
        if (found < 0)
            return sum + (is_lit ? throughput * sky : 0.0);
        if (bounce == BOUNCES)
            return sum;
        sum += is_lit ? throughput * p[found].glow : 0.0;
        throughput *= p[found].albedo;
        for (int k = 0; k < 3; k++)
            from[k] += distance * to[k];
        at = found;
    }
    return sum;
}

static moments trace_paths(const plate p[PLATES], double sky)
{
    moments m = { 0.0, 0.0, 0.0 };
    uint64_t random = 3;
    for (int i = 0; i < 1000000; i++)
        moments_add(&m, path(p, sky, &random));
    return m;
}

/* ---- the previewer ---- */

static void add_plate(scene *s, const plate *p)
{
    scene_material m = scenes_matte((float)p->albedo);
    m.emissive[0] = m.emissive[1] = m.emissive[2] = (float)p->glow;
    const float y = (float)p->height, x0 = (float)p->low[0], x1 = (float)p->high[0], z0 = (float)p->low[1],
                z1 = (float)p->high[1];
    /* Counter-clockwise from below, or from above. */
    const float down[18] = { x0, y, z0, x1, y, z0, x1, y, z1, x0, y, z0, x1, y, z1, x0, y, z1 };
    const float up[18] = { x0, y, z0, x1, y, z1, x1, y, z0, x0, y, z0, x0, y, z1, x1, y, z1 };
    scenes_add_instance(s, scenes_add_triangles(s, scenes_add_material(s, &m), p->facing > 0 ? up : down, 2), NULL,
                        s->instance_count);
}

static moments preview(const plate p[PLATES], const preview_sky *sky, const preview_environment *map)
{
    scene s = scenes_empty();
    for (int i = 0; i < PLATES; i++)
        add_plate(&s, &p[i]);
    const scene_camera c = pictures_from_above(1e-3F); /* through the lamp's back */
    preview_options o = pictures_options(&c);
    o.width = o.height = SIDE;
    o.bounces = BOUNCES;
    o.spp = 64;
    o.sky = sky ? sky : o.sky;
    o.environment = map;
    image i = pictures_render(&s, &o);
    moments m = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < SIDE * SIDE; k++)
        moments_add(&m, pictures_at(&i, "G", k % SIDE, k / SIDE));
    image_free(&i);
    scene_free(&s);
    return m;
}

static void assert_same(const char *what, const moments *found, const moments *expected)
{
    const double sigma = hypot(moments_standard_error(found), moments_standard_error(expected));
    printf("%s: %.5f, by bouncing alone %.5f, %.1f sigma\n", what, found->mean, expected->mean,
           (found->mean - expected->mean) / sigma);
    if (!(fabs(found->mean - expected->mean) <= 5.0 * sigma))
        fail_msg("%s: %.6g is not %.6g: %.1f sigma of %.2g", what, found->mean, expected->mean,
                 (found->mean - expected->mean) / sigma, sigma);
    assert_true(sigma < 0.01 * expected->mean);
}

static void a_back_hides_a_glowing_surface(void **state)
{
    (void)state;
    for (int facing = -1; facing <= 1; facing += 2) {
        plate p[PLATES];
        lay_out(p, facing, 2.0);
        const moments expected = trace_paths(p, 0.0), found = preview(p, NULL, NULL);
        assert_same(facing < 0 ? "lamp, front" : "lamp, back", &found, &expected);
    }
}

static void a_back_hides_the_sky(void **state)
{
    (void)state;
    static const preview_sky white = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };
    environment_map even = maps_even(64, 1.0F);
    const preview_environment map = maps_environment(&even);
    for (int facing = -1; facing <= 1; facing += 2) {
        plate p[PLATES];
        lay_out(p, facing, 0.0);
        const moments expected = trace_paths(p, 1.0), of_sky = preview(p, &white, NULL),
                      of_map = preview(p, NULL, &map);
        assert_same(facing < 0 ? "sky, front" : "sky, back", &of_sky, &expected);
        assert_same(facing < 0 ? "map, front" : "map, back", &of_map, &expected);
    }
    environment_map_free(&even);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_back_hides_a_glowing_surface),
        cmocka_unit_test(a_back_hides_the_sky),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
