/* Deliot and Belcour 2023 as anyone would write it down for a CPU: one point after another, with libm.
 *
 * Tetrahedra of anisotropic grids (section 6.1), triangles of cells on the surface (6.2), four angular cells (Eq. 14)
 * and the gated Gaussian (Eqs. 16 to 18, with the gate the right way round: a success where the uniform is below P>=1).
 * What depends on a grid alone is computed once for its twelve draws, as a compiler or a careful author would. It is
 * the mark that ours is measured by, so nothing here is slower than it has to be, and nothing is vectorised.
 */
#include "published_count.h"

#include <math.h>

#define GLINT_LANES 1
#include "math/hash.h"

#define PI 3.14159265F

/* One of the four grids that share the footprint's facets. */
typedef struct grid {
    float share, direction; /* index, in [0, 2^ratio) */
    int level, ratio;       /* log2 of the minor axis and of the aspect ratio */
} grid;

/* The footprint's ellipse in units of the lattice of grids. */
typedef struct shape {
    int level, ratio;
    float rise, stretch; /* fractions, linear in the minor axis and in the aspect ratio */
    float turn;          /* direction of the major axis over pi, in [0, 1) */
} shape;

static shape shape_of(float dudx, float dudy, float dvdx, float dvdy, float area)
{
    const float uu = dudx * dudx + dudy * dudy, vv = dvdx * dvdx + dvdy * dvdy, uv = dudx * dvdx + dudy * dvdy;
    const float mean = 0.5F * (uu + vv), difference = 0.5F * (uu - vv);
    const float major = sqrtf(mean + sqrtf(difference * difference + uv * uv));
    const float minor = fmaxf(area / major, major / 65536.0F), aspect = fmaxf(major / minor, 1.0F);
    shape s;
    s.ratio = (int)floorf(log2f(aspect));
    s.stretch = aspect / powf(2.0F, (float)s.ratio) - 1.0F;
    s.level = (int)floorf(log2f(minor));
    s.rise = minor / powf(2.0F, (float)s.level) - 1.0F;
    s.turn = atan2f(uv, difference) / (2.0F * PI);
    s.turn = s.turn < 0.0F ? s.turn + 1.0F : s.turn;
    s.turn = s.turn < 1.0F ? s.turn : 0.0F;
    return s;
}

/* Three neighbours in direction and ratio, Fig. 7 left; among two of the same ratio the even direction comes first. */
static void triangle(const shape *s, grid g[3])
{
    const float directions = powf(2.0F, (float)s->ratio), place = s->turn * directions, left = floorf(place);
    const float x = place - left, y = s->stretch, offset = x > 0.5F ? 1.0F - x : x;
    float near = x > 0.5F ? left + 1.0F : left, far = x > 0.5F ? left : left + 1.0F;
    near = near < directions ? near : near - directions;
    far = far < directions ? far : far - directions;
    g[2] = (grid){ fminf(2.0F * offset, y), 2.0F * left + 1.0F, s->level, s->ratio + 1 };
    if (2.0F * offset < y) {
        g[0] = (grid){ 1.0F - y, near, s->level, s->ratio };
        g[1] = (grid){ y - 2.0F * offset, 2.0F * near, s->level, s->ratio + 1 };
        return;
    }
    g[0] = (grid){ 1.0F - offset - 0.5F * y, near, s->level, s->ratio };
    g[1] = (grid){ offset - 0.5F * y, far, s->level, s->ratio };
    if ((int)near & 1) {
        const grid swap = g[0];
        g[0] = g[1];
        g[1] = swap;
    }
}

/* The prism over the triangle, cut in three, Fig. 7 right: vertices rise one after another. */
static void tetrahedron(const shape *s, grid g[4])
{
    grid t[3];
    triangle(s, t);
    float risen = s->rise;
    int top = 2;
    while (top > 0 && risen > t[top].share) {
        risen -= t[top].share;
        top--;
    }
    /* Vertex `top` is on its way up: those behind it are up, those before it are not. */
    for (int i = 0; i < 3; i++) {
        g[i] = t[i];
        g[i].level += i > top;
    }
    g[top].share = fmaxf(t[top].share - risen, 0.0F);
    g[3] = t[top];
    g[3].level++;
    g[3].share = risen;
}

