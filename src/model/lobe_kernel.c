/* The smooth reflection of GLINT_LANES points at a time, and which of their facets are lit. */
#include "model/lobe_kernel.h"

#include "light/cap.h"
#include "model/lobe_lanes.h"

static lobe_query query_of(const lobe_points *p, size_t i)
{
    lobe_query q = { .wo = { load_f(p->wo[0] + i), load_f(p->wo[1] + i), load_f(p->wo[2] + i) },
                     .wi = { load_f(p->wi[0] + i), load_f(p->wi[1] + i), load_f(p->wi[2] + i) },
                     .alpha_x = load_f(p->alpha_x + i),
                     .alpha_y = load_f((LIBRARY_ANISOTROPY ? p->alpha_y : p->alpha_x) + i) };
    for (int c = 0; c < 3; c++) {
        q.diffuse[c] = load_f(p->diffuse[c] + i);
        q.f0[c] = load_f(p->f0[c] + i);
        q.f90[c] = load_f(p->f90[c] + i);
    }
    return q;
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(lobe_kernel_, GLINT_LANES)(const glint_material_options *o, const lobe_points *points, size_t count,
                                     int counts, lobe_lit *lit)
{
    for (size_t i = 0; i < count; i += GLINT_LANES) {
        const lobe_query q = query_of(points, i);
        vfloat h_dot_wi;
        const vfloat3 h = lobe_halve_of(q.wo, q.wi, &h_dot_wi);
        const vfloat density = ndf_density_of(lobe_kind(o), q.alpha_x, q.alpha_y, h);
        lobe_shaded s;
        lobe_shade_of(o, &q, h_dot_wi, density, lobe_masking_of(o, &q), &s);
        for (int c = 0; c < 3; c++) {
            store_f(lit->specular[c] + i, s.specular[c]);
            store_f(lit->diffuse[c] + i, s.diffuse[c]);
        }
        if (!counts)
            continue;
        const vfloat half_vectors = cap_half_vector_solid_angle(load_f(points->solid_angle + i), h_dot_wi);
        const vfloat solid_angle = ndf_lit_solid_angle_of(lobe_kind(o), half_vectors, o->facet_alpha);
        store_f(lit->h[0] + i, h.x);
        store_f(lit->h[1] + i, h.y);
        store_f(lit->cap + i, solid_angle * h.z);
        store_f(lit->p + i, lobe_lit_probability_of(o, &q, load_f(points->total_area + i), density, h.z, solid_angle));
    }
}
