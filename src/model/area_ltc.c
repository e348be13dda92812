/* A light of real size over the facets that reflect it, by linearly transformed cosines.
 *
 * Kneiphof and Klein 2024, section 4: one transformed cosine stands for the reflection and for the facets, each with a
 * scale of its own (directional albedo; D_PR, Eq. 19). A transformed cosine alone is off by what the fit leaves: up to
 * tens of percent where only a part of the lobe is lit. So both integrals are corrected by the quotient of the true
 * integrand and the fitted one, averaged over a few points of the light. They are points of the moved light, where
 * equal areas of its projection to the ground carry equal shares of the fitted lobe. A small light is then exact; a
 * light that takes in the whole lobe needs no correction, and gets none.
 */
#include "light/ltc.h"
#include "math/real.h"
#include "model/area_facets.h"
#include "model/lobe.h"

/* Between the largest and the smallest quotient of the points of a light: beyond this they are not enough. Chosen so
 * that the errors in docs/lights.md hold. */
#define COARSE_SPREAD 1.3
#define FINE_SPREAD 3.0

/* Reflections below this share of the light's own half vectors, about as much of what a white diffuse surface shows,
 * are not worth more points. Taste. */
#define DARK 3e-4

/* The boundary by directions: corners, or for an ellipse the ends of its arcs. */
static int find_corners(const area_light *l, vec3d corner[AREA_MOST_PIECES])
{
    const int count = area_piece_count(l);
    for (int i = 0; i < count; i++) {
        vec3d derivative;
        if (l->kind == AREA_POLYGON) {
            corner[i] = l->corner[i];
            continue;
        }
        area_boundary(l, i, 0.0, &corner[i], &derivative);
        corner[i] = vec3d_normalize(corner[i]);
    }
    return count;
}

static vec3d half_way(const area_light *l, int piece)
{
    vec3d at, derivative;
    area_boundary(l, piece, 0.5, &at, &derivative);
    return vec3d_normalize(at);
}

/* What the points add up to. Quotients are over the fitted density times their share of it. */
typedef struct quotients {
    const model_query *q;
    const ltc *fit;
    ndf distribution;
    float masked_o;
    int is_schlick;                       /* then fresnel[0] has f times (1 - h.wi)^5, which does for all channels */
    double weight, reflected, fresnel[3]; /* of f with F = 1; of f with F */
    double facets, x, y, z;               /* of D / (4 h.wi); of the same times h */
    double cap;                           /* of half vectors, seen from above */
    double least, most;                   /* quotient of f */
} quotients;

/* A point of the moved light. */
static void add_point(quotients *s, vec3d moved, double weight)
{
    const ltc *l = s->fit;
    const vec3d back = vec3d_add(vec3d_mad(vec3d_scale(l->column[0], moved.x), l->column[1], moved.y),
                                 vec3d_scale(l->column[2], moved.z));
    const vec3d w = vec3d_normalize(back);
    const vec3 wi = vec3d_narrow(w), wo = s->q->wo;
    const vec3 sum = vec3_add(wo, wi);
    const float length = sqrtf(vec3_dot(sum, sum));
    if (!(weight > 0.0) || !(wi.z > 0.0F) || !(length > 1e-6F))
        return;
    const vec3 h = vec3_scale(sum, 1.0F / length);
    const float cosine = fminf(0.5F * length, 1.0F);
    /* G2 / (cos_o cos_i): neither vanishes at the horizon. */
    const float masked_i = ndf_masked(&s->distribution, wi);
    const double cos_o = (double)wo.z, cos_i = (double)wi.z, density = (double)ndf_density(&s->distribution, h);
    const double masking = 0.25 / (cos_o * cos_i + (double)s->masked_o * cos_i + (double)masked_i * cos_o);
    const double inverse = 1.0 / ltc_density_over_cosine(l, w), quotient = density * inverse * masking;
    s->least = real_min(s->least, quotient);
    s->most = real_max(s->most, quotient);
    /* Solid angle of half vectors, over the share of the fitted lobe. */
    const double solid_angle = weight * inverse / (4.0 * (double)cosine * cos_i);
    const double reflected = weight * quotient, facets = solid_angle * density;
    s->weight += weight;
    s->cap += solid_angle * (double)h.z;
    s->reflected += reflected;
    s->facets += facets;
    s->x += facets * (double)h.x;
    s->y += facets * (double)h.y;
    s->z += facets * (double)h.z;
    if (s->is_schlick) {
        const double m = 1.0 - (double)cosine, m2 = m * m;
        s->fresnel[0] += reflected * (m2 * m2 * m);
        return;
    }
    for (int c = 0; c < 3; c++)
        s->fresnel[c] += reflected * (double)lobe_facet_reflectance(s->q, c, cosine);
}

