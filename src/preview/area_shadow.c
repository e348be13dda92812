/* The share of a shape's effect that nothing hides: shadow rays weighted by what their places add.
 *
 * Analytic light times the share of it that is visible (Heitz, Hill and McGuire 2018, "Combining Analytic Direct
 * Illumination and Stochastic Shadows"). The share is a quotient of two integrals over the light, of f cos V and of f
 * cos. Places spread over the light, and one that the surface reflects, stand for both. The quotient is exact where all
 * rays agree; in a half-shadow it tends to the truth as the places grow in number.
 */
#include "preview/area_shadow.h"

#include "preview/hash.h"

/* Even over the light, on a grid of 2 x 2; and by a surface that is not rough, whose lobe may fall between them. */
#define SPREAD 4
#define REFLECTED 3
#define MOST_CANDIDATES (SPREAD + REFLECTED)
/* Places that add less than this share of all are not worth a ray. */
#define LEAST_SHARE 0.01
/* Half the room of a depth's dimensions: those of lights have a partner there for their choice. */
#define PARTNER (1U << 19)
/* Lobes so rough do not fall between four candidates: taste. */
#define ROUGH 0.3F

typedef struct candidate {
    vec3 direction; /* unit */
    double distance;
    double weight;
} candidate;

/* A light and how the point sees it. */
typedef struct target {
    const light *light;
    const light_view *view;
} target;

/* 1 / (density of the spread candidates, per steradian): cos |da| / d^2, 0 from behind, for a flat light; round ones
 * are even over their cap. */
static double steradians(const target *t, vec3 direction, double distance)
{
    const light *const l = t->light;
    if (!light_is_area(l))
        return (double)t->view->solid_angle_sr;
    const double cosine = v3_dot(direction, l->axis);
    return cosine > 0.0 ? light_area_m2(l) * cosine / (distance * distance) : 0.0;
}

static bool has_sharp_layer(const shade_point *p)
{
    for (int i = 0; i < p->layer_count; ++i)
        if (fminf(p->layers[i].surface.alpha_x, p->layers[i].surface.alpha_y) < ROUGH)
            return true;
    return false;
}

/* The place of the light that lies in a direction. */
static bool meet(const target *t, vec3 origin, vec3 direction, double *distance)
{
    const light *const l = t->light;
    if (!light_is_area(l)) {
        *distance = t->view->distance;
        const double cosine = v3_dot(direction, t->view->wi);
        return cosine > 0.0 && v3_length(v3_mad(direction, t->view->wi, -cosine)) <= t->view->sine;
    }
    const vec3 towards = v3_sub(l->position, origin);
    const double cosine = v3_dot(direction, l->axis);
    if (!(cosine > 0.0))
        return false;
    *distance = v3_dot(towards, l->axis) / cosine;
    const vec3 at = v3_sub(v3_scale(direction, *distance), towards);
    const double x = v3_dot(at, l->half_x) / v3_dot(l->half_x, l->half_x);
    const double y = v3_dot(at, l->half_y) / v3_dot(l->half_y, l->half_y);
    return l->kind == SCENE_LIGHT_DISK ? x * x + y * y <= 1.0 : fabs(x) <= 1.0 && fabs(y) <= 1.0;
}

/* The balance heuristic over all candidates of both kinds. */
static void weigh(const shade_point *p, const target *t, bool sharp, candidate *c)
{
    const double solid_angle = steradians(t, c->direction, c->distance);
    c->weight = 0.0;
    if (!(solid_angle > 0.0))
        return;
    const double density = SPREAD / solid_angle + (sharp ? REFLECTED * (double)shade_pdf(p, c->direction) : 0.0);
    c->weight = (double)shade_level(p, c->direction) / density;
}

static int spread(const shade_point *p, const target *t, vec3 origin, const double u[2], bool sharp, candidate *out)
{
    for (int i = 0; i < SPREAD; ++i) {
        const int column = i % 2, row = i / 2;
        const double place[2] = { 0.5 * (column + u[0]), 0.5 * (row + u[1]) };
        if (light_is_area(t->light)) {
            const vec3 towards = v3_sub(light_point(t->light, place), origin);
            out[i].distance = v3_length(towards);
            out[i].direction = v3_normalize(towards);
        } else {
            light_pick(t->light, t->view, origin, place, &out[i].direction, &out[i].distance);
        }
        weigh(p, t, sharp, &out[i]);
    }
    return SPREAD;
}

