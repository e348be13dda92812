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

static void begin_nodes(const model_query *q, const area_lobe *l, area_nodes *n)
{
    n->is_ggx = l->is_ggx;
    n->is_schlick = l->is_schlick;
    n->has_base = has_base(q);
    n->wo = q->wo;
    n->visible_o = l->visible_o;
    n->alpha_x = l->alpha_x;
    n->alpha_y = l->alpha_y;
}

static plain_sums sums_of(const area_nodes *n, int rule)
{
    area_node_sums s;
    this_machine().sum(n, plain_rule(rule), &s);
    return (plain_sums){ { s.reflected, { s.fresnel[0], s.fresnel[1] }, s.facets, s.x, s.y, s.z, s.cap },
                         { s.cosine[0], s.cosine[1], s.cosine[2] } };
}

static void shade(const model_query *q, const plain_query *plain, const plain_sums *sums, area_value *value)
{
    plain_value v;
    plain_shade(&q->material->options, plain, sums, has_base(q), &v);
    const area_lit lit = plain_lit(&q->material->options, plain, sums);
    *value = (area_value){ .lit_probability = lit.p, .h = vec3_of(lit.h), .cap = lit.cap };
    for (int c = 0; c < 3; c++) {
        value->specular[c] = v.specular[c];
        value->diffuse[c] = v.diffuse[c];
    }
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

static plain_light take_one(const model_query *q, const area_lobe *l, const plain_query *plain, area_nodes *n)
{
    const plain_limits most = plain_limits_of(&q->material->options);
    const plain_light p = plain_light_of(l, plain, &most);
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
    const lobe_query *const s = &plain.lobe;
    const area_lobe l =
        area_lobe_of(lobe_kind(o) == NDF_GGX, o->fresnel == GLINT_FRESNEL_SCHLICK, s->wo,
                     s->wo.z + ndf_masked_of(lobe_kind(o), s->alpha_x, s->alpha_y, s->wo), s->alpha_x, s->alpha_y);
    area_nodes nodes;
    begin_nodes(q, &l, &nodes);
    const int is_polygon = q->area_light->kind == GLINT_AREA_POLYGON && o->area_light_method != GLINT_AREA_LIGHT_EXACT;
    const plain_light p = is_polygon ? take_polygon(q, &nodes) : take_one(q, &l, &plain, &nodes);
    if (p.rule == PLAIN_LEFT)
        return 1.0F;
    const plain_sums sums = p.rule == PLAIN_DARK ? plain_no_sums() : sums_of(&nodes, p.rule);
    shade(q, &plain, &sums, value);
    return p.left;
}
