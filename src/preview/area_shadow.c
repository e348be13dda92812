/* The share of a shape's effect that nothing hides: shadow rays weighted by what their places add.
 *
 * Analytic light times the share of it that is visible (Heitz, Hill and McGuire 2018, "Combining Analytic Direct
 * Illumination and Stochastic Shadows"). The share is a quotient of two integrals over the light, of f cos V and of f
 * cos. Places spread over the light, and some that the surface reflects, stand for both. The quotient is exact where
 * all rays agree, and nothing has to be weighed where all pass; in a half-shadow it tends to the truth as the places
 * grow in number.
 */
#include "preview/area_shadow.h"

#include "preview/hash.h"

/* Places that add less than this share of all do not count. */
#define LEAST_SHARE 0.01
/* Half the room of a depth's dimensions: those of lights have a partner there for their choice. */
#define PARTNER (1U << 19)
/* A round light of a smaller sine hides behind something as one: one ray to a place of it, even over the samples of a
 * pixel, says whether. Taste: eleven degrees across. */
#define ONE_RAY 0.1
/* Lobes so rough do not fall between four candidates: taste. */
#define ROUGH 0.3F

/* 1 / (density of the spread candidates, per steradian): cos |da| / d^2, 0 from behind, for a flat light; round ones
 * are even over their cap. */
static double steradians(const area_shadow *s, vec3 direction, double distance)
{
    const light *const l = s->light;
    if (!light_is_area(l))
        return (double)s->view.solid_angle_sr;
    const double cosine = v3_dot(direction, l->axis);
    return cosine > 0.0 ? light_area_m2(l) * cosine / (distance * distance) : 0.0;
}

static bool has_sharp_layer(const shade_point *p)
{
    for (int i = 0; i < shade_layers(p); ++i)
        if (fminf(p->layers[i].surface.alpha_x, p->layers[i].surface.alpha_y) < ROUGH)
            return true;
    return false;
}

/* The place of the light that lies in a direction. */
static bool meet(const area_shadow *s, vec3 origin, vec3 direction, double *distance)
{
    const light *const l = s->light;
    if (!light_is_area(l)) {
        *distance = s->view.distance;
        const double cosine = v3_dot(direction, s->view.wi);
        return cosine > 0.0 && v3_length(v3_mad(direction, s->view.wi, -cosine)) <= s->view.sine;
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

/* What the place that a ray leads to adds, by the balance heuristic over all rays of both kinds. */
static double weight_of(const area_shadow *s, const shade_point *p, const trace_ray *ray)
{
    const double solid_angle = steradians(s, ray->direction, ray->far);
    if (!(solid_angle > 0.0))
        return 0.0;
    const double density =
        AREA_SPREAD / solid_angle + (s->is_sharp ? AREA_REFLECTED * (double)shade_pdf(p, ray->direction) : 0.0);
    return (double)shade_level(p, ray->direction) / density;
}

static double weigh(const area_shadow *s, const shade_point *p, const trace_ray *rays, int count, double *weights)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        weights[i] = weight_of(s, p, &rays[i]);
        sum += weights[i];
    }
    return sum;
}

static void spread(const area_shadow *s, const double u[2], trace_ray *rays)
{
    for (int i = 0; i < AREA_SPREAD; ++i) {
        const int column = i % 2, row = i / 2;
        const double place[2] = { 0.5 * (column + u[0]), 0.5 * (row + u[1]) };
        trace_ray *const ray = &rays[i];
        if (light_is_area(s->light)) {
            const vec3 towards = v3_sub(light_point(s->light, place), ray->origin);
            ray->far = v3_length(towards);
            ray->direction = v3_normalize(towards);
        } else {
            light_pick(s->light, &s->view, ray->origin, place, &ray->direction, &ray->far);
        }
    }
}

/* Returns how many of the surface's own directions meet the light. */
static int reflect(const area_shadow *s, const shade_point *p, uint32_t bits, trace_ray *rays)
{
    int count = 0;
    for (uint32_t i = 0; i < AREA_REFLECTED; ++i) {
        const uint32_t own = hash_combine(bits, i);
        const float random[3] = { hash_uniform(hash_combine(own, 1U)), hash_uniform(hash_combine(own, 2U)),
                                  hash_uniform(hash_combine(own, 3U)) };
        shade_direction reflected;
        trace_ray *const ray = &rays[count];
        if (!shade_sample(p, hash_uniform(own), random, &reflected) || !meet(s, ray->origin, reflected.wi, &ray->far))
            continue;
        ray->direction = reflected.wi;
        ++count;
    }
    return count;
}