/* The mean reflectance of the facets that light the viewer. */
static double fresnel_of(const quotients *s, int channel)
{
    if (!s->is_schlick)
        return s->fresnel[channel] / s->reflected;
    const double f0 = (double)s->q->surface->f0[channel], f90 = (double)s->q->surface->f90[channel];
    return f0 + (f90 - f0) * (s->fresnel[0] / s->reflected);
}

/* One triangle of directions: its middle, by its projected size. */
static void add_triangle(quotients *s, vec3d a, vec3d b, vec3d c)
{
    const vec3d middle = vec3d_normalize(vec3d_add(vec3d_add(a, b), c));
    add_point(s, middle, vec3d_length(vec3d_cross(vec3d_sub(b, a), vec3d_sub(c, a))) * middle.z);
}

/* Triangles between the middle and the boundary; fine: each in four. */
static void add_points(quotients *s, const area_light *moved, int is_fine)
{
    vec3d corner[AREA_MOST_PIECES];
    const int count = find_corners(moved, corner);
    const vec3d m = moved->middle;
    s->weight = s->reflected = s->facets = s->x = s->y = s->z = s->cap = s->most = 0.0;
    s->fresnel[0] = s->fresnel[1] = s->fresnel[2] = 0.0;
    s->least = 1e30;
    for (int i = 0; i < count; i++) {
        const vec3d a = corner[i], b = corner[(i + 1) % count];
        if (!is_fine) {
            add_triangle(s, m, a, b);
            continue;
        }
        const vec3d ma = vec3d_normalize(vec3d_add(m, a)), mb = vec3d_normalize(vec3d_add(m, b));
        const vec3d ab = half_way(moved, i);
        add_triangle(s, m, ma, mb);
        add_triangle(s, ma, a, ab);
        add_triangle(s, mb, b, ab);
        add_triangle(s, ma, mb, ab);
    }
}

void area_facets_fast(const model_query *q, const area_light *light, area_facets *value)
{
    const ltc fit = ltc_find(lobe_ndf(q).kind, (double)q->surface->alpha_x, vec3d_of(q->wo));
    area_light moved;
    *value = (area_facets){ .cap = 0.0 };
    if (!ltc_move(&fit, light, &moved))
        return;
    quotients s = { .q = q, .fit = &fit, .distribution = lobe_ndf(q) };
    s.is_schlick = q->material->options.fresnel == GLINT_FRESNEL_SCHLICK;
    s.masked_o = ndf_masked(&s.distribution, q->wo);
    const double part = moved.moment.z * (1.0 / REAL_PI);
    add_points(&s, &moved, 0);
    if (s.most > COARSE_SPREAD * s.least) {
        add_points(&s, &moved, 1);
        if (s.most > FINE_SPREAD * s.least && s.most * s.weight > DARK * s.cap) {
            area_facets_exact(q, light, value);
            return;
        }
    }
    if (!(s.weight > 0.0) || !(s.reflected > 0.0) || !(s.facets > 0.0))
        return;
    value->cap = part * s.cap / s.weight;
    /* The whole lobe's quotient is the scale from the table: the more of it is lit, the less the points have to say. */
    const double known = part * part * part * part;
    const double reflected = part * (known * fit.albedo + (1.0 - known) * s.reflected / s.weight);
    value->facets = part * (known * fit.facets + (1.0 - known) * s.facets / s.weight);
    for (int c = 0; c < 3; c++)
        value->specular[c] = reflected * fresnel_of(&s, c);
    value->projected = value->facets * s.z / s.facets;
    value->x = value->facets * s.x / s.facets;
    value->y = value->facets * s.y / s.facets;
}
