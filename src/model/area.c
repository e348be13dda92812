/* The smooth reflection of a light of real size, and the chance that a facet reflects it to the viewer. */
#include "model/area.h"

#include "light/sweep.h"
#include "math/float_bits.h"
#include "math/real.h"
#include "model/lobe.h"

/* ---- geometry ---- */

static int is_usable(const float v[3])
{
    return is_below(v[0], 1e15F) && is_below(v[1], 1e15F) && is_below(v[2], 1e15F);
}

static void see_sphere(const glint_area_light *from, area_light *light)
{
    const vec3d center = vec3d_from(from->center);
    const double distance = vec3d_length(center), radius = (double)clamp_to(from->radius, 0.0F, 1e15F);
    /* It shines outwards: there is nothing to see from within. */
    if (!(distance > radius) || !(distance > 0.0))
        return;
    const double sine = radius / distance;
    area_make_round(light, vec3d_scale(center, 1.0 / distance), sine, sqrt((1.0 - sine) * (1.0 + sine)));
}

static void see_sun(const glint_area_light *from, area_light *light)
{
    /* A cap of solid angle 2 pi (1 - cos). */
    const vec3d axis = vec3d_normalize(vec3d_from(from->center));
    const double versine = (double)clamp_to(from->solid_angle_sr, 0.0F, 6.28318531F) / (2.0 * REAL_PI);
    const double sine = sqrt(fmax(0.0, versine * (2.0 - versine)));
    if (vec3d_dot(axis, axis) > 0.5)
        area_make_round(light, axis, sine, fmax(0.0, 1.0 - versine));
}

static void see_polygon(const glint_area_light *from, area_light *light)
{
    vec3d corner[GLINT_MAX_CORNERS];
    if (from->corner_count < 3U || from->corner_count > GLINT_MAX_CORNERS)
        return;
    for (uint32_t i = 0; i < from->corner_count; i++) {
        if (!is_usable(from->corners[i]))
            return;
        corner[i] = vec3d_from(from->corners[i]);
    }
    area_make_polygon(light, corner, (int)from->corner_count, from->two_sided != 0U);
}

int area_see(const model_query *q, area_light *light)
{
    const glint_area_light *from = q->area_light;
    light->kind = AREA_NOTHING;
    if (from->kind == GLINT_AREA_POLYGON) {
        see_polygon(from, light);
        return light->kind != AREA_NOTHING;
    }
    if (!is_usable(from->center))
        return 0;
    const vec3d center = vec3d_from(from->center);
    switch (from->kind) {
    case GLINT_AREA_SPHERE:
        see_sphere(from, light);
        break;
    case GLINT_AREA_SUN:
        see_sun(from, light);
        break;
    case GLINT_AREA_RECTANGLE:
    case GLINT_AREA_DISK:
        if (is_usable(from->half_x) && is_usable(from->half_y))
            (from->kind == GLINT_AREA_DISK ? area_make_ellipse : area_make_rectangle)(
                light, center, vec3d_from(from->half_x), vec3d_from(from->half_y), from->two_sided != 0U);
        break;
    case GLINT_AREA_POLYGON:
        break;
    }
    return light->kind != AREA_NOTHING;
}

/* ---- facets ---- */

enum { LEVELS = 8 };

/* Gauss and Legendre's on [0, 1]: between the lobe's levels. */
static const double level_at[LEVELS] = { 0.01985507175123188, 0.10166676129318664, 0.23723379504183550,
                                         0.40828267875217510, 0.59171732124782490, 0.76276620495816450,
                                         0.89833323870681336, 0.98014492824876812 };
static const double level_weight[LEVELS] = { 0.05061426814518813, 0.11119051722668724, 0.15685332293894364,
                                             0.18134189168918100, 0.18134189168918100, 0.15685332293894364,
                                             0.11119051722668724, 0.05061426814518813 };

typedef struct facet_integral {
    const model_query *q;
    ndf distribution;
    float masked_o;
    double v0;
    double facets, projected; /* integrals of D and of D (n.h) over the half vectors */
    double specular[3], x, y; /* of the lobe; of D h */
    double twist;
} facet_integral;

/* Adds facets with normal h that have the area `area` over the surface's. */
static void add_facets(facet_integral *s, vec3d h, double area)
{
    s->facets += area;
    s->projected += area * h.z;
    s->x += area * h.x;
    s->y += area * h.y;
    const vec3 wo = s->q->wo;
    const vec3 m = vec3d_narrow(h);
    const float cosine = vec3_dot(wo, m);
    const vec3 wi = vec3_add(vec3_scale(m, 2.0F * cosine), vec3_scale(wo, -1.0F));
    if (!(cosine > 0.0F) || !(wi.z > 0.0F))
        return;
    const float g2 = ndf_correlated_masking(wo.z, s->masked_o, wi.z, ndf_masked(&s->distribution, wi));
    for (int c = 0; c < 3; c++)
        s->specular[c] += area * (double)(lobe_facet_reflectance(s->q, c, fminf(cosine, 1.0F)) * g2 * cosine);
}

