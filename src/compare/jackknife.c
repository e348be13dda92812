/* Sums over 8 x 8 parts of a picture, and the standard error of what is computed from them. */
#include "compare/jackknife.h"

#include <math.h>

void jackknife_add(jackknife *j, int x, int y, int width, int height, double a, double b)
{
    const int column = (int)((int64_t)x * JACKKNIFE_SIDE / width), row = (int)((int64_t)y * JACKKNIFE_SIDE / height);
    jackknife_sums *s = &j->part[row * JACKKNIFE_SIDE + column];
    s->count += 1.0;
    s->a += a;
    s->b += b;
    s->aa += a * a;
    s->bb += b * b;
    s->ab += a * b;
}

static void add_sums(jackknife_sums *to, const jackknife_sums *s, double sign)
{
    to->count += sign * s->count;
    to->a += sign * s->a;
    to->b += sign * s->b;
    to->aa += sign * s->aa;
    to->bb += sign * s->bb;
    to->ab += sign * s->ab;
}

jackknife_sums jackknife_total(const jackknife *j)
{
    jackknife_sums total = { 0 };
    for (int i = 0; i < JACKKNIFE_PARTS; ++i)
        add_sums(&total, &j->part[i], 1.0);
    return total;
}

static double ratio_of(double a, double b)
{
    return a == b ? 1.0 : b / a;
}

typedef double estimate(const jackknife_sums *s);

static double ratio_of_means(const jackknife_sums *s)
{
    return ratio_of(s->a, s->b);
}

static double ratio_of_squares(const jackknife_sums *s)
{
    return ratio_of(s->aa, s->bb);
}

/* sqrt((n - 1) / n * sum of (estimate without part i - their mean)^2) over the n parts that have anything. */
static double standard_error(const jackknife *j, const jackknife_sums *total, estimate *of)
{
    double value[JACKKNIFE_PARTS], mean = 0.0, sum = 0.0;
    int n = 0;
    for (int i = 0; i < JACKKNIFE_PARTS; ++i) {
        if (!(j->part[i].count > 0.0) || !(j->part[i].count < total->count))
            continue;
        jackknife_sums rest = *total;
        add_sums(&rest, &j->part[i], -1.0);
        value[n++] = of(&rest);
    }
    if (n < 2)
        return (double)NAN;
    for (int i = 0; i < n; ++i)
        mean += value[i] / n;
    for (int i = 0; i < n; ++i)
        sum += (value[i] - mean) * (value[i] - mean);
    return sqrt(sum * (n - 1) / n);
}

compare_ratio jackknife_ratio_of_means(const jackknife *j)
{
    const jackknife_sums t = jackknife_total(j);
    const double count = t.count > 0.0 ? t.count : 1.0;
    return (compare_ratio){ t.a / count, t.b / count, ratio_of_means(&t), standard_error(j, &t, ratio_of_means) };
}

compare_ratio jackknife_ratio_of_squares(const jackknife *j)
{
    const jackknife_sums t = jackknife_total(j);
    const double count = t.count > 0.0 ? t.count : 1.0;
    return (compare_ratio){ t.aa / count, t.bb / count, ratio_of_squares(&t), standard_error(j, &t, ratio_of_squares) };
}

double jackknife_correlation(const jackknife_sums *s)
{
    const double n = s->count > 0.0 ? s->count : 1.0;
    const double aa = s->aa - s->a * s->a / n, bb = s->bb - s->b * s->b / n, ab = s->ab - s->a * s->b / n;
    /* Of equal values nothing but rounding is left. */
    const bool a_flat = aa <= 1e-12 * s->aa, b_flat = bb <= 1e-12 * s->bb;
    if (a_flat || b_flat)
        return a_flat && b_flat ? 1.0 : 0.0;
    return ab / sqrt(aa * bb);
}
