/* The walk through many squares of the lattice at a time: every width gives the same bits, and what one square after
 * another gives but for the order of the sum. */
#include "example_bench.h"

#include <math.h>
#include <string.h>

#include "model/example_kernel.h"

enum { SIZE = 32, QUERIES = 400 };

static void make(bench *b, int mirror, int flat)
{
    glint_example o = GLINT_EXAMPLE_INIT;
    o.size = SIZE;
    o.sigma_r = 0.02F;
    o.mirror = mirror;
    o.flat = flat;
    bench_make(b, GLINT_EXAMPLE_ISOTROPIC_NOISE, &o);
}

/* A footprint that reaches farther than an example is wide, and a slope that one of its texels has. */
typedef struct query {
    example_footprint f;
    float slope[2];
    question q;
    example_view views[LATTICE_MIRRORED];
    example_squares squares;
} query;

static void ask(const example *e, uint64_t *random, query *a)
{
    const double long_axis = random_between(random, 0.15, 0.5), turn = random_between(random, 0.0, 3.14159265);
    const double short_axis = long_axis * random_between(random, 0.6, 1.0);
    const double c = cos(turn), s = sin(turn), l2 = long_axis * long_axis, s2 = short_axis * short_axis;
    a->f = (example_footprint){ .at = { (float)random_uniform(random), (float)random_uniform(random) },
                                .spread = { (float)(c * c * l2 + s * s * s2), (float)(c * s * (l2 - s2)),
                                            (float)(s * s * l2 + c * c * s2) },
                                .share = 1.0F };
    const example_texel t = example_texel_at(e, random_bits(random) % SIZE, random_bits(random) % SIZE);
    for (int k = 0; k < 2; k++)
        a->slope[k] = t.slope[k] + (float)random_between(random, -0.05, 0.05);
    a->q =
        (question){ .e = e, .f = &a->f, .slope = a->slope, .light_variance = (float)random_between(random, 0.0, 1e-3) };
    for (uint32_t k = 0; k < e->lattice.kinds; k++) {
        const instance self = { 0.5F, 0.5F, e->lattice.variants[k] };
        a->views[k] = example_view_of(&a->q, &self);
        a->views[k].wants_mass = random_bits(random) % 2 == 0;
        a->views[k].wants_mass = a->views[0].wants_mass;
    }
    /* As many as it takes to fill several vectors and a part of one; all within the footprint's box. */
    a->squares.count = 1 + random_bits(random) % 40;
    for (size_t i = 0; i < a->squares.count; i++) {
        a->squares.x[i] =
            (float)random_between(random, -0.9, 1.9) * (a->views->half[0] < 0.9F ? a->views->half[0] : 0.9F);
        a->squares.y[i] =
            (float)random_between(random, -0.9, 1.9) * (a->views->half[1] < 0.9F ? a->views->half[1] : 0.9F);
        a->squares.kind[i] = (int32_t)(random_bits(random) % e->lattice.kinds);
    }
}

static gathered one_by_one(query *a)
{
    gathered sum = { 0 };
    for (size_t i = 0; i < a->squares.count; i++) {
        example_view v = a->views[a->squares.kind[i]];
        v.mean[0] = a->squares.x[i];
        v.mean[1] = a->squares.y[i];
        example_descend(&v, 0, &sum);
    }
    return sum;
}

static void assert_near(double found, double expected, double relative)
{
    if (fabs(found - expected) > relative * expected)
        fail_msg("found %.9g, expected %.9g within %.2g of it", found, expected, relative);
}

typedef struct width {
    size_t lanes;
    example_look *look;
} width;

static const width widths[] = {
    { 1, example_look_1 },
#if defined(__x86_64__) || defined(__aarch64__)
    { 4, example_look_4 },
#endif
#if defined(__x86_64__)
    { 8, example_look_8 },
    { 16, example_look_16 },
#endif
};

static void check(query *a, int *lit)
{
    gathered first = { 0 };
    for (size_t w = 0; w < sizeof(widths) / sizeof(widths[0]); w++) {
        if (machine_lanes(widths[w].lanes) != widths[w].lanes)
            continue;
        gathered sum = { 0 };
        widths[w].look(a->views, &a->squares, &sum);
        if (w == 0)
            first = sum;
        assert_memory_equal(&sum, &first, sizeof(sum));
    }
    /* Each addition rounds by 2^-24 of the sum at most; there is one for each texel of each square at most. */
    const double rounding = (double)(a->squares.count * SIZE * SIZE) * 0x1p-24;
    const gathered single = one_by_one(a);
    assert_near((double)first.value, (double)single.value, rounding);
    if (a->views->wants_mass)
        assert_near((double)first.mass, (double)single.mass, rounding);
    *lit += single.value > 0.0F;
}

