/* Gathers queries for the vectors that integrate over their lights; lights that are not plain go one at a time. */
#include "math/float_bits.h"
#include "model/area.h"
#include "model/area_kernel.h"
#include "model/machine_lanes.h"

area_kernel *area_kernel_widest(size_t most_lanes)
{
    switch (machine_lanes(most_lanes)) {
#if defined(__x86_64__)
    case 16:
        return area_kernel_16;
    case 8:
        return area_kernel_8;
#endif
#if defined(__x86_64__) || defined(__aarch64__)
    case 4:
        return area_kernel_4;
#endif
    default:
        return area_kernel_1;
    }
}

static void gather(const model_query *q, size_t i, area_crowd *c)
{
    const glint_surface *s = q->surface;
    const glint_area_light *l = q->area_light;
    const float wo[3] = { q->wo.x, q->wo.y, q->wo.z };
    c->alpha_x[i] = s->alpha_x;
    c->alpha_y[i] = s->alpha_y;
    c->total_area[i] = q->total_area;
    c->hidden[i] = clamp_to(l->hidden, 0.0F, 1.0F);
    c->kind[i] = (int32_t)l->kind;
    c->two_sided[i] = (int32_t)l->two_sided;
    c->size[i] = l->kind == GLINT_AREA_SPHERE ? l->radius : l->solid_angle_sr;
    for (int k = 0; k < 3; k++) {
        c->wo[k][i] = wo[k];
        c->diffuse[k][i] = s->diffuse[k];
        c->f0[k][i] = s->f0[k];
        c->f90[k][i] = s->f90[k];
        c->center[k][i] = l->center[k];
        c->half_x[k][i] = l->half_x[k];
        c->half_y[k][i] = l->half_y[k];
    }
}

/* Of what is a polygon, however few of them are. */
static void gather_corners(const model_query *q, size_t i, area_crowd *c)
{
    const int is_polygon = q->area_light->kind == GLINT_AREA_POLYGON;
    const uint32_t asked = is_polygon ? q->area_light->corner_count : 0U;
    const int count = asked >= 3U && asked <= GLINT_MAX_CORNERS ? (int)asked : 0;
    c->corner_count[i] = count;
    for (int k = 0; k < GLINT_MAX_CORNERS; k++)
        for (int axis = 0; axis < 3; axis++)
            c->corner[k][axis][i] = count > 0 ? q->area_light->corners[k < count ? k : 0][axis] : 0.0F;
    const int even = count + (count & 1);
    c->most_corners = even > c->most_corners ? even : c->most_corners;
}

static area_value take(const lobe_lit *lit, size_t i, int counts)
{
    area_value v = { .lit_probability = 0.0F };
    for (int c = 0; c < 3; c++) {
        v.specular[c] = lit->specular[c][i];
        v.diffuse[c] = lit->diffuse[c][i];
    }
    if (!counts)
        return v;
    v.h = (vec3){ lit->h[0][i], lit->h[1][i], 0.0F }; /* nobody asks for its height */
    v.cap = lit->cap[i];
    v.lit_probability = lit->p[i];
    return v;
}

static void put(const area_value *v, lobe_lit *lit, size_t i)
{
    for (int c = 0; c < 3; c++) {
        lit->specular[c][i] = v->specular[c];
        lit->diffuse[c][i] = v->diffuse[c];
    }
    lit->h[0][i] = v->h.x;
    lit->h[1][i] = v->h.y;
    lit->cap[i] = v->cap;
    lit->p[i] = v->lit_probability;
}

/* What area_eval does after area_eval_plain. */
static void finish(const model_query *q, float left, int counts, lobe_lit *lit, size_t i)
{
    area_value other;
    area_eval_any(q, &other);
    if (left < 1.0F) {
        area_value value = take(lit, i, counts);
        area_mix(&value, &other, left);
        other = value;
    }
    put(&other, lit, i);
}

void area_eval_many(const model_query *q, size_t count, int counts, lobe_lit *lit)
{
    const glint_material_options *o = &q->material->options;
    const int is_exact = o->area_light_method == GLINT_AREA_LIGHT_EXACT;
    area_crowd crowd;
    float left[LOBE_MOST];
    /* What is left of a vector repeats the last. */
    const size_t padded = (count + MOST_LANES - 1) / MOST_LANES * MOST_LANES;
    int has_polygons = 0;
    for (size_t i = 0; i < count; i++) {
        gather(&q[i], i, &crowd);
        has_polygons |= q[i].area_light->kind == GLINT_AREA_POLYGON;
    }
    for (size_t i = count; i < padded; i++)
        gather(&q[count - 1], i, &crowd);
    crowd.most_corners = 0;
    /* Squares of polygons are for the fast integral. */
    for (size_t i = 0; has_polygons && !is_exact && i < padded; i++)
        gather_corners(&q[i < count ? i : count - 1], i, &crowd);
    area_kernel_widest(MOST_LANES)(o, &crowd, padded, counts, lit, left);
    for (size_t i = 0; i < count; i++)
        if (left[i] > 0.0F)
            finish(&q[i], left[i], counts, lit, i);
}
