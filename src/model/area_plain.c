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
static area_nodes_sum *sum_for_this_machine(void)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        return area_nodes_sum_avx2;
#endif
    return area_nodes_sum_base;
}

static area_patch patch_of(const plain_light *p)
{
    return (area_patch){ vec3_of(p->middle), vec3_of(p->u), vec3_of(p->v), p->size };
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
    n->count = 0;
}

static plain_sums sums_of(const area_nodes *n, int rule)
{
    area_node_sums s;
    sum_for_this_machine()(n, &cubatures[rule / CUBATURE_LEVELS][rule % CUBATURE_LEVELS], &s);
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

/* ---- polygons: triangles that share a corner, or the middle ---- */

typedef struct fan {
    int count;
    vfloat3 corner[GLINT_MAX_CORNERS]; /* over the distance of the middle */
    vfloat3 edge[GLINT_MAX_CORNERS];   /* from the first corner */
    float facing[GLINT_MAX_CORNERS];   /* six volumes between the point and the triangle of edges i - 1 and i */
    vfloat3 middle;                    /* the mean of all corners, unit */
    float reach, height;               /* how far corners are from the middle, in all and up or down */
} fan;

static vfloat3 minus(vfloat3 a, vfloat3 b)
{
    return (vfloat3){ a.x - b.x, a.y - b.y, a.z - b.z };
}

/* The mean of the corners, 0 where they are no numbers to speak of or far wider than they are away. */
static int find_middle(const glint_area_light *l, vfloat3 *mean, float *distance2)
{
    uint32_t most = 0;
    vfloat3 sum = { 0.0F, 0.0F, 0.0F };
    if (l->corner_count < 3U || l->corner_count > GLINT_MAX_CORNERS)
        return 0;
    for (uint32_t i = 0; i < l->corner_count; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t bits = bits_of_float(l->corners[i][k]) & 0x7fffffffU;
            most = bits > most ? bits : most;
        }
    if (most >= bits_of_float(1e15F))
        return 0;
    for (uint32_t i = 0; i < l->corner_count; i++)
        sum = add_3(sum, from(l->corners[i]));
    *mean = scale_3(sum, 1.0F / (float)l->corner_count);
    *distance2 = dot_3(*mean, *mean);
    float widest;
    memcpy(&widest, &most, sizeof(widest));
    return *distance2 > 1e-30F && widest * widest < 9.0F * *distance2;
}

static int find_fan(const glint_area_light *l, fan *f)
{
    vfloat3 mean;
    float distance2, reach2 = 0.0F;
    if (!find_middle(l, &mean, &distance2))
        return 0;
    const float inverse = 1.0F / sqrtf(distance2);
    f->count = (int)l->corner_count;
    f->middle = scale_3(mean, inverse);
    f->height = 0.0F;
    for (int i = 0; i < f->count; i++) {
        f->corner[i] = scale_3(from(l->corners[i]), inverse);
        const vfloat3 off = minus(f->corner[i], f->middle);
        reach2 = max_f(reach2, dot_3(off, off));
        f->height = max_f(f->height, fabsf(off.z));
        f->edge[i] = minus(f->corner[i], f->corner[0]);
        f->facing[i] = i > 1 ? dot_3(cross_3(f->edge[i - 1], f->edge[i]), f->corner[0]) : 0.0F;
    }
    f->reach = sqrtf(reach2);
    return f->reach > 1e-8F;
}

/* As plain_light_of. Triangles between all corners and the middle are half as wide as those between one corner and the
 * others; which they are is said in *from_middle. */
static int rule_of_fan(const area_lobe *l, const fan *f, int two_sided, int *from_middle, float *left)
{
    float facing = 0.0F;
    for (int i = 2; i < f->count; i++)
        facing += f->facing[i];
    const float area = f->reach * f->reach;
    if (!(facing * facing > 4e-4F * area * area))
        return PLAIN_LEFT;
    if ((!two_sided && facing > 0.0F) || f->middle.z + f->height < -1e-4F)
        return PLAIN_DARK;
    if (!(f->middle.z > f->height))
        return PLAIN_LEFT;
    /* The longest sides are twice as long as it reaches, but no triangle is as wide as a square. */
    float bend = plain_bend(l, f->middle, 0.75F * f->reach, f->reach, f->height);
    *from_middle = !(bend < PLAIN_COARSE);
    if (*from_middle)
        bend = plain_bend(l, f->middle, 0.5F * f->reach, f->reach, f->height);
    /* More points than that cost more than the other method. */
    *left = *from_middle ? plain_share_left(bend, PLAIN_FADES / PLAIN_FINE * PLAIN_MIDDLE, PLAIN_MIDDLE) : 0.0F;
    return bend < PLAIN_MIDDLE ? CUBATURE_TRIANGLE * CUBATURE_LEVELS + plain_level(bend) : PLAIN_LEFT;
}

static void take_triangles(const fan *f, area_nodes *n)
{
    for (int i = 2; i < f->count; i++)
        n->patch[n->count++] = (area_patch){ vec3_of(f->corner[0]), vec3_of(f->edge[i - 1]), vec3_of(f->edge[i]),
                                             0.5F * fabsf(f->facing[i]) };
}

static void take_triangles_from_middle(const fan *f, area_nodes *n)
{
    vfloat3 u = minus(f->corner[f->count - 1], f->middle);
    for (int i = 0; i < f->count; i++) {
        const vfloat3 v = minus(f->corner[i], f->middle);
        n->patch[n->count++] =
            (area_patch){ vec3_of(f->middle), vec3_of(u), vec3_of(v), 0.5F * fabsf(dot_3(cross_3(u, v), f->middle)) };
        u = v;
    }
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
    int rule, from_middle = 0;
    float left = 0.0F;
    begin_nodes(q, &l, &nodes);
    if (q->area_light->kind == GLINT_AREA_POLYGON) {
        fan f;
        const int two_sided = q->area_light->two_sided != 0U;
        rule = find_fan(q->area_light, &f) ? rule_of_fan(&l, &f, two_sided, &from_middle, &left) : PLAIN_LEFT;
        if (rule >= 0)
            (from_middle ? take_triangles_from_middle : take_triangles)(&f, &nodes);
    } else {
        const plain_light p = plain_light_of(&l, &plain);
        rule = p.rule;
        left = p.left;
        nodes.patch[nodes.count++] = patch_of(&p);
    }
    if (rule == PLAIN_LEFT)
        return 1.0F;
    const plain_sums sums = rule == PLAIN_DARK ? plain_no_sums() : sums_of(&nodes, rule);
    shade(q, &plain, &sums, value);
    return left;
}