/* The triangle of the grid's lattice around (u, v). */
static void cells(const grid *g, float u, float v, uint32_t seed, uint32_t cell[3], float weight[3])
{
    const float angle = PI * g->direction / powf(2.0F, (float)g->ratio), c = cosf(angle), s = sinf(angle);
    const float across = powf(2.0F, (float)-g->level), along = across * powf(2.0F, (float)-g->ratio);
    const float x = (c * u + s * v) * along, y = (c * v - s * u) * across;
    const float sx = x - y * 0.577350269F, sy = y * 1.15470054F;
    const float ix = floorf(sx), iy = floorf(sy), fx = sx - ix, fy = sy - iy;
    const int upper = fx + fy >= 1.0F;
    weight[0] = fabsf(1.0F - fx - fy);
    weight[1] = upper ? 1.0F - fy : fx;
    weight[2] = upper ? 1.0F - fx : fy;
    const uint32_t name =
        seed + (uint32_t)(int)g->direction * HASH_X + (uint32_t)g->ratio * HASH_Y + (uint32_t)g->level * HASH_Z;
    const uint32_t origin = hash_full(name) + (uint32_t)(int)ix * HASH_Z + (uint32_t)(int)iy * HASH_Y;
    cell[0] = hash_full(upper ? origin + HASH_Z + HASH_Y : origin);
    cell[1] = hash_full(origin + HASH_Z);
    cell[2] = hash_full(origin + HASH_Y);
}

/* Inverse error function, M. Giles 2010. */
static float inverse_erf(float x)
{
    float w = -logf((1.0F - x) * (1.0F + x)), p;
    if (w < 5.0F) {
        w -= 2.5F;
        p = 2.81022636e-08F;
        p = 3.43273939e-07F + p * w;
        p = -3.5233877e-06F + p * w;
        p = -4.39150654e-06F + p * w;
        p = 0.00021858087F + p * w;
        p = -0.00125372503F + p * w;
        p = -0.00417768164F + p * w;
        p = 0.246640727F + p * w;
        p = 1.50140941F + p * w;
    } else {
        w = sqrtf(w) - 3.0F;
        p = -0.000200214257F;
        p = 0.000100950558F + p * w;
        p = 0.00134934322F + p * w;
        p = -0.00367342844F + p * w;
        p = 0.00573950773F + p * w;
        p = -0.0076224613F + p * w;
        p = 0.00943887047F + p * w;
        p = 1.00167406F + p * w;
        p = 2.83297682F + p * w;
    }
    return p * x;
}

static float uniform(uint32_t hash)
{
    return ((float)(hash >> 8) + 0.5F) * 0x1p-24F;
}

/* What twelve draws of one grid share. */
typedef struct gaussian {
    float any, mean, sigma; /* P>=1, mu and sigma of Eqs. 16 and 17 */
} gaussian;

static float draw(const gaussian *b, uint32_t hash)
{
    if (uniform(hash) >= b->any)
        return 0.0F;
    const float normal = 1.41421356F * inverse_erf(2.0F * uniform(hash_full(hash + HASH_X)) - 1.0F);
    return floorf(1.0F + fmaxf(b->mean + b->sigma * normal, 0.0F));
}

/* Four cells around h, blended. */
static float angular(uint32_t cell, float hx, float hy, float scale, const gaussian *b)
{
    const float x = hx * scale + uniform(cell), y = hy * scale + uniform(hash_full(cell));
    const float ix = floorf(x), iy = floorf(y), fx = x - ix, fy = y - iy;
    const uint32_t corner = cell + (uint32_t)(int)ix * HASH_X + (uint32_t)(int)iy * HASH_Y;
    return (1.0F - fy) * ((1.0F - fx) * draw(b, hash_full(corner)) + fx * draw(b, hash_full(corner + HASH_X))) +
           fy * ((1.0F - fx) * draw(b, hash_full(corner + HASH_Y)) + fx * draw(b, hash_full(corner + HASH_X + HASH_Y)));
}

void published_count(const counting_points *points, size_t count, float *factor, float *facets)
{
    for (size_t i = 0; i < count; i++) {
        const float area = fabsf(points->dudx[i] * points->dvdy[i] - points->dudy[i] * points->dvdx[i]);
        const float n = area * points->density[i], p = points->p[i], scale = 1.0F / sqrtf(points->cap[i]);
        const shape s = shape_of(points->dudx[i], points->dudy[i], points->dvdx[i], points->dvdy[i], area);
        grid g[4];
        tetrahedron(&s, g);
        float sum = 0.0F;
        for (int k = 0; k < 4; k++) {
            const float trials = n * g[k].share, mean = (trials - 1.0F) * p;
            const gaussian b = { 1.0F - expf(trials * log1pf(-p)), mean, sqrtf(fmaxf(mean * (1.0F - p), 0.0F)) };
            uint32_t cell[3];
            float weight[3];
            cells(&g[k], (float)points->u[i], (float)points->v[i], points->seed[i], cell, weight);
            for (int j = 0; j < 3; j++)
                sum += weight[j] * angular(cell[j], points->hx[i], points->hy[i], scale, &b);
        }
        factor[i] = sum / fmaxf(n * p, 1e-20F);
        facets[i] = n;
    }
}
