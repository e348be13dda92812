/* Where examples lie and how a pixel falls on them: Xing et al. 2024, sections 6.1 and 6.2, Eqs. 8 and 9. */
#include "model/example_place.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/hash.h"

/* A pixel's box has this variance in units of its side; its Gaussian has the same. */
#define PIXEL_VARIANCE (1.0 / 12.0)

/* Axes of the Gaussian on the lattice beyond which a footprint is looked at in part (cost): of scattered or mirrored
 * examples, of examples that are all alike, and of the longer axis in units of the shorter. */
#define MOST_SIGMA 0.5
#define MOST_SIGMA_ALIKE 2.0
#define MOST_ASPECT 16.0

/* All alike, whole examples are left from here on: what is not yet averaged, exp(-2 pi^2 sigma^2), falls from 1e-3 to
 * 1e-5 of the contrast while the difference is faded out. */
#define ALIKE_FADE_BEGIN 0.6
#define ALIKE_FADE_END 0.75

/* Less than this share of a difference is not looked at: nobody sees it. */
#define LEAST_SHARE (1.0 / 64.0)

/* sin and cos of any angle of at most a few turns. */
static void sincos_rad(float angle, float *sine, float *cosine)
{
    const float half_turns = angle / MATH_PI, whole = floor_f(half_turns);
    float s, c;
    sincos_pi(half_turns - whole, &s, &c);
    const float sign = ((int)whole & 1) ? -1.0F : 1.0F;
    *sine = sign * s;
    *cosine = sign * c;
}

static matrix2 transform_of(float scale_x, float scale_y, float shear_x, float shear_y, float rotation_rad)
{
    float s, c;
    sincos_rad(rotation_rad, &s, &c);
    return matrix2_product((matrix2){ c, -s, s, c }, (matrix2){ scale_x, shear_x, shear_y, scale_y });
}

/* Longer diagonal of the unit square under a map. */
static float diagonal(matrix2 m)
{
    const float ax = m.xx + m.xy, ay = m.yx + m.yy, bx = m.xx - m.xy, by = m.yx - m.yy;
    const float a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
    return sqrtf(a2 > b2 ? a2 : b2);
}

/* The larger singular value. */
static float stretch(matrix2 m)
{
    const float d = matrix2_determinant(m);
    const float half = 0.5F * (m.xx * m.xx + m.xy * m.xy + m.yx * m.yx + m.yy * m.yy);
    return sqrtf(half + sqrtf(half > fabsf(d) ? (half - d) * (half + d) : 0.0F));
}

/* In [-1, 1): number k of a series that fills it evenly, another series for each dimension. */
static float signed_series(uint32_t k, uint32_t dimension)
{
    return (float)(int32_t)(k * (HASH_X + 2U * dimension * HASH_Z) + hash_full(dimension)) * 0x1p-31F;
}

static matrix2 scattered_transform(const glint_example *o, uint32_t k)
{
    const float grow = o->scale_variation, lean = o->shear_variation;
    return transform_of(o->scale[0] * (1.0F + grow * signed_series(k, 1)),
                        o->scale[1] * (1.0F + grow * signed_series(k, 2)), o->shear[0] + lean * signed_series(k, 3),
                        o->shear[1] + lean * signed_series(k, 4),
                        o->rotation_rad + o->rotation_variation_rad * signed_series(k, 0));
}

void lattice_make(lattice *l, const glint_example *o)
{
    const matrix2 unit = { 1.0F, 0.0F, 0.0F, 1.0F };
    const matrix2 own = transform_of(o->scale[0], o->scale[1], o->shear[0], o->shear[1], o->rotation_rad);
    const float sigma_h = o->sigma_h / (float)o->size;
    l->is_scattered = o->placement == GLINT_EXAMPLE_SCATTERED;
    l->is_alike = !l->is_scattered && !o->mirror;
    l->kinds = l->is_scattered ? LATTICE_VARIANTS : o->mirror ? LATTICE_MIRRORED : 1;
    l->jitter = l->is_scattered ? o->jitter : 0.0F;
    l->seed_variance = sigma_h * sigma_h;
    l->from_lattice = l->is_scattered ? unit : own;
    l->to_lattice = matrix2_inverse(l->from_lattice);
    l->most_radius = l->most_stretch = 0.0F;
    for (uint32_t k = 0; k < LATTICE_VARIANTS; k++) {
        variant *v = &l->variants[k];
        matrix2 m = l->is_scattered ? scattered_transform(o, k) : unit;
        if (o->mirror) {
            const float mx = k & 1U ? -1.0F : 1.0F, my = k & 2U ? -1.0F : 1.0F;
            m = (matrix2){ m.xx * mx, m.xy * my, m.yx * mx, m.yy * my };
        }
        const matrix2 back = matrix2_inverse(m);
        *v =
            (variant){ m,
                       back,
                       0.5F * diagonal(m),
                       { sqrtf(back.xx * back.xx + back.xy * back.xy), sqrtf(back.yx * back.yx + back.yy * back.yy) } };
        l->most_radius = fmaxf(l->most_radius, v->radius);
        l->most_stretch = fmaxf(l->most_stretch, stretch(m));
    }
}

