/* Lights of real size at GLINT_LANES points at a time. */
#include "model/area_kernel.h"

#include "model/area_polygon.h"

static vfloat3 load_3(const float v[3][LOBE_MOST], size_t i)
{
    return (vfloat3){ load_f(v[0] + i), load_f(v[1] + i), load_f(v[2] + i) };
}

static plain_query query_of(const area_crowd *c, size_t i)
{
    plain_query q = {
        .lobe = { .wo = load_3(c->wo, i), .alpha_x = load_f(c->alpha_x + i), .alpha_y = load_f(c->alpha_y + i) },
        .total_area = load_f(c->total_area + i),
        .hidden = load_f(c->hidden + i),
        .kind = load_i(c->kind + i),
        .two_sided = load_i(c->two_sided + i),
        .center = load_3(c->center, i),
        .half_x = load_3(c->half_x, i),
        .half_y = load_3(c->half_y, i),
        .size = load_f(c->size + i)
    };
    for (int k = 0; k < 3; k++) {
        q.lobe.diffuse[k] = load_f(c->diffuse[k] + i);
        q.lobe.f0[k] = load_f(c->f0[k] + i);
        q.lobe.f90[k] = load_f(c->f90[k] + i);
    }
    return q;
}

/* A light, and the squares of a polygon. */
typedef struct light_parts {
    plain_light light;
    int quad_count;
    plain_quad quad[PLAIN_QUADS];
} light_parts;

static plain_corners corners_of(const area_crowd *c, size_t i)
{
    plain_corners corners = { .most = c->most_corners, .count = load_i(c->corner_count + i) };
    for (int k = 0; k < c->most_corners; k++)
        corners.at[k] = load_3(c->corner[k], i);
    return corners;
}

static light_parts parts_of(const area_lobe *l, const plain_query *q, const plain_limits *most, const area_crowd *crowd,
                            size_t i)
{
    plain_light light = plain_light_of(l, q, most);
    light_parts p;
    p.quad_count = 0;
    const vmask is_polygon = equal_i(q->kind, splat_i(GLINT_AREA_POLYGON));
    if (crowd->most_corners > 0 && any(is_polygon)) {
        plain_corners corners = corners_of(crowd, i);
        vmask from_middle;
        const plain_shape shape = plain_shape_of(&corners);
        const plain_light polygon = plain_polygon_rule(
            &shape, corners.count, q->two_sided, plain_bend(l, shape.middle, plain_wide(&shape), &shape.extent),
            plain_bend(l, shape.middle, plain_slim(&shape), &shape.extent), &from_middle);
        light.rule = choose_i(is_polygon, polygon.rule, light.rule);
        light.left = choose(is_polygon, polygon.left, light.left);
        p.quad_count =
            plain_quads_of(&corners, &shape, less_i(splat_i(PLAIN_POLYGON - 1), light.rule), from_middle, p.quad);
    }
    p.light = plain_light_for_sums(&light);
    return p;
}

static __attribute__((noinline)) void add_column(const area_lobe *l, const light_parts *p, const cubature *rule,
                                                 int column, int has_base, plain_sums *sum)
{
    plain_sums terms;
    for (int i = 0; i < rule->row_count; i++) {
        const float(*const row)[CUBATURE_ROW] = rule->row[i];
        plain_terms_at(l, &p->light, splat(row[0][column]), splat(row[1][column]), splat(row[2][column]), has_base,
                       i == 0 ? sum : &terms);
        if (i > 0)
            plain_add(sum, &terms, has_base);
    }
}

static __attribute__((noinline)) void add_column_of_quads(const area_lobe *l, const light_parts *p,
                                                          const cubature *rule, int column, int has_base,
                                                          plain_sums *sum)
{
    plain_sums terms;
    for (int k = 0; k < p->quad_count; k++)
        for (int i = 0; i < rule->row_count; i++) {
            const float(*const row)[CUBATURE_ROW] = rule->row[i];
            const int is_first = k == 0 && i == 0;
            plain_quad_terms_at(l, &p->quad[k], splat(row[0][column]), splat(row[1][column]), splat(row[2][column]),
                                has_base, is_first ? sum : &terms);
            if (!is_first)
                plain_add(sum, &terms, has_base);
        }
}

/* In the order of area_fold.h: pairs, pairs of pairs, and both halves. */
static void sum_points(const area_lobe *l, const light_parts *p, int rule, int has_base, plain_sums *sum)
{
    static const int order[CUBATURE_ROW] = { 0, 4, 2, 6, 1, 5, 3, 7 };
    plain_sums part[4];
    int count = 0;
    for (int i = 0; i < CUBATURE_ROW; i++) {
        (rule < PLAIN_POLYGON ? add_column : add_column_of_quads)(l, p, plain_rule(rule), order[i], has_base,
                                                                  &part[count++]);
        for (int pairs = i; pairs & 1; pairs >>= 1) {
            count--;
            plain_add(&part[count - 1], &part[count], has_base);
        }
    }
    *sum = part[0];
}

/* Each lane by the rule that it asks for. */
static void sum_lights(const area_lobe *l, const light_parts *p, int has_base, plain_sums *sum)
{
    *sum = plain_no_sums();
    for (int rule = 0; rule < PLAIN_RULES; rule++) {
        const vmask asked = equal_i(p->light.rule, splat_i(rule));
        plain_sums some;
        if (!any(asked))
            continue;
        sum_points(l, p, rule, has_base, &some);
        sum->of = area_choose_terms(asked, &some.of, &sum->of);
        for (int i = 0; has_base && i < 3; i++)
            sum->cosine[i] = choose(asked, some.cosine[i], sum->cosine[i]);
    }
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(area_kernel_, GLINT_LANES)(const glint_material_options *o, const area_crowd *crowd, size_t count, int counts,
                                     lobe_lit *lit, float left[LOBE_MOST])
{
    const ndf_kind kind = lobe_kind(o);
    const plain_limits most = plain_limits_of(o);
    for (size_t i = 0; i < count; i += GLINT_LANES) {
        const plain_query q = query_of(crowd, i);
        const lobe_query *const s = &q.lobe;
        const area_lobe lobe =
            area_lobe_of(kind == NDF_GGX, o->fresnel == GLINT_FRESNEL_SCHLICK, s->wo,
                         s->wo.z + ndf_masked_of(kind, s->alpha_x, s->alpha_y, s->wo), s->alpha_x, s->alpha_y);
        const light_parts parts = parts_of(&lobe, &q, &most, crowd, i);
        const vfloat zero = splat(0.0F);
        const int has_base = any(less(zero, s->diffuse[0]) | less(zero, s->diffuse[1]) | less(zero, s->diffuse[2]));
        plain_sums sums;
        plain_value value;
        sum_lights(&lobe, &parts, has_base, &sums);
        plain_shade(o, &q, &sums, has_base, &value);
        for (int c = 0; c < 3; c++) {
            store_f(lit->specular[c] + i, value.specular[c]);
            store_f(lit->diffuse[c] + i, value.diffuse[c]);
        }
        store_f(left + i, parts.light.left);
        if (!counts)
            continue;
        const area_lit facets = plain_lit(o, &q, &sums);
        store_f(lit->h[0] + i, facets.h.x);
        store_f(lit->h[1] + i, facets.h.y);
        store_f(lit->cap + i, facets.cap);
        store_f(lit->p + i, facets.p);
    }
}
