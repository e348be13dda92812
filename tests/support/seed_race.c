#include "seed_race.h"

enum { AROUND = 7, AGAIN = 16 };

static const uint32_t CELL[2] = { 100U, 200U };
static const uint32_t SEED = 5U;

glint_example seed_race_example(int is_scattered)
{
    glint_example o = GLINT_EXAMPLE_INIT;
    o.size = 32;
    o.sigma_r = 0.02F;
    if (is_scattered) {
        o.placement = GLINT_EXAMPLE_SCATTERED;
        o.scale_variation = 0.2F;
        o.rotation_variation_rad = 3.0F;
    }
    return o;
}

size_t example_bytes(const example *e)
{
    const size_t tiles = example_tiles_before(e, EXAMPLE_LEAST_MAP_LEVEL, e->levels);
    const size_t maps = tiles * e->tiles.length + SLOPE_MOST_LENGTH;
    const slope_map *last = &e->overall.maps[e->overall.length - 1];
    return sizeof(*e) + (size_t)e->size * e->size * sizeof(example_texel) + tiles * sizeof(quarter_slopes) +
           maps * sizeof(slope_map) + (SLOPE_MAP_SIDE + 1) * sizeof(float) + last->first +
           (size_t)last->columns * last->rows;
}

seed_surface seed_race_export(const bench *b)
{
    const example *e = b->material.baked;
    const glint_example *o = &b->material.options.example;
    static seed_instance instances[2 * (2 * AROUND + 1) * (2 * AROUND + 1)];
    size_t count = 0;
    for (int j = -AROUND; j <= AROUND; j++)
        for (int i = -AROUND; i <= AROUND; i++) {
            const instance n = lattice_instance(&e->lattice, CELL[0], CELL[1], i, j, SEED);
            const matrix2 m = n.as.to_frame;
            instances[count++] = (seed_instance){ { (double)n.x, (double)n.y },
                                                  { (double)m.xx, (double)m.xy, (double)m.yx, (double)m.yy },
                                                  0 };
            if (o->placement == GLINT_EXAMPLE_SCATTERED)
                instances[count++] = (seed_instance){ { i + 0.5, j + 0.5 }, { 1, 0, 0, 1 }, 1 };
        }
    return seed_surface_export(o, sqrt((double)e->slope_variance), instances, count);
}

/* Whether place and slope of a seed are within this many deviations of what is asked for. */
static int matters(const seed_gaussian *g, const double slope[2], double deviations)
{
    for (int k = 0; k < 2; k++) {
        const seed_matrix j = g->jacobian;
        const double x = k ? j.yx : j.xx, y = k ? j.yy : j.xy;
        const double spread = x * x * g->place[0] + 2.0 * x * y * g->place[1] + y * y * g->place[2];
        const double variance = spread + g->roughness[2 * k], away = slope[k] - g->slope[k];
        if (away * away > deviations * deviations * variance)
            return 0;
    }
    return 1;
}

typedef struct query {
    double at[2], slope[2];
    seed_surface reached, mattering;
} query;

static query ask(const bench *b, const seed_surface *all, double sigma, double rms, int is_lit, uint64_t *random)
{
    const example *e = b->material.baked;
    const double reach =
        (double)SLOPE_REACH * hypot(sigma, (double)e->lattice.most_stretch * sqrt((double)e->lattice.seed_variance));
    query q = { .at = { random_uniform(random), random_uniform(random) } };
    q.reached.seeds = malloc(all->count * sizeof(seed_gaussian));
    for (size_t i = 0; i < all->count; i++)
        if (hypot(all->seeds[i].at[0] - q.at[0], all->seeds[i].at[1] - q.at[1]) < reach)
            q.reached.seeds[q.reached.count++] = all->seeds[i];
    assert_true(q.reached.count > 0);
    const seed_gaussian *below = &q.reached.seeds[random_bits(random) % (q.reached.count > 0 ? q.reached.count : 1)];
    for (int k = 0; k < 2; k++)
        q.slope[k] = is_lit ? below->slope[k] + sqrt(below->roughness[2 * k]) * random_between(random, -1.0, 1.0)
                            : random_between(random, -3.0 * rms, 3.0 * rms);
    q.mattering.seeds = malloc(q.reached.count * sizeof(seed_gaussian));
    for (size_t i = 0; i < q.reached.count; i++)
        if (matters(&q.reached.seeds[i], q.slope, (double)SLOPE_REACH))
            q.mattering.seeds[q.mattering.count++] = q.reached.seeds[i];
    return q;
}