/* One of the rays, drawn by its weight, stands for all: the same share in the mean (resampled importance sampling,
 * Talbot et al. 2005). */
static int draw_one(const area_shadow *s, const shade_point *p, double draw, trace_ray *rays, int count)
{
    double weights[AREA_MOST_RAYS];
    double left = draw * weigh(s, p, rays, count, weights);
    for (int i = 0; i < count; ++i) {
        left -= weights[i];
        if (!(left < 0.0))
            continue;
        rays[0].direction = rays[i].direction;
        rays[0].far = rays[i].far;
        return 1;
    }
    return 0; /* a sliver above the horizon, or next to nothing; or none was drawn by rounding: let it through */
}

/* What is seen of all that the rays stand for. */
static double visible_share(const area_shadow *s, const shade_point *p, const trace_ray *rays, const bool *dark)
{
    double weights[AREA_MOST_RAYS], seen = 0.0, skipped = 0.0;
    const double sum = weigh(s, p, rays, s->ray_count, weights);
    if (!(sum > 0.0)) /* a sliver above the horizon, or next to nothing: let it through */
        return 1.0;
    for (int i = 0; i < s->ray_count; ++i) {
        if (weights[i] < LEAST_SHARE * sum)
            skipped += weights[i];
        else if (!dark[i])
            seen += weights[i];
    }
    return fmin(seen / (sum - skipped), 1.0);
}

static shade_area shape_of(const area_shadow *s, vec3 point)
{
    const light *const l = s->light;
    if (l->kind == SCENE_LIGHT_DIRECTIONAL)
        return (shade_area){ .kind = GLINT_AREA_SUN,
                             .center = s->view.wi,
                             .radius = s->view.sine,
                             .solid_angle_sr = s->view.solid_angle_sr };
    const shade_area sphere = { .kind = GLINT_AREA_SPHERE, .center = v3_sub(l->position, point), .radius = l->radius };
    if (!light_is_area(l))
        return sphere;
    return (shade_area){ .kind = l->kind == SCENE_LIGHT_DISK ? GLINT_AREA_DISK : GLINT_AREA_RECTANGLE,
                         .center = sphere.center,
                         .half_x = l->half_x,
                         .half_y = l->half_y };
}

bool area_shadow_begin(const hit *h, const shade_point *p, const sampler *random, uint32_t dimension, bool thorough,
                       area_shadow *s, trace_ray *rays, shade_area *area)
{
    const light *const l = s->light;
    s->ray_count = 0;
    s->is_shared = false;
    *area = shape_of(s, h->position);
    if (!shade_faces_area(p, area))
        return false;
    if (l->unshadowed || s->is_clear)
        return true;
    double u[2], draw[2];
    const bool is_one = !light_is_area(l) && s->view.sine < ONE_RAY;
    const uint32_t bits = sampler_bits(random, dimension + PARTNER);
    if (is_one) {
        rays[0].random = bits;
        s->ray_count = 1;
        return true;
    }
    sampler_pair(random, dimension, u);
    for (uint32_t i = 0; i < AREA_MOST_RAYS; ++i)
        rays[i] = (trace_ray){ .origin = rays[0].origin, .random = thorough ? hash_combine(bits, i) : bits };
    s->is_sharp = has_sharp_layer(p);
    spread(s, u, rays);
    const int count = AREA_SPREAD + (s->is_sharp ? reflect(s, p, bits, &rays[AREA_SPREAD]) : 0);
    s->is_shared = thorough;
    s->ray_count = count;
    if (!thorough) {
        sampler_pair(random, dimension + PARTNER, draw);
        s->ray_count = draw_one(s, p, draw[0], rays, count);
    }
    return true;
}

bool area_shadow_end(const area_shadow *s, const shade_point *p, const trace_ray *rays, const bool *dark,
                     shade_area *area)
{
    bool is_any = false;
    for (int i = 0; i < s->ray_count; ++i)
        is_any = is_any || dark[i];
    if (!is_any || !s->is_shared)
        return !is_any;
    const double seen = visible_share(s, p, rays, dark);
    area->hidden = (float)(1.0 - seen);
    return seen > 0.0;
}
