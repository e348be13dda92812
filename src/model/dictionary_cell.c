/* The slope distribution of one cell: two marginals of the dictionary, rotated and scaled to the surface's roughness.
 *
 * Where this differs from the paper: Eq. 11 rotates before it scales, which for anisotropic roughness sums to
 * something else than the target; here the slope is first scaled to the dictionary's roughness, then rotated.
 *
 * GGX, which the paper leaves out: its slopes are a mixture of Gaussians of roughness alpha / sqrt(E), where E has the
 * density exp(-E). A cell takes E on a lattice in log E with a random shift. The mean over shifts is exact, and since
 * the integrand is smooth, so is each single cell up to 2e-4 (|Gamma(2 + 2 pi i / step)|).
 *
 * Coverage: a cell on the level where it has about one facet is there or not, with the paper's chance. A cell on a
 * coarser level stands for 4, 16, ... of those, and a binomial share of them is there; the paper drops such a cell as a
 * whole, so that a surface seen from far away never comes to its mean.
 */
#include "model/dictionary_cell.h"

#include <math.h>
#include <stddef.h>

#define GLINT_LANES 1
#include "math/binomial.h"
#include "math/hash.h"
#include "math/uniform.h"

#define LOG2_OF_E 1.44269504F
#define LN2 0.693147181F

/* The lattice of E: top exp(-step (j + shift)), j < LATTICE. Beyond top the integrand has 2e-6 of its weight; what is
 * below the lattice is one more scale. */
enum { LATTICE = DICTIONARY_MAX_SCALES - 1 };
#define SCALE_TOP 16.0F
#define SCALE_STEP 0.8F
#define SCALE_RATIO 0.449328964F /* exp(-step) */
#define SCALE_END 0.00241173F    /* top exp(-step LATTICE) */

/* No more facets than this are dealt to scales one by one: a float still tells one from none. */
#define MOST_DEALT 1048576.0F

/* Farthest that normal_quantile goes, in standard deviations. */
#define FARTHEST_NORMAL 5.5F

/* Which random number of a cell; each scale takes two more from DICTIONARY_FIRST_SCALE on. */
enum { DRAW_COVERAGE = 1, DRAW_DENSITY, DRAW_SHIFT, DRAW_TAIL, DRAW_DEAL };

static uint32_t draw(uint32_t cell, uint32_t which)
{
    return hash_full(cell + which * HASH_X);
}

/* In [0, 1): never 1, which would be the marginal after the last. */
static float uniform_of(uint32_t hash)
{
    return (float)(hash >> 8) * 0x1p-24F;
}

static float normal_of(uint32_t hash)
{
    return normal_quantile((float)(hash >> 8) * 0x1p-23F - (1.0F - 0x1p-24F));
}

/* 4^x for x in [-60, 60]. */
static float exp4(float x)
{
    const float whole = floorf(2.0F * x);
    /* exp_negative takes no argument above 0. */
    return 2.0F * exp2_i((int)whole) * exp_negative((2.0F * x - whole - 1.0F) * LN2);
}

/* How many of the 4^grain_level grains of a cell are there, over all of them. */
float dictionary_cell_coverage(const dictionary_surface *surface, uint32_t hash, int grain_level)
{
    if (surface->coverage >= 1.0F)
        return 1.0F;
    const uint32_t first = draw(hash, DRAW_COVERAGE);
    if (grain_level == 0)
        return uniform_of(first) < surface->coverage ? 1.0F : 0.0F;
    const float grains = exp2_i(2 * grain_level);
    const binomial_chance chance = binomial_chance_of(surface->coverage);
    return fminf(binomial_draw(grains, &chance, (vint)first, 0.0F) / grains, 1.0F);
}

/* ---- scales ---- */

typedef struct scale_set {
    int count;
    float e[DICTIONARY_MAX_SCALES];
    float share[DICTIONARY_MAX_SCALES]; /* sum 1 */
} scale_set;

