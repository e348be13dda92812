/* GLINT_LANES cells of a dictionary at a time. */
#include "model/dictionary_kernel.h"

#include "math/elementary.h"
#include "math/hash.h"

/* Weight of a cell at distance r from the centre, r = 1 on the ellipse: exp(-2 r^2) - exp(-2), Heckbert's filter. */
#define FILTER_SHARPNESS 2.0F
#define FILTER_EDGE 0.135335283F

static inline vuint draw(vuint hash, uint32_t which)
{
    return hash_full(hash + which * HASH_X);
}

/* An IEEE half float that is not negative. */
static inline vfloat float_of(vuint half)
{
    return float_from_bits(half << 13) * 0x1p112F;
}

/* dictionary_density of a marginal, by its number in the whole table. */
static inline vfloat density_of(const dictionary *table, vint marginal, vfloat x)
{
    const vfloat t = abs_f(x) * (1.0F / DICTIONARY_SPACING);
    const vmask inside = less(t, splat((float)DICTIONARY_SAMPLES));
    const vfloat place = choose(inside, t, splat(0.0F));
    const vint i = to_int(place);
    const vfloat f = place - to_float(i);
    /* Both samples at once; the last one as the second of two. */
    const vmask is_last = less_i(splat_i(DICTIONARY_SAMPLES - 2), i);
    const vint first = choose_i(is_last, splat_i(DICTIONARY_SAMPLES - 2), i);
    const vuint pair = gather_u(table->marginal, (marginal * DICTIONARY_SAMPLES + first) * (int32_t)sizeof(uint16_t));
    const vfloat low = float_of(pair & 0xffffU), high = float_of(pair >> 16);
    const vfloat left = choose(is_last, high, low), right = choose(is_last, splat(0.0F), high);
    return choose(inside, left + f * (right - left), splat(0.0F));
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

void JOIN(dictionary_look_, GLINT_LANES)(const dictionary *table, const dictionary_cells *cells, size_t count, float x,
                                         float y, float *density)
{
    for (size_t i = 0; i < count; i += GLINT_LANES) {
        const vuint hash = draw(load_u(cells->hash + i), DICTIONARY_FIRST_SCALE);
        vfloat sine, cosine;
        sincos_pi(to_float((vint)(draw(hash, DICTIONARY_TURN) >> 8)) * 0x1p-24F, &sine, &cosine);
        const vuint pick = draw(hash, DICTIONARY_PICK);
        const vint first = load_i(cells->level + i) * DICTIONARY_MARGINALS;
        const vfloat along =
            density_of(table, first + (vint)((pick >> 16) * DICTIONARY_MARGINALS >> 16), cosine * x + sine * y);
        const vfloat across =
            density_of(table, first + (vint)((pick & 0xffffU) * DICTIONARY_MARGINALS >> 16), cosine * y - sine * x);
        store_f(density + i, choose(less(splat(0.0F), along), along * across, splat(0.0F)));
    }
}
