/* Four seeds at a time, or four tiles: Eq. 6 of Xing et al. 2024. The integral of footprint times seed is a Gaussian in
 * the slope, moved to where in the seed the footprint lies. */
#define GLINT_LANES 4
#include "math/elementary.h"
#include "model/example_view.h"

/* Place and slope of a seed are one Gaussian: wherever in it the footprint lies, its exponent is at least that of the
 * slope alone, with its spread over all of the seed. */
uint32_t example_lit_quarters(const example_view *v, int level, uint32_t x, uint32_t y)
{
    const quarter_slopes *q = &v->e->slopes[v->e->first_chain[level] + example_tile(v->e, (uint32_t)level, x, y)];
    vmask dark = { 0, 0, 0, 0 };
    for (int k = 0; k < 2; k++) {
        const vfloat away = max_f(load_f(q->low[k]) - v->slope[k], v->slope[k] - load_f(q->high[k]));
        const vfloat reach2 = SLOPE_REACH * SLOPE_REACH * (load_f(q->variance[k]) + v->slope_variance);
        dark |= less(splat(0.0F), away) & less(reach2, away * away);
    }
    const vuint lit = (vuint)~dark & (vuint){ 1U, 2U, 4U, 8U };
    return (lit[0] | lit[1]) | (lit[2] | lit[3]);
}

static float sum_of(vfloat x)
{
    return (x[0] + x[1]) + (x[2] + x[3]);
}

/* exp(-exponent - d^T C^-1 d / 2) / (2 pi sqrt(det C)) of the slope, C = J posterior J^T + the roughness. */
static vfloat slope_density(const example_view *v, const example_quad *q, vfloat gx, vfloat gy, vfloat exponent,
                            vmask near)
{
    const vfloat a = load_f(q->jacobian[0]), b = load_f(q->jacobian[1]);
    const vfloat c = load_f(q->jacobian[2]), d = load_f(q->jacobian[3]);
    const vfloat px = v->e->lattice.seed_variance * gx, py = v->e->lattice.seed_variance * gy;
    const vfloat x = v->slope[0] - load_f(q->slope[0]) - a * px - b * py;
    const vfloat y = v->slope[1] - load_f(q->slope[1]) - c * px - d * py;
    const covariance2 *p = &v->posterior;
    const vfloat ax = a * p->xx + b * p->xy, ay = a * p->xy + b * p->yy;
    const vfloat cx = c * p->xx + d * p->xy, cy = c * p->xy + d * p->yy;
    const vfloat xx = ax * a + ay * b + v->slope_variance, xy = ax * c + ay * d;
    const vfloat yy = cx * c + cy * d + v->slope_variance;
    const vfloat det = xx * yy - xy * xy;
    const vfloat e = exponent + 0.5F * (yy * x * x - 2.0F * xy * x * y + xx * y * y) / det;
    const vmask seen = near & less(e, splat(2.0F * LAST_EXPONENT));
    if (!any(seen))
        return splat(0.0F);
    return choose(seen, exp_negative(-e) / (2.0F * MATH_PI * sqrt_f(det)), splat(0.0F));
}

void example_take_quad(const example_view *v, uint32_t x, uint32_t y, uint32_t owned, int is_dark, gathered *sum)
{
    const float t = v->texel;
    const vfloat right = { 0.0F, t, 0.0F, t }, up = { 0.0F, 0.0F, t, t };
    const vfloat dx = v->mean[0] - ((float)(2U * x) + 0.5F) * t - right;
    const vfloat dy = v->mean[1] - ((float)(2U * y) + 0.5F) * t - up;
    const covariance2 *p = &v->precision;
    const vfloat gx = p->xx * dx + p->xy * dy, gy = p->xy * dx + p->yy * dy;
    const vfloat exponent = 0.5F * (dx * gx + dy * gy);
    const vuint bits = { 1, 2, 4, 8 };
    const vmask near = less(exponent, splat(LAST_EXPONENT)) & ((bits & owned) != 0U);
    if (!any(near))
        return;
    const float area = v->norm * t * t;
    if (v->wants_mass)
        sum->mass += area * sum_of(choose(near, exp_negative(-exponent), splat(0.0F)));
    if (is_dark)
        return;
    const example_quad *q = &v->e->quads[example_tile(v->e, 0, x, y)];
    const vfloat density = slope_density(v, q, gx, gy, exponent, near);
    sum->value += area * v->slope_scale * sum_of(density);
    for (uint32_t i = 0; v->palette && i < 4; i++)
        if (density[i] > 0.0F)
            example_add_tint(v, (2U * y + (i >> 1)) * v->e->size + 2U * x + (i & 1U),
                             area * v->slope_scale * density[i], sum);
}