static void ggx_scales(scale_set *set, uint32_t cell)
{
    float e = SCALE_TOP * exp_negative(-SCALE_STEP * uniform_of(draw(cell, DRAW_SHIFT))), sum = 0.0F;
    for (int j = 0; j < LATTICE; j++) {
        set->e[j] = e;
        set->share[j] = SCALE_STEP * e * exp_negative(-e);
        sum += set->share[j];
        e *= SCALE_RATIO;
    }
    /* Below the lattice exp(-E) is 1 and E uniform. */
    set->e[LATTICE] = SCALE_END * (uniform_of(draw(cell, DRAW_TAIL)) + 0x1p-25F);
    set->share[LATTICE] = SCALE_END;
    sum += SCALE_END;
    for (int j = 0; j <= LATTICE; j++)
        set->share[j] /= sum;
    set->count = DICTIONARY_MAX_SCALES;
}

/* One product of marginals with 4^log4_facets facets. */
static dictionary_lobes make_lobes(const dictionary_surface *surface, uint32_t hash, float weight, float e,
                                   float log4_facets)
{
    dictionary_lobes l = { weight, sqrtf(e), 1.0F, 0.0F, NULL, NULL };
    const int level = dictionary_level(fmaxf(log4_facets, 0.0F));
    if (level >= DICTIONARY_LEVELS)
        return l;
    /* Half a turn will do: the product of even functions does not change in the other half. */
    sincos_pi(uniform_of(draw(hash, DICTIONARY_TURN)), &l.sine, &l.cosine);
    const dictionary_marginal *marginal = surface->table->marginal[level];
    const uint32_t pick = draw(hash, DICTIONARY_PICK);
    l.along = marginal[(pick >> 16) * DICTIONARY_MARGINALS >> 16];
    l.across = marginal[(pick & 0xffffU) * DICTIONARY_MARGINALS >> 16];
    return l;
}

/* Deals the facets to scales by systematic sampling: scale j gets share_j of them in the mean, a whole number each
 * time.
 */
static void deal_to_scales(dictionary_cell_slopes *s, const dictionary_surface *surface, uint32_t cell,
                           float log4_facets)
{
    scale_set set;
    ggx_scales(&set, cell);
    const float facets = exp4(log4_facets);
    const float dealt = facets < MOST_DEALT ? floorf(facets + 0.5F) : MOST_DEALT;
    const float start = uniform_of(draw(cell, DRAW_DEAL));
    float below = 0.0F, last = 0.0F; /* floor(start) */
    for (int j = 0; j < set.count; j++) {
        below += set.share[j];
        const float next = j + 1 < set.count ? floorf(dealt * below + start) : dealt;
        const float share = (next - last) / dealt;
        last = next;
        if (share > 0.0F)
            s->lobes[s->count++] = make_lobes(surface, draw(cell, DICTIONARY_FIRST_SCALE + (uint32_t)j), share,
                                              set.e[j], log4_facets + 0.5F * LOG2_OF_E * log_f(share));
    }
}

int dictionary_is_smooth(const dictionary_surface *surface, float log4_facets)
{
    return log4_facets - FARTHEST_NORMAL * surface->density_variation >= (float)DICTIONARY_LEVELS - 0.5F;
}

float dictionary_cell_log4(const dictionary_surface *surface, uint32_t hash, float log4_facets, float coverage)
{
    float x = coverage < 1.0F ? log4_facets + 0.5F * LOG2_OF_E * log_f(coverage) : log4_facets;
    if (surface->density_variation > 0.0F)
        x += surface->density_variation * normal_of(draw(hash, DRAW_DENSITY));
    /* No fewer than one facet, and no more than the dictionary tells from infinitely many. */
    x = x > 0.0F ? x : 0.0F;
    return x < (float)DICTIONARY_LEVELS ? x : (float)DICTIONARY_LEVELS;
}