static int reflect(const shade_point *p, const target *t, vec3 origin, uint32_t bits, candidate *out)
{
    int count = 0;
    for (uint32_t i = 0; i < REFLECTED; ++i) {
        const uint32_t own = hash_combine(bits, i);
        const float random[3] = { hash_uniform(hash_combine(own, 1U)), hash_uniform(hash_combine(own, 2U)),
                                  hash_uniform(hash_combine(own, 3U)) };
        shade_direction reflected;
        candidate *const c = &out[count];
        if (!shade_sample(p, hash_uniform(own), random, &reflected) || !meet(t, origin, reflected.wi, &c->distance))
            continue;
        c->direction = reflected.wi;
        weigh(p, t, true, c);
        ++count;
    }
    return count;
}

static bool passes(const world *w, const candidate *c, vec3 origin, uint32_t bits, ray_counts *counts)
{
    const trace_ray ray = { .origin = origin, .direction = c->direction, .far = c->distance, .random = bits };
    ++counts->shadow_rays;
    return !trace_occluded(w->trace, &ray);
}

/* All places, or one of them that is drawn by its weight: the same share in the mean (resampled importance sampling,
 * Talbot et al. 2005). */
static double visible_share(const world *w, const candidate *all, int count, vec3 origin, const double *draw,
                            uint32_t bits, ray_counts *counts)
{
    double sum = 0.0, seen = 0.0, skipped = 0.0;
    for (int i = 0; i < count; ++i)
        sum += all[i].weight;
    if (!(sum > 0.0)) /* a sliver above the horizon, or next to nothing: let it through */
        return 1.0;
    double left = draw != NULL ? *draw * sum : 0.0;
    for (int i = 0; i < count; ++i) {
        if (!(all[i].weight > 0.0))
            continue;
        if (draw == NULL && all[i].weight < LEAST_SHARE * sum) {
            skipped += all[i].weight;
            continue;
        }
        if (draw == NULL) {
            seen += passes(w, &all[i], origin, hash_combine(bits, (uint32_t)i), counts) ? all[i].weight : 0.0;
            continue;
        }
        left -= all[i].weight;
        if (left < 0.0)
            return passes(w, &all[i], origin, bits, counts) ? 1.0 : 0.0;
    }
    return draw != NULL ? 1.0 : fmin(seen / (sum - skipped), 1.0); /* by rounding, none was drawn */
}

static shade_area shape_of(const target *t, vec3 point)
{
    const light *const l = t->light;
    if (l->kind == SCENE_LIGHT_DIRECTIONAL)
        return (shade_area){ .kind = GLINT_AREA_SUN,
                             .center = t->view->wi,
                             .radius = t->view->sine,
                             .solid_angle_sr = t->view->solid_angle_sr };
    const shade_area sphere = { .kind = GLINT_AREA_SPHERE, .center = v3_sub(l->position, point), .radius = l->radius };
    if (!light_is_area(l))
        return sphere;
    return (shade_area){ .kind = l->kind == SCENE_LIGHT_DISK ? GLINT_AREA_DISK : GLINT_AREA_RECTANGLE,
                         .center = sphere.center,
                         .half_x = l->half_x,
                         .half_y = l->half_y };
}

bool area_light_reaches(const world *w, const hit *h, const shade_point *p, const light *l, const light_view *view,
                        const sampler *random, uint32_t dimension, bool thorough, shade_area *area, ray_counts *counts)
{
    const target t = { l, view };
    *area = shape_of(&t, h->position);
    if (!shade_faces_area(p, area))
        return false;
    if (l->unshadowed)
        return true;
    double u[2], draw[2];
    sampler_pair(random, dimension, u);
    sampler_pair(random, dimension + PARTNER, draw);
    const uint32_t bits = sampler_bits(random, dimension + PARTNER);
    const vec3 origin = hit_leave(h, h->shadow_origin);
    const bool sharp = has_sharp_layer(p);
    candidate all[MOST_CANDIDATES];
    int count = spread(p, &t, origin, u, sharp, all);
    if (sharp)
        count += reflect(p, &t, origin, bits, &all[count]);
    const double seen = visible_share(w, all, count, origin, thorough ? NULL : &draw[0], bits, counts);
    area->hidden = (float)(1.0 - seen);
    return seen > 0.0;
}