static double rms_slope(const bench *b)
{
    const example *e = b->material.baked;
    double square = 0.0;
    for (uint32_t i = 0; i < e->size * e->size; i++) {
        const example_texel t = example_texel_at(e, i % e->size, i / e->size);
        square += (double)(t.slope[0] * t.slope[0] + t.slope[1] * t.slope[1]) / (2.0 * e->size * e->size);
    }
    return sqrt(square);
}

static example_footprint footprint_of(const query *q, double sigma)
{
    const float spread = (float)(sigma * sigma);
    return (example_footprint){
        { CELL[0], CELL[1] }, { (float)q->at[0], (float)q->at[1] }, { spread, 0.0F, spread }, 1.0F
    };
}

void seed_race_count(const bench *b, const seed_surface *all, double sigma_texels, int is_lit, int queries)
{
    const example *e = b->material.baked;
    const double sigma = sigma_texels / e->size, spread[3] = { sigma * sigma, 0.0, sigma * sigma }, rms = rms_slope(b);
    uint64_t random = 1;
    for (int i = 0; i < queries; i++) {
        const query q = ask(b, all, sigma, rms, is_lit, &random);
        const example_footprint f = footprint_of(&q, sigma);
        const float slope[2] = { (float)q.slope[0], (float)q.slope[1] };
        assert_true(example_density(e, &f, slope, 0.0F, SEED) >= 0.0F);
        assert_true(seed_surface_density(&q.reached, q.at, spread, q.slope, 0.0) >= 0.0);
        free(q.reached.seeds);
        free(q.mattering.seeds);
    }
}

seed_race seed_race_run(const bench *b, const seed_surface *all, double sigma_texels, int is_lit, int queries)
{
    const example *e = b->material.baked;
    const double sigma = sigma_texels / e->size, rms = rms_slope(b);
    const double spread[3] = { sigma * sigma, 0.0, sigma * sigma };
    uint64_t random = 1;
    moments square = { 0 }, value = { 0 };
    seed_race r = { 0 };
    double worst = 0.0, peak = 0.0;
    for (int i = 0; i < queries; i++) {
        const query q = ask(b, all, sigma, rms, is_lit, &random);
        const example_footprint f = footprint_of(&q, sigma);
        const float slope[2] = { (float)q.slope[0], (float)q.slope[1] };
        double own = 0.0, sum = 0.0, pruned = 0.0;
        const double begin = bench_seconds();
        for (int k = 0; k < AGAIN; k++)
            own += (double)example_density(e, &f, slope, 0.0F, SEED) / AGAIN;
        const double middle = bench_seconds();
        for (int k = 0; k < AGAIN; k++)
            sum += seed_surface_density(&q.reached, q.at, spread, q.slope, 0.0) / AGAIN;
        const double end = bench_seconds();
        for (int k = 0; k < AGAIN && q.mattering.count > 0; k++)
            pruned += seed_surface_density(&q.mattering, q.at, spread, q.slope, 0.0) / AGAIN;
        r.pruned_us += 1e6 * (bench_seconds() - end) / AGAIN / queries;
        r.own_us += 1e6 * (middle - begin) / AGAIN / queries;
        r.sum_us += 1e6 * (end - middle) / AGAIN / queries;
        r.seeds += (double)q.reached.count / queries;
        assert_true(pruned >= 0.0);
        moments_add(&square, (own - sum) * (own - sum));
        moments_add(&value, sum);
        worst = fmax(worst, fabs(own - sum));
        peak = fmax(peak, sum);
        free(q.reached.seeds);
        free(q.mattering.seeds);
    }
    r.rms = sqrt(square.mean) / value.mean;
    r.worst = worst / peak;
    return r;
}
