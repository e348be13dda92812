/* A plain light at one point: what area_kernel.c computes for many, with the light's points side by side instead. */
#define GLINT_LANES 1
#include "model/area_plain.h"

#include "math/float_bits.h"
#include "model/area.h"
#include "model/area_nodes.h"

static vfloat3 of(vec3 v)
{
    return (vfloat3){ v.x, v.y, v.z };
}

static vfloat3 from(const float v[3])
{
    return (vfloat3){ v[0], v[1], v[2] };
}

static vec3 vec3_of(vfloat3 v)
{
    return (vec3){ v.x, v.y, v.z };
}

static plain_query query_of(const model_query *q)
{
    const glint_surface *s = q->surface;
    const glint_area_light *l = q->area_light;
    return (plain_query){ .lobe = { .wo = of(q->wo),
                                    .alpha_x = s->alpha_x,
                                    .alpha_y = s->alpha_y,
                                    .diffuse = { s->diffuse[0], s->diffuse[1], s->diffuse[2] },
                                    .f0 = { s->f0[0], s->f0[1], s->f0[2] },
                                    .f90 = { s->f90[0], s->f90[1], s->f90[2] } },
                          .total_area = q->total_area,
                          .hidden = clamp_to(l->hidden, 0.0F, 1.0F),
                          .kind = (int32_t)l->kind,
                          .two_sided = (int32_t)l->two_sided,
                          .center = from(l->center),
                          .half_x = from(l->half_x),
                          .half_y = from(l->half_y),
                          .size = l->kind == GLINT_AREA_SPHERE ? l->radius : l->solid_angle_sr };
}

static int has_base(const model_query *q)
{
    const float *d = q->surface->diffuse;
    return d[0] > 0.0F || d[1] > 0.0F || d[2] > 0.0F;
}

/* What there is for processors of the base and for those with AVX2. */
typedef struct machine {
    area_nodes_sum *sum;
    area_fan_of *fan;
} machine;

static machine this_machine(void)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        return (machine){ area_nodes_sum_avx2, area_fan_of_avx2 };
#endif
    return (machine){ area_nodes_sum_base, area_fan_of_base };
}

static inline __attribute__((always_inline)) area_eye eye_of(const model_query *q)
{
    const glint_material_options *o = &q->material->options;
    const ndf_kind kind = lobe_kind(o);
    const float x = q->surface->alpha_x, y = q->surface->alpha_y;
    return (area_eye){ kind == NDF_GGX,
                       o->fresnel == GLINT_FRESNEL_SCHLICK,
                       has_base(q),
                       q->wo,
                       q->wo.z + ndf_masked_of(kind, x, y, of(q->wo)),
                       x,
                       y };
}

static inline __attribute__((always_inline)) void shade(const model_query *q, const plain_query *plain,
                                                        const area_node_sums *s, area_value *value)
{
    const glint_material_options *const o = &q->material->options;
    const plain_sums sums = { { s->reflected, { s->fresnel[0], s->fresnel[1] }, s->facets, s->x, s->y, s->z, s->cap },
                              { s->cosine[0], s->cosine[1], s->cosine[2] } };
    plain_value v;
    plain_shade(o, plain, &sums, has_base(q), &v);
    const area_lit lit = plain_lit(o, plain, &sums);
    *value = (area_value){ .lit_probability = lit.p, .h = vec3_of(lit.h), .cap = lit.cap };
    for (int c = 0; c < 3; c++) {
        value->specular[c] = v.specular[c];
        value->diffuse[c] = v.diffuse[c];
    }
}

area_eye area_eye_of(const model_query *q)
{
    return eye_of(q);
}

void area_shade(const model_query *q, const area_node_sums *sums, area_value *value)
{
    const plain_query plain = query_of(q);
    shade(q, &plain, sums, value);
}

static plain_light take_polygon(const model_query *q, area_nodes *n)
{
    const glint_area_light *l = q->area_light;
    plain_light p = { .rule = PLAIN_LEFT, .left = 1.0F };
    if (l->corner_count >= 3U && l->corner_count <= GLINT_MAX_CORNERS)
        p.rule = this_machine().fan(l->corners, (int)l->corner_count, l->two_sided != 0U, n, &p.left);
    return p;
}

static void store_3(float to[3][AREA_ROOM], vfloat3 v)
{
    to[0][0] = v.x;
    to[1][0] = v.y;
    to[2][0] = v.z;
}

static plain_light take_one(const model_query *q, const plain_query *plain, area_nodes *n)
{
    const plain_limits most = plain_limits_of(&q->material->options);
    const area_eye *const eye = &n->eye;
    const area_lobe l =
        area_lobe_of(eye->is_ggx, eye->is_schlick, of(eye->wo), eye->visible_o, eye->alpha_x, eye->alpha_y);
    const plain_light p = plain_light_of(&l, plain, &most);
    n->is_bent = 0;
    n->count = 1;
    store_3(n->parts.middle, p.middle);
    store_3(n->parts.u, p.u);
    store_3(n->parts.v, p.v);
    n->parts.size[0] = p.size;
    return p;
}

/* ---- contract ---- */

float area_eval_plain(const model_query *q, area_value *value)
{
    const glint_material_options *o = &q->material->options;
    const plain_query plain = query_of(q);
    area_nodes nodes;
    nodes.eye = eye_of(q);
    const int is_polygon = q->area_light->kind == GLINT_AREA_POLYGON && o->area_light_method != GLINT_AREA_LIGHT_EXACT;
    const plain_light p = is_polygon ? take_polygon(q, &nodes) : take_one(q, &plain, &nodes);
    if (p.rule == PLAIN_LEFT)
        return 1.0F;
    area_node_sums sums = { .reflected = 0.0F };
    if (p.rule != PLAIN_DARK)
        this_machine().sum(&nodes, plain_rule(p.rule), &sums);
    shade(q, &plain, &sums, value);
    return p.left;
}
