/* The densities of GLINT_LANES cells of a dictionary at one slope. */
#include "model/dictionary_kernel.h"

#include "math/elementary.h"
#include "math/hash.h"

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
    /* Both samples at once: the one after the last is that of the next marginal, and not used. */
    const vuint pair = gather_u(table->marginal, (marginal * DICTIONARY_SAMPLES + i) * (int32_t)sizeof(uint16_t));
    const vmask has_next = less_i(i, splat_i(DICTIONARY_SAMPLES - 1));
    const vfloat left = float_of(pair & 0xffffU), right = choose(has_next, float_of(pair >> 16), splat(0.0F));
    return choose(inside, left + f * (right - left), splat(0.0F));
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(dictionary_kernel_, GLINT_LANES)(const dictionary *table, const dictionary_cells *cells, size_t count,
                                           float x, float y, float *density)
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