static void every_width_agrees_with_one_square_after_another(void **state)
{
    (void)state;
    for (int mirror = 0; mirror < 2; mirror++)
        for (int flat = 0; flat < 2; flat++) {
            bench b;
            make(&b, mirror, flat);
            uint64_t random = 5;
            int lit = 0;
            for (int i = 0; i < QUERIES; i++) {
                static query a;
                ask(b.material.baked, &random, &a);
                check(&a, &lit);
            }
            assert_true(lit > QUERIES / 2);
            bench_free(&b);
        }
}

/* ---- the largest footprint ---- */

/* A pixel far wider than what is looked at, on the smallest map with the widest texels, with its middle at (x, y) of a
 * square. */
static question widest_question(const bench *b, float x, float y, example_footprint *f, const float slope[2])
{
    const example *e = b->material.baked;
    const glint_footprint pixel = { 0.0, 0.0, 50.0F, 0.0F, 0.0F, 50.0F, 0U };
    const glint_surface surface = b->material.options.surface;
    const model_query q = { .material = &b->material, .surface = &surface, .footprint = &pixel };
    assert_true(lattice_footprint(&e->lattice, &q, 1.0F, f));
    f->at[0] = x;
    f->at[1] = y;
    const question widest = { .e = e, .f = f, .slope = slope, .light_variance = 1e-4F };
    const double half = 3.5 * sqrt((double)f->spread.xx + (double)e->lattice.seed_variance);
    assert_true(half > 7.0 && half < 7.5); /* wider than which a side may hold seventeen squares */
    question found = widest;
    found.reach = (extent){ { x, y }, { (float)half, (float)half }, (float)half };
    return found;
}

/* Squares from floor(at - half) to floor(at + half). */
static int squares_along(double at, double half)
{
    return (int)(floor(at + half) - floor(at - half)) + 1;
}

static double sum_of_squares(const question *q, int half)
{
    gathered sum = { 0 };
    for (int j = -half; j <= half; j++)
        for (int i = -half; i <= half; i++) {
            const instance self = lattice_instance(&q->e->lattice, q->f->cell[0], q->f->cell[1], i, j, q->seed);
            example_view v = example_view_of(q, &self);
            v.wants_mass = 0;
            example_descend(&v, 0, &sum);
        }
    return (double)sum.value;
}

static void the_largest_footprint_fills_the_room_and_loses_no_square(void **state)
{
    (void)state;
    glint_example o = GLINT_EXAMPLE_INIT;
    o.size = 8;
    o.sigma_h = 1.0F;
    o.side_m = 1.0F;
    o.mirror = 0U;
    bench b;
    bench_make(&b, GLINT_EXAMPLE_ISOTROPIC_NOISE, &o);
    static const float places[] = { 0.0F, 0.01F, 0.3F, 0.5F, 0.7F, 0.99F, 0.99999994F };
    enum { PLACES = sizeof(places) / sizeof(places[0]) };
    size_t most = 0;
    for (int k = 0; k < PLACES * PLACES; k++) {
        static example_squares squares;
        static float centre[2][EXAMPLE_MOST_SQUARES];
        example_footprint f;
        const example_texel t = example_texel_at(b.material.baked, (uint32_t)k % 8U, (uint32_t)k / 8U % 8U);
        const question q = widest_question(&b, places[k % PLACES], places[k / PLACES], &f, t.slope);
        const double half = (double)q.reach.half[0];
        example_find_squares(&q, &squares, centre);
        const int expected = squares_along((double)f.at[0], half) * squares_along((double)f.at[1], half);
        assert_int_equal(squares.count, expected);
        most = squares.count > most ? squares.count : most;
        for (size_t i = 1; i < squares.count; i++) /* row by row, and so none twice */
            assert_true(centre[1][i] > centre[1][i - 1] ||
                        (centre[1][i] == centre[1][i - 1] && centre[0][i] == centre[0][i - 1] + 1.0F));
        gathered sum = { 0 };
        example_gather_tiled(&q, 0, &sum);
        assert_near((double)sum.value, sum_of_squares(&q, 12), (double)(25 * 25 * 8 * 8) * 0x1p-24);
        assert_true(sum.value > 0.0F);
    }
    assert_int_equal(most, EXAMPLE_MOST_SQUARES);
    bench_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_width_agrees_with_one_square_after_another),
        cmocka_unit_test(the_largest_footprint_fills_the_room_and_loses_no_square),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
