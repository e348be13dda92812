/* A light of real size over the facets that reflect it, by quadrature along its boundary until that is resolved.
 *
 * In the coordinates in which the distribution of the facets is uniform (light/sweep.h) the integrands of Kneiphof and
 * Klein 2024, Eqs. 3 and 13, are smooth, whatever the roughness, anisotropy and size of the light.
 */
#include "light/sweep.h"
#include "math/real.h"
#include "model/area_facets.h"
#include "model/lobe.h"

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
    area_facets sum; /* all of one sign, which is the boundary's sense of rotation */
} facet_integral;

/* Adds facets with normal h that have the area `area` over the surface's. */
static void add_facets(facet_integral *s, vec3d h, double area)
{
    s->sum.facets += area;
    s->sum.projected += area * h.z;
    s->sum.x += area * h.x;
    s->sum.y += area * h.y;
    const vec3 wo = s->q->wo;
    const vec3 m = vec3d_narrow(h);
    const float cosine = vec3_dot(wo, m);
    const vec3 wi = vec3_add(vec3_scale(m, 2.0F * cosine), vec3_scale(wo, -1.0F));
    if (!(cosine > 0.0F) || !(wi.z > 0.0F))
        return;
    const float g2 = ndf_correlated_masking(wo.z, s->masked_o, wi.z, ndf_masked(&s->distribution, wi));
    for (int c = 0; c < 3; c++)
        s->sum.specular[c] += area * (double)(lobe_facet_reflectance(s->q, c, fminf(cosine, 1.0F)) * g2 * cosine);
}

static void add_spoke(const sweep_node *n, void *user)
{
    facet_integral *s = user;
    const double span = s->v0 - n->v;
    s->sum.cap += 0.5 * n->twist;
    for (int i = 0; i < LEVELS; i++) {
        const double v = n->v + span * level_at[i];
        /* Slopes of GGX sqrt(1 - v^2) / v, of a Gaussian sqrt(-2 ln v). */
        const int is_ggx = s->distribution.kind == NDF_GGX;
        const double run =
            is_ggx ? sqrt(real_max(0.0, (1.0 - v) * (1.0 + v))) : sqrt(-2.0 * real_log(real_max(v, 1e-300)));
        const vec3d m = { (double)s->distribution.alpha_x * run * n->cosine,
                          (double)s->distribution.alpha_y * run * n->sine, is_ggx ? real_max(v, 1e-300) : 1.0 };
        const double length = vec3d_length(m);
        /* D dh = (D (n.h) dh) / (n.h) = v dv dt / (pi (n.h)) */
        const double area = n->turn * span * level_weight[i] * v * (length / m.z) * (1.0 / REAL_PI);
        add_facets(s, vec3d_scale(m, 1.0 / length), area);
    }
}

static void find_highest(const sweep_node *n, void *user)
{
    double *highest = user;
    *highest = real_max(*highest, n->v);
}

/* Where spokes begin. Of a light that does not hold the peak it is the boundary's highest level: where the boundary
 * passes the peak closely it turns fast, and spokes there had better be short. */
static double first_level(const area_light *light, const sweep_map *map, vec3d peak)
{
    if (area_touches(light, peak))
        return 1.0;
    double highest = 0.0;
    sweep_each(light, map, find_highest, &highest);
    return highest;
}

void area_facets_exact(const model_query *q, const area_light *light, area_facets *value)
{
    area_light seen = *light;
    *value = (area_facets){ .cap = 0.0 };
    if (!area_measure(&seen))
        return;
    facet_integral s = { .q = q, .distribution = lobe_ndf(q) };
    s.masked_o = ndf_masked(&s.distribution, q->wo);
    const sweep_map map = { { { 1.0 / (double)q->surface->alpha_x, 0.0, 0.0 },
                              { 0.0, 1.0 / (double)q->surface->alpha_y, 0.0 },
                              { 0.0, 0.0, 1.0 } },
                            vec3d_of(q->wo),
                            s.distribution.kind == NDF_BECKMANN };
    const vec3d mirrored = { -(double)q->wo.x, -(double)q->wo.y, (double)q->wo.z };
    s.v0 = first_level(&seen, &map, mirrored);
    sweep_each(&seen, &map, add_spoke, &s);
    const double sign = s.sum.facets < 0.0 ? -1.0 : 1.0;
    *value = (area_facets){ .facets = sign * s.sum.facets,
                            .projected = real_max(0.0, sign * s.sum.projected),
                            .x = sign * s.sum.x,
                            .y = sign * s.sum.y,
                            .cap = fabs(s.sum.cap) };
    for (int c = 0; c < 3; c++)
        value->specular[c] = real_max(0.0, sign * s.sum.specular[c]);
}
