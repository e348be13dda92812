/* The fast integral's lights: what a lobe takes in of a light whose directions its matrix has moved, against the same
 * integral in long double. Lights of 10^-7 radians lose all of their digits in float; narrow lobes stretch others a
 * thousand times. No floating-point exception is raised. */
#define _GNU_SOURCE
#include "traps.h"

#include "light/ltc.h"
#include "wide_lights.h"

static const double ROUNDING = (double)DOUBLE_ROUNDING;

static ltc random_lobe(uint64_t *random)
{
    const double theta = random_between(random, 0.0, 1.56), phi = random_between(random, 0.0, 6.2831853);
    const ndf_kind kind = random_bits(random) & 1U ? NDF_GGX : NDF_BECKMANN;
    return ltc_find_base(kind, random_log_between(random, 1e-4, 1.0),
                         (vec3d){ sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) });
}

/* By the matrix, and how many roundings its direction may be off: three products and two sums a component. */
static wide3 moved(const ltc *l, vec3d v, wide *off)
{
    const vec3d *const a = &l->row[0], *const b = &l->row[1];
    const wide3 to = { (wide)a->x * (wide)v.x + (wide)a->y * (wide)v.y + (wide)a->z * (wide)v.z,
                       (wide)b->x * (wide)v.x + (wide)b->y * (wide)v.y, (wide)v.z };
    const wide terms = fabsl((wide)a->x * (wide)v.x) + fabsl((wide)a->y * (wide)v.y) + fabsl((wide)a->z * (wide)v.z) +
                       fabsl((wide)b->x * (wide)v.x) + fabsl((wide)b->y * (wide)v.y);
    *off = 3.0L * terms / length_of(to);
    return to;
}

static void moved_polygons_keep_their_share(void **state)
{
    (void)state;
    worst_error worst = { 0 };
    uint64_t random = 61;
    long seen = 0;
    for (int i = 0; i < 200000; i++) {
        const ltc l = random_lobe(&random);
        const double size = random_log_between(&random, 1e-7, 10.0);
        vec3d c = random_vector(&random, 1.0);
        c.z = fabs(c.z);
        const vec3d x = random_vector(&random, size), y = random_vector(&random, size);
        const vec3d v[4] = { c, vec3d_add(c, x), vec3d_mad(vec3d_add(c, x), y, 0.7), vec3d_add(c, y) };
        wide3 corner[4];
        wide off[4], reach, sides = 0.0L;
        int is_above = 1;
        for (int k = 0; k < 4; k++) {
            is_above &= v[k].z > 0.0;
            corner[k] = moved(&l, v[k], &off[k]);
            off[k] += 4.0L; /* made unit */
        }
        area_light light;
        ltc_light out;
        area_make_polygon(&light, v, 4, 1);
        if (!is_above || light.kind != AREA_POLYGON || !ltc_move_base(&l, &light, &out))
            continue;
        seen++;
        const wide exact = fabsl(polygon_truth(corner, off, 4, &reach).z) / WIDE_PI;
        for (int k = 0; k < 4; k++) {
            const wide3 normal = cross(corner[k], mad(corner[(k + 1) % 4], corner[k], -1.0L));
            const wide flat = length_of(normal);
            sides += flat > 0.0L ? fabsl(normal.z) / flat * atan2l(flat, dot(corner[k], corner[(k + 1) % 4])) : 0.0L;
        }
        /* The angle over its sine is a fit, good to 3e-9 (light/ltc_move.c), and each side may be off by that;
         * roundings of the outline besides. */
        worst_add(&worst, (wide)out.share - exact,
                  (3e-9L * 0.5L * sides + (reach + 8.0L) * DOUBLE_ROUNDING * fminl(1.0L, sides)) / WIDE_PI, size,
                  (double)exact, i);
    }
    printf("%ld polygons\n", seen);
    assert_true(seen > 50000);
    assert_true(worst_holds(&worst, "share of moved polygons (absolute)", ROUNDING));
}

static void moved_ellipses_keep_their_share(void **state)
{
    (void)state;
    worst_error worst = { 0 };
    uint64_t random = 62;
    long seen = 0;
    for (int i = 0; i < 6000; i++) {
        const ltc l = random_lobe(&random);
        const double size = random_log_between(&random, 1e-7, 0.6);
        vec3d c = random_vector(&random, 1.0);
        c.z = fabs(c.z);
        const vec3d x = random_vector(&random, size), y = random_vector(&random, size);
        if (c.z < sqrt(x.z * x.z + y.z * y.z))
            continue;
        wide off[3];
        const wide3 to = moved(&l, c, &off[0]), along = moved(&l, x, &off[1]), across = moved(&l, y, &off[2]);
        /* Not nearly edge-on, and no larger than it is far: the quadrature would need more pieces. */
        const wide facing = fabsl(dot(cross(along, across), to)) / length_of(to);
        const wide longest = fmaxl(length_of(along), length_of(across));
        if (facing < 0.05L * length_of(along) * length_of(across) || longest > length_of(to))
            continue;
        area_light light;
        ltc_light out;
        area_make_ellipse(&light, c, x, y, 1);
        if (light.kind != AREA_CONIC || !ltc_move_base(&l, &light, &out))
            continue;
        seen++;
        const wide exact = fabsl(arc_integral(to, along, across, 0.0L, 2.0L * WIDE_PI).z) / WIDE_PI;
        /* As of ellipses that nothing moves (test_area_precision.c): two dozen roundings, 1 / .05 of them, and the axis
         * askew, squared, over the light's width. What the matrix leaves comes on top, once for each of three vectors.
         */
        const wide width = facing / longest / length_of(to);
        const wide askew = (4.0L + off[0]) * DOUBLE_ROUNDING / width;
        worst_add(&worst, relative_error(out.share, exact),
                  20.0L * (24.0L + off[0] + off[1] + off[2]) * DOUBLE_ROUNDING + askew * askew, size, (double)exact, i);
    }
    printf("%ld ellipses\n", seen);
    assert_true(seen > 1000);
    assert_true(worst_holds(&worst, "share of moved ellipses", ROUNDING));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(moved_polygons_keep_their_share, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(moved_ellipses_keep_their_share, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
