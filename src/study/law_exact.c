/* The exact binomial law: BTPE (Kachitvichyanukul and Schmeiser 1988), and inversion where the mean is below 10.
 * Accepts or refuses, so it needs any number of uniforms and cannot keep a glint in its place; it is the mark for the
 * error. */
#include <math.h>

#include "study/law.h"
#include "study/statistics.h"

/* What BTPE computes once for (n, p), p at most one half: the four parts of the hat. */
typedef struct btpe {
    double n, p, q, mode, middle, left, right, c, lambda_l, lambda_r, p1, p2, p3, p4;
} btpe;

static btpe btpe_of(double n, double p)
{
    btpe b = { .n = n, .p = p, .q = 1.0 - p };
    const double spread = n * p * b.q, peak = n * p + p;
    b.mode = floor(peak);
    b.p1 = floor(2.195 * sqrt(spread) - 4.6 * b.q) + 0.5;
    b.middle = b.mode + 0.5;
    b.left = b.middle - b.p1;
    b.right = b.middle + b.p1;
    b.c = 0.134 + 20.5 / (15.3 + b.mode);
    double a = (peak - b.left) / (peak - b.left * p);
    b.lambda_l = a * (1.0 + 0.5 * a);
    a = (b.right - peak) / (b.right * b.q);
    b.lambda_r = a * (1.0 + 0.5 * a);
    b.p2 = b.p1 * (1.0 + 2.0 * b.c);
    b.p3 = b.p2 + b.c / b.lambda_l;
    b.p4 = b.p3 + b.c / b.lambda_r;
    return b;
}

/* log of the mass at y over that at the mode. */
static double log_mass(const btpe *b, double y)
{
    return lgamma(b->mode + 1.0) + lgamma(b->n - b->mode + 1.0) - lgamma(y + 1.0) - lgamma(b->n - y + 1.0) +
           (y - b->mode) * log(b->p / b->q);
}

static double btpe_draw(const btpe *b, uint64_t *state)
{
    for (;;) {
        const double u = random_uniform(state) * b->p4;
        double v = random_uniform(state), y;
        if (u <= b->p1)
            return floor(b->middle - b->p1 * v + u); /* the triangle needs no test */
        if (u <= b->p2) {
            const double x = b->left + (u - b->p1) / b->c;
            v = v * b->c + 1.0 - fabs(b->mode - x + 0.5) / b->p1;
            if (v > 1.0 || v <= 0.0)
                continue;
            y = floor(x);
        } else if (u <= b->p3) {
            y = floor(b->left + log(v) / b->lambda_l);
            v *= (u - b->p2) * b->lambda_l;
        } else {
            y = floor(b->right - log(v) / b->lambda_r);
            v *= (u - b->p3) * b->lambda_r;
        }
        if (y >= 0.0 && y <= b->n && v > 0.0 && log(v) <= log_mass(b, y))
            return y;
    }
}

/* Walks the terms of the law. */
static double invert(double n, double p, uint64_t *state)
{
    double u = random_uniform(state), mass = exp(n * log1p(-p)), y = 0.0;
    while (u > mass && y < n) {
        u -= mass;
        y += 1.0;
        mass *= (n - y + 1.0) / y * (p / (1.0 - p));
    }
    return y;
}

void law_exact(float trials, float p, const law_source *source, float count[LAW_DRAWS])
{
    const double n = floor((double)trials), fraction = (double)trials - n, chance = (double)p;
    const double small = fmin(chance, 1.0 - chance);
    const int is_wide = n * small >= 10.0;
    const btpe b = is_wide ? btpe_of(n, small) : (btpe){ 0 };
    for (int i = 0; i < LAW_DRAWS; i++) {
        const double x = is_wide ? btpe_draw(&b, source->state) : invert(n, small, source->state);
        count[i] = (float)((chance > 0.5 ? n - x : x) + (random_uniform(source->state) < fraction * chance));
    }
}
