/* Ways to draw from the binomial law, twelve at a time as a glint does: they share one (N, p). */
#ifndef STUDY_LAW_H
#define STUDY_LAW_H

#include <stdint.h>

enum { LAW_DRAWS = 12 };

/* Randomness for twelve draws. */
typedef struct law_source {
    uint32_t uniform[2][LAW_DRAWS]; /* two for each draw, the second for those who need it */
    uint64_t *state;                /* of a generator, for those who need any number of them */
} law_source;

typedef void law_draw(float trials, float p, const law_source *source, float count[LAW_DRAWS]);

/* Deliot and Belcour 2023, Eqs. 16 to 18, as printed but for the gate, which is the right way round. */
law_draw law_as_published;
/* As their shader has it: the Gaussian is cut at zero. */
law_draw law_gated;
/* As the code of Kneiphof and Klein 2024: cut to [1, N] and not rounded. */
law_draw law_clamped;
/* The library's, with the walk up to a mean of 2, 5, 8 and 16. */
law_draw law_ours_2, law_ours_5, law_ours_8, law_ours_16;
/* BTPE, Kachitvichyanukul and Schmeiser 1988, with inversion for small means: exact. */
law_draw law_exact;

#endif
