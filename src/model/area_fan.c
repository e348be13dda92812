/* A plain polygon at one point: what area_polygon.h has for many, with corners side by side instead. */
#define GLINT_LANES 8
#include "model/area_eight.h"
#include "model/area_polygon.h"

/* Corners, and the first again for all that there are not. */
enum { RING = 2 * PLAIN_CORNERS };
typedef struct ring {
    float x[RING], y[RING], z[RING];
} ring;

static inline vfloat3 load_ring(const ring *r, int from)
{
    return (vfloat3){ load_f(r->x + from), load_f(r->y + from), load_f(r->z + from) };
}

static inline void store_ring(ring *r, int at, vfloat3 v)
{
    store_f(r->x + at, v.x);
    store_f(r->y + at, v.y);
    store_f(r->z + at, v.z);
}

static void close_ring(const float (*corner)[3], int count, ring *r)
{
    for (int i = 0; i < PLAIN_CORNERS; i++) {
        const float *const from = corner[i < count ? i : 0];
        r->x[i] = from[0];
        r->y[i] = from[1];
        r->z[i] = from[2];
    }
}

static inline vfloat3 splat3(float x, float y, float z)
{
    return (vfloat3){ splat(x), splat(y), splat(z) };
}

/* The greatest of all lanes in each. */
static inline vfloat greatest(vfloat x)
{
    x = max_f(x, (vfloat){ x[4], x[5], x[6], x[7], x[0], x[1], x[2], x[3] });
    x = max_f(x, (vfloat){ x[2], x[3], x[0], x[1], x[6], x[7], x[4], x[5] });
    return max_f(x, (vfloat){ x[1], x[0], x[3], x[2], x[5], x[4], x[7], x[6] });
}

static inline vfloat3 sum_of(vfloat3 v)
{
    const vfloat sums = fold_four(v.x, v.y, v.z, v.z);
    return splat3(sums[0], sums[1], sums[4]);
}

/* Scales the ring; the shape is the same in all lanes. */
static inline int find_shape(ring *r, int count, plain_shape *s)
{
    const vint number = { 0, 1, 2, 3, 4, 5, 6, 7 }, odd = { 0, 1, 0, 1, 0, 1, 0, 1 };
    const vfloat zero = splat(0.0F);
    const vfloat3 none = { zero, zero, zero };
    vfloat3 at = load_ring(r, 0);
    /* Bits of numbers that are not negative, and below infinity, compare as the numbers do. */
    const vint own = plain_widest(at);
    if (any(~plain_has_numbers(splat_i(count), own)))
        return 0;
    const vint widest = (vint)bits_of(greatest(float_from_bits((vuint)own)));
    const vmask counts = less_i(number, splat_i(count));
    const vfloat3 mean = scale_3(sum_of(choose_3(counts, at, none)), 1.0F / splat((float)count));
    const vfloat distance2 = dot_3(mean, mean);
    if (!any(plain_is_away(widest, distance2)))
        return 0;
    const vfloat inverse = 1.0F / sqrt_f(distance2);
    s->usable = equal_i(number, number);
    s->middle = scale_3(mean, inverse);
    at = scale_3(at, inverse);
    store_ring(r, 0, at);
    const vfloat3 first = splat3(r->x[0], r->y[0], r->z[0]);
    store_ring(r, PLAIN_CORNERS, first);
    const vfloat3 next = load_ring(r, 1), off = plain_minus(at, s->middle), side = plain_minus(next, at),
                  across = plain_minus(at, first);
    s->extent.reach = sqrt_f(greatest(dot_3(off, off)));
    s->extent.height = greatest(abs_f(off.z));
    s->side2 = greatest(dot_3(side, side));
    s->diagonal2 = greatest(choose(equal_i(odd, splat_i(1)), dot_3(across, across), zero));
    plain_set_facing(s, sum_of(cross_3(off, plain_minus(next, s->middle))));
    return 1;
}

static inline void store_3(float to[3][PLAIN_CORNERS], vfloat3 v)
{
    store_f(to[0], v.x);
    store_f(to[1], v.y);
    store_f(to[2], v.z);
}

/* Squares from each corner on; every second is one of the polygon. */
static inline void find_parts(const ring *r, const plain_shape *s, int from_middle, area_parts *parts)
{
    const vfloat3 first = splat3(r->x[0], r->y[0], r->z[0]), from = from_middle ? s->middle : first;
    const int i = from_middle ? 0 : 1;
    const vfloat sign = choose(less(s->facing, splat(0.0F)), splat(-1.0F), splat(1.0F));
    const plain_quad q = plain_quad_of(from, plain_minus(load_ring(r, i), from), plain_minus(load_ring(r, i + 1), from),
                                       plain_minus(load_ring(r, i + 2), from), sign);
    store_3(parts->middle, q.middle);
    store_3(parts->u, q.u);
    store_3(parts->v, q.v);
    store_3(parts->w, q.w);
    store_f(parts->size, q.size);
    store_f(parts->size_x, q.size_x);
    store_f(parts->size_y, q.size_y);
}

#if defined(__AVX2__) && defined(GLINT_AREA_QUAD_AVX2)
#define AREA_FAN_OF area_fan_of_avx2
#else
#define AREA_FAN_OF area_fan_of_base
#endif

int AREA_FAN_OF(const float (*corner)[3], int count, int two_sided, area_nodes *n, float *left)
{
    ring r;
    plain_shape s;
    *left = 1.0F;
    close_ring(corner, count, &r);
    if (!find_shape(&r, count, &s))
        return PLAIN_LEFT;
    const area_lobe lobe = area_lobe_seen(&n->eye);
    /* Both bends at once, that of the wide squares in the first lane. */
    const vint first = { 1, 0, 0, 0, 0, 0, 0, 0 };
    const vfloat size = choose(equal_i(first, splat_i(1)), plain_wide(&s), plain_slim(&s));
    const vfloat bend = plain_bend(&lobe, s.middle, size, &s.extent);
    vmask from_middle;
    const plain_light p =
        plain_polygon_rule(&s, splat_i(count), splat_i(two_sided), splat(bend[0]), splat(bend[1]), &from_middle);
    *left = p.left[0];
    if (p.rule[0] < 0)
        return p.rule[0];
    n->is_bent = 1;
    n->count = any(from_middle) ? (count + 1) / 2 : (count - 1) / 2;
    find_parts(&r, &s, any(from_middle), &n->parts);
    return p.rule[0];
}
