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
#include "math/uniform.h"
#include "model/dictionary_lanes.h"

/* Farthest that normal_quantile goes, in standard deviations. */
#define FARTHEST_NORMAL 5.5F

static float normal_of(uint32_t hash)
{
    return normal_quantile((float)(hash >> 8) * 0x1p-23F - (1.0F - 0x1p-24F));
}

/* How many of the 4^grain_level grains of a cell are there, over all of them. */
float dictionary_cell_coverage(const dictionary_surface *surface, uint32_t hash, int grain_level)
{
    if (surface->coverage >= 1.0F)
        return 1.0F;
    const uint32_t first = draw_of(hash, DRAW_COVERAGE);
    if (grain_level == 0)
        return uniform_of(first) < surface->coverage ? 1.0F : 0.0F;
    const float grains = exp2_i(2 * grain_level);
    const binomial_chance chance = binomial_chance_of(surface->coverage);
    return fminf(binomial_draw(grains, &chance, (vint)first, 0.0F) / grains, 1.0F);
}

/* ---- scales ---- */

/* One product of marginals with 4^log4_facets facets. */
static dictionary_lobes make_lobes(const dictionary_surface *surface, uint32_t hash, float weight, float e,
                                   float log4_facets)
{
    dictionary_lobes l = { weight, sqrtf(e), 1.0F, 0.0F, NULL, NULL };
    const int level = level_of(log4_facets);
    if (level >= DICTIONARY_LEVELS)
        return l;
    const lobe_pick pick = pick_lobe(hash);
    l.cosine = pick.cosine;
    l.sine = pick.sine;
    l.along = surface->table->marginal[level][pick.along];
    l.across = surface->table->marginal[level][pick.across];
    return l;
}

static void make_scales(dictionary_cell_slopes *s, const dictionary_surface *surface, uint32_t cell, float log4_facets)
{
    scale_set set = ggx_scales(cell);
    deal_to_scales(cell, log4_facets, set.share);
    for (int j = 0; j < DICTIONARY_MAX_SCALES; j++)
        if (set.share[j] > 0.0F)
            s->lobes[s->count++] = make_lobes(surface, draw_of(cell, FIRST_SCALE + (uint32_t)j), set.share[j], set.e[j],
                                              log4_of_share(log4_facets, set.share[j]));
}

int dictionary_is_smooth(const dictionary_surface *surface, float log4_facets)
{
    return log4_facets - FARTHEST_NORMAL * surface->density_variation >= (float)DICTIONARY_LEVELS - 0.5F;
}

float dictionary_cell_log4(const dictionary_surface *surface, uint32_t hash, float log4_facets, float coverage)
{
    float x = coverage < 1.0F ? log4_of_share(log4_facets, coverage) : log4_facets;
    if (surface->density_variation > 0.0F)
        x += surface->density_variation * normal_of(draw_of(hash, DRAW_DENSITY));
    /* No fewer than one facet, and no more than the dictionary tells from infinitely many. */
    x = x > 0.0F ? x : 0.0F;
    return x < (float)DICTIONARY_LEVELS ? x : (float)DICTIONARY_LEVELS;
}

void dictionary_cell_find(dictionary_cell_slopes *s, const dictionary_surface *surface, uint32_t hash,
                          float log4_facets)
{
    s->count = 0;
    if (dictionary_cell_is_target(log4_facets))
        return;
    if (surface->target.kind == NDF_GGX)
        make_scales(s, surface, hash, log4_facets);
    else
        s->lobes[s->count++] = make_lobes(surface, draw_of(hash, FIRST_SCALE), 1.0F, 1.0F, log4_facets);
}

float dictionary_cell_facets(float log4_facets)
{
    return exp4(log4_facets);
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