void dictionary_cell_find(dictionary_cell_slopes *s, const dictionary_surface *surface, uint32_t hash,
                          float log4_facets)
{
    s->count = 0;
    if (dictionary_level(log4_facets) >= DICTIONARY_LEVELS)
        return;
    if (surface->target.kind == NDF_GGX)
        deal_to_scales(s, surface, hash, log4_facets);
    else
        s->lobes[s->count++] = make_lobes(surface, draw(hash, DICTIONARY_FIRST_SCALE), 1.0F, 1.0F, log4_facets);
}

float dictionary_cell_facets(float log4_facets)
{
    return exp4(log4_facets);
}

/* ---- density ---- */

static float gaussian_density(float x)
{
    const float z2 = x * x * (1.0F / (DICTIONARY_ALPHA * DICTIONARY_ALPHA));
    return z2 < 87.0F ? exp_negative(-z2) * (1.0F / (DICTIONARY_ALPHA * 1.77245385F)) : 0.0F;
}

/* P22 of the dictionary at slope (x, y) of the dictionary's roughness. */
static float lobes_density(const dictionary_lobes *l, float x, float y)
{
    x *= l->scale;
    y *= l->scale;
    if (!l->along)
        return gaussian_density(x) * gaussian_density(y);
    const float along = dictionary_density(l->along, l->cosine * x + l->sine * y);
    return along > 0.0F ? along * dictionary_density(l->across, l->cosine * y - l->sine * x) : 0.0F;
}

float dictionary_cell_density(const dictionary_cell_slopes *s, const ndf *target, slope at)
{
    const float to_x = DICTIONARY_ALPHA / target->alpha_x, to_y = DICTIONARY_ALPHA / target->alpha_y;
    float sum = 0.0F;
    for (int i = 0; i < s->count; i++) {
        const dictionary_lobes *l = &s->lobes[i];
        sum += l->weight * l->scale * l->scale * lobes_density(l, at.x * to_x, at.y * to_y);
    }
    return sum * to_x * to_y;
}

/* ---- sampling ---- */

/* Both targets are round once scaled by the roughness: a direction and the share u1 of slopes that are shorter. */
static slope sample_round(ndf_kind kind, float u1, float u2)
{
    const float longer = 1.0F - u1; /* exp(-r^2) for Beckmann, 1 / (1 + r^2) for GGX */
    const float r = kind == NDF_BECKMANN ? sqrtf(-log_f(longer)) : sqrtf(u1 / longer);
    const float turn = 2.0F * u2;
    float sine, cosine;
    sincos_pi(turn < 1.0F ? turn : turn - 1.0F, &sine, &cosine);
    const float away = turn < 1.0F ? r : -r;
    return (slope){ away * cosine, away * sine };
}

slope dictionary_target_sample(const ndf *target, float u1, float u2)
{
    const slope s = sample_round(target->kind, u1, u2);
    return (slope){ s.x * target->alpha_x, s.y * target->alpha_y };
}

static slope sample_lobes(const dictionary_lobes *l, float u1, float u2)
{
    if (!l->along)
        return sample_round(NDF_BECKMANN, u1, u2);
    const float x = dictionary_quantile(l->along, u1) * (1.0F / DICTIONARY_ALPHA);
    const float y = dictionary_quantile(l->across, u2) * (1.0F / DICTIONARY_ALPHA);
    return (slope){ l->cosine * x - l->sine * y, l->sine * x + l->cosine * y };
}

slope dictionary_cell_sample(const dictionary_cell_slopes *s, const ndf *target, float *choice, float u1, float u2)
{
    const dictionary_lobes *l = s->lobes;
    float below = 0.0F;
    for (; l + 1 < s->lobes + s->count && *choice >= below + l->weight; l++)
        below += l->weight;
    *choice = uniform_within(*choice, below, below + l->weight);
    const slope at = sample_lobes(l, u1, u2);
    return (slope){ at.x / l->scale * target->alpha_x, at.y / l->scale * target->alpha_y };
}