static void add_spoke(const sweep_node *n, void *user)
{
    facet_integral *s = user;
    const double span = s->v0 - n->v;
    s->twist += n->twist;
    for (int i = 0; i < LEVELS; i++) {
        const double v = n->v + span * level_at[i];
        /* Slopes of GGX sqrt(1 - v^2) / v, of a Gaussian sqrt(-2 ln v). */
        const int is_ggx = s->distribution.kind == NDF_GGX;
        const double run = is_ggx ? sqrt(fmax(0.0, (1.0 - v) * (1.0 + v))) : sqrt(-2.0 * real_log(fmax(v, 1e-300)));
        const vec3d m = { (double)s->distribution.alpha_x * run * n->cosine,
                          (double)s->distribution.alpha_y * run * n->sine, is_ggx ? fmax(v, 1e-300) : 1.0 };
        const double length = vec3d_length(m);
        /* D dh = (D (n.h) dh) / (n.h) = v dv dt / (pi (n.h)) */
        const double area = n->turn * span * level_weight[i] * v * (length / m.z) * (1.0 / REAL_PI);
        add_facets(s, vec3d_scale(m, 1.0 / length), area);
    }
}

static void integrate_facets(const model_query *q, const area_light *light, facet_integral *s)
{
    *s = (facet_integral){ .q = q, .distribution = lobe_ndf(q) };
    s->masked_o = ndf_masked(&s->distribution, q->wo);
    const sweep_map map = { { { 1.0 / (double)q->surface->alpha_x, 0.0, 0.0 },
                              { 0.0, 1.0 / (double)q->surface->alpha_y, 0.0 },
                              { 0.0, 0.0, 1.0 } },
                            vec3d_of(q->wo),
                            s->distribution.kind == NDF_BECKMANN };
    const vec3d mirrored = { -(double)q->wo.x, -(double)q->wo.y, (double)q->wo.z };
    s->v0 = area_contains(light, mirrored) ? 1.0 : sweep_level(&map, light->middle);
    sweep_each(light, &map, add_spoke, s);
}

/* p of Eq. 12, with the lobe of a rough facet as more half vectors around those of the light. */
static void find_lit(const model_query *q, const facet_integral *s, area_value *value)
{
    const glint_material_options *o = &q->material->options;
    const double facets = fabs(s->facets);
    const double cap = 0.5 * fabs(s->twist);
    const vec3d mean = facets > 0.0 ? (vec3d){ s->x / s->facets, s->y / s->facets, s->projected / s->facets }
                                    : (vec3d){ 0.0, 0.0, 1.0 };
    value->h = vec3d_narrow(mean);
    const double lobe = (double)ndf_facet_solid_angle(s->distribution.kind, o->facet_alpha) * mean.z;
    const double wider = lobe > 0.0 && cap > 0.0 ? 1.0 + lobe / cap : 1.0;
    double p = fabs(s->projected);
    if (o->weighting == GLINT_WEIGHTING_EQUAL_AREA)
        p = facets / (double)(q->total_area > 0.0F ? q->total_area : ndf_total_area(&s->distribution));
    value->lit_probability = (float)fmin(p * wider, 1.0);
    value->cap = (float)(cap + lobe);
}

/* ---- the base ---- */

/* The mean over the light of what the base reflects, by its share of the light: the form factor is exact, the albedo
 * hardly changes with the angle. */
static void integrate_base(const model_query *q, const area_light *light, area_value *value)
{
    const float *diffuse = q->surface->diffuse;
    if (!(diffuse[0] > 0.0F || diffuse[1] > 0.0F || diffuse[2] > 0.0F))
        return;
    /* Gauss's points with two nodes, along the boundary and from the middle outwards. */
    static const double at[2] = { 0.21132486540518712, 0.78867513459481288 };
    double weight = 0.0, sum[3] = { 0.0, 0.0, 0.0 };
    for (int i = 0; i < area_piece_count(light); i++)
        for (int k = 0; k < 4; k++) {
            vec3d rim, derivative;
            area_boundary(light, i, at[k & 1], &rim, &derivative);
            const double s = at[k >> 1];
            const vec3d x = vec3d_mad(vec3d_scale(light->middle, 1.0 - s), rim, s);
            const double length2 = vec3d_dot(x, x), height = x.z / sqrt(length2);
            /* Solid angle s |middle . (rim x rim')| / |x|^3 of the point's share, times the cosine. */
            const double w = s * fabs(vec3d_dot(light->middle, vec3d_cross(rim, derivative))) / length2 * x.z / length2;
            weight += w;
            for (int c = 0; c < 3; c++)
                sum[c] += w * (double)lobe_base_albedo(q, c, (float)fmin(fmax(height, 0.0), 1.0));
        }
    for (int c = 0; c < 3 && weight > 0.0; c++)
        value->diffuse[c] = (float)(light->moment.z * (1.0 / REAL_PI) * sum[c] / weight);
}

void area_eval(const model_query *q, area_value *value)
{
    *value = (area_value){ { 0.0F }, { 0.0F }, 0.0F, { 0.0F, 0.0F, 1.0F }, 0.0F };
    area_light light;
    if (!area_see(q, &light))
        return;
    facet_integral s;
    integrate_facets(q, &light, &s);
    find_lit(q, &s, value);
    integrate_base(q, &light, value);
    const float seen = 1.0F - clamp_to(q->area_light->hidden, 0.0F, 1.0F);
    value->lit_probability *= seen;
    value->cap *= seen;
    for (int c = 0; c < 3; c++) {
        value->specular[c] = seen * q->material->options.coverage * (float)fabs(s.specular[c]);
        value->diffuse[c] *= seen;
    }
}
