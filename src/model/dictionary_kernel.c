/* GLINT_LANES cells of a dictionary at a time. */
#include "model/dictionary_kernel.h"

#include "model/dictionary_lanes.h"

/* Weight of a cell at distance r from the centre, r = 1 on the ellipse: exp(-2 r^2) - exp(-2), Heckbert's filter. */
#define FILTER_SHARPNESS 2.0F
#define FILTER_EDGE 0.135335283F

/* P22 of one product of marginals at a slope of the dictionary's roughness, of 4^log4_facets facets. */
static inline vfloat lobe_density(const dictionary *table, vuint hash, vfloat log4_facets, vfloat x, vfloat y)
{
    const vint level = level_of(log4_facets);
    const vmask is_target = less_i(splat_i(DICTIONARY_LEVELS - 1), level);
    const vint first = choose_i(is_target, splat_i(0), level) * DICTIONARY_MARGINALS;
    const lobe_pick p = pick_lobe(hash);
    const vfloat along = marginal_density(table->marginal[0], first + p.along, p.cosine * x + p.sine * y);
    const vfloat across = marginal_density(table->marginal[0], first + p.across, p.cosine * y - p.sine * x);
    const vfloat product = choose(less(splat(0.0F), along), along * across, splat(0.0F));
    return any(is_target) ? choose(is_target, gaussian_density(x) * gaussian_density(y), product) : product;
}

/* A mixture of scales. */
static inline vfloat ggx_density(const dictionary *table, vuint cell, vfloat log4_facets, vfloat x, vfloat y)
{
    scale_set set = ggx_scales(cell);
    deal_to_scales(cell, log4_facets, set.share);
    vfloat sum = splat(0.0F);
    for (int j = 0; j < DICTIONARY_MAX_SCALES; j++) {
        const vmask dealt = less(splat(0.0F), set.share[j]);
        if (!any(dealt))
            continue;
        const vfloat share = choose(dealt, set.share[j], splat(1.0F)), scale = sqrt_f(set.e[j]);
        const vfloat one = lobe_density(table, draw_of(cell, FIRST_SCALE + (uint32_t)j),
                                        log4_of_share(log4_facets, share), x * scale, y * scale);
        sum = sum + choose(dealt, share * scale * scale * one, splat(0.0F));
    }
    return sum;
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(dictionary_weigh_, GLINT_LANES)(const dictionary_corners *c, size_t count, uint32_t *hash, float *weight)
{
    for (size_t i = 0; i < count; i += GLINT_LANES) {
        const vuint named = hash_full(hash_full(load_u(c->row + i) + load_u(c->low + i)) + load_u(c->high + i));
        store_u(hash + i, named);
        store_f(weight + i, exp_negative(-FILTER_SHARPNESS * load_f(c->r2 + i)) - FILTER_EDGE);
    }
}

void JOIN(dictionary_look_, GLINT_LANES)(const dictionary *table, ndf_kind kind, const dictionary_cells *cells,
                                         size_t count, float x, float y, float *density)
{
    for (size_t i = 0; i < count; i += GLINT_LANES) {
        const vuint cell = load_u(cells->hash + i);
        const vfloat log4_facets = load_f(cells->log4_facets + i);
        const vfloat d = kind == NDF_GGX
                             ? ggx_density(table, cell, log4_facets, splat(x), splat(y))
                             : lobe_density(table, draw_of(cell, FIRST_SCALE), log4_facets, splat(x), splat(y));
        store_f(density + i, d);
    }
}