const variant *lattice_centre(const lattice *l, uint32_t i, uint32_t j, int offset_i, int offset_j, uint32_t seed,
                              float *x, float *y)
{
    const uint32_t bits =
        hash_full(hash_full((i + (uint32_t)offset_i) * HASH_X + seed) + (j + (uint32_t)offset_j) * HASH_Y);
    *x = (float)offset_i + 0.5F;
    *y = (float)offset_j + 0.5F;
    if (l->jitter > 0.0F) {
        const uint32_t place = hash_full(bits + HASH_Z);
        *x += 0.5F * l->jitter * ((float)(place & 0xffffU) * 0x1p-15F - 1.0F);
        *y += 0.5F * l->jitter * ((float)(place >> 16) * 0x1p-15F - 1.0F);
    }
    return &l->variants[bits % LATTICE_VARIANTS];
}

instance lattice_instance(const lattice *l, uint32_t i, uint32_t j, int offset_i, int offset_j, uint32_t seed)
{
    instance n;
    n.as = *lattice_centre(l, i, j, offset_i, offset_j, seed, &n.x, &n.y);
    return n;
}

/* Brings the axes of the Gaussian within what evaluation looks at. */
static float bound_spread(const lattice *l, double xx, double xy, double yy, covariance2 *bounded)
{
    const double half_sum = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
    const double radius = sqrt(half * half + xy * xy);
    const double major = sqrt(half_sum + radius), least = half_sum - radius;
    const double minor = least > 0.0 ? sqrt(least) : 0.0;
    const double most = l->is_alike ? MOST_SIGMA_ALIKE : MOST_SIGMA;
    const double low = minor < most ? minor : most;
    const double seed = sqrt((double)l->seed_variance);
    double high = MOST_ASPECT * (low > seed ? low : seed);
    high = high < most ? high : most;
    high = major < high ? major : high;
    /* scale * S + add * I has the same axes and these lengths. */
    const double apart = major * major - minor * minor;
    const double scale = apart > 1e-12 * major * major ? (high * high - low * low) / apart : 0.0;
    const double add = scale > 0.0 ? low * low - scale * minor * minor : low * low;
    *bounded = (covariance2){ (float)(scale * xx + add), (float)(scale * xy), (float)(scale * yy + add) };

    double share;
    if (l->is_alike) {
        share = (ALIKE_FADE_END - minor) / (ALIKE_FADE_END - ALIKE_FADE_BEGIN);
    } else {
        /* n independent examples differ from their mean by 1 / sqrt(n): n' of them, weighted by sqrt(n' / n), differ as
         * much. */
        const double kept = (low + seed) * (high + seed), all = (minor + seed) * (major + seed);
        share = (sqrt(kept / all) - LEAST_SHARE) / (1.0 - LEAST_SHARE);
    }
    return share > 0.0 ? (share < 1.0 ? (float)share : 1.0F) : 0.0F;
}

/* Largest integer <= x, modulo 2^32, and what is left. */
static float split_cell(double x, uint32_t *cell)
{
    const double whole = floor(x);
    *cell = (uint32_t)(int64_t)whole;
    return (float)(x - whole);
}

int lattice_footprint(const lattice *l, const model_query *q, float side_m, example_footprint *f)
{
    const glint_footprint *p = q->footprint;
    const double stretch = sqrt((double)q->material->options.elongation), to_cells = 1.0 / (double)side_m;
    const double along = to_cells / stretch, across = to_cells * stretch;
    const double ax = (double)p->dudx * along, ay = (double)p->dudy * along;
    const double bx = (double)p->dvdx * across, by = (double)p->dvdy * across;
    const double area = fabs((double)p->dudx * (double)p->dvdy - (double)p->dudy * (double)p->dvdx);
    if (!(area > 1e-30))
        return 0;
    const double txx = (double)l->to_lattice.xx, txy = (double)l->to_lattice.xy, tyx = (double)l->to_lattice.yx,
                 tyy = (double)l->to_lattice.yy;
    const double cx = txx * ax + txy * bx, cy = txx * ay + txy * by; /* lattice units per pixel */
    const double dx = tyx * ax + tyy * bx, dy = tyx * ay + tyy * by;
    f->share = bound_spread(l, PIXEL_VARIANCE * (cx * cx + cy * cy), PIXEL_VARIANCE * (cx * dx + cy * dy),
                            PIXEL_VARIANCE * (dx * dx + dy * dy), &f->spread);

    /* Every seed starts its lattice somewhere else, so that a place has no colour of its own. */
    const uint32_t start = hash_full(q->material->options.seed * HASH_X + p->seed * HASH_Y);
    const double u = p->u * along, v = p->v * across;
    const double x = txx * u + txy * v + (double)(start & 0xffffU) * 0x1p-16;
    const double y = tyx * u + tyy * v + (double)(start >> 16) * 0x1p-16;
    if (!(fabs(x) < 0x1p50 && fabs(y) < 0x1p50))
        return 0;
    f->at[0] = split_cell(x, &f->cell[0]);
    f->at[1] = split_cell(y, &f->cell[1]);
    return 1;
}
