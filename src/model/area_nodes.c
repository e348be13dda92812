/* The sums of area_plain.h over the points of one light, eight of them at a time. */
#include "model/area_nodes.h"

#define GLINT_LANES 8
#include "model/area_fold.h"
#include "model/area_polygon.h"

static inline vfloat3 splat3(vec3 v)
{
    return (vfloat3){ splat(v.x), splat(v.y), splat(v.z) };
}

static inline vfloat3 splat_at(const float from[3][AREA_ROOM], int i)
{
    return (vfloat3){ splat(from[0][i]), splat(from[1][i]), splat(from[2][i]) };
}

static inline plain_quad part_of(const area_parts *p, int i, int is_bent)
{
    plain_quad q = {
        .middle = splat_at(p->middle, i), .u = splat_at(p->u, i), .v = splat_at(p->v, i), .size = splat(p->size[i])
    };
    if (is_bent) {
        q.w = splat_at(p->w, i);
        q.size_x = splat(p->size_x[i]);
        q.size_y = splat(p->size_y[i]);
    }
    return q;
}

static inline __attribute__((always_inline)) void sum_parts(const area_nodes *n, const cubature *rule, int is_bent,
                                                            plain_sums *sum)
{
    const area_lobe lobe = area_lobe_of(n->is_ggx, n->is_schlick, splat3(n->wo), splat(n->visible_o), splat(n->alpha_x),
                                        splat(n->alpha_y));
    plain_sums terms;
    int is_first = 1;
    for (int k = 0; k < n->count; k++) {
        const plain_quad part = part_of(&n->parts, 2 * k, is_bent);
        const plain_light light = { .middle = part.middle, .u = part.u, .v = part.v, .size = part.size };
        for (int i = 0; i < rule->row_count; i++) {
            const float(*const row)[CUBATURE_ROW] = rule->row[i];
            const vfloat x = load_f(row[0]), y = load_f(row[1]), weight = load_f(row[2]);
            if (is_bent)
                plain_quad_terms_at(&lobe, &part, x, y, weight, n->has_base, is_first ? sum : &terms);
            else
                plain_terms_at(&lobe, &light, x, y, weight, n->has_base, is_first ? sum : &terms);
            if (!is_first)
                plain_add(sum, &terms, n->has_base);
            is_first = 0;
        }
    }
}

#if defined(__AVX2__) && defined(GLINT_AREA_QUAD_AVX2)
#define AREA_NODES_SUM area_nodes_sum_avx2
#else
#define AREA_NODES_SUM area_nodes_sum_base
#endif

void AREA_NODES_SUM(const area_nodes *n, const cubature *rule, area_node_sums *sums)
{
    plain_sums sum = plain_no_sums();
    if (n->is_bent)
        sum_parts(n, rule, 1, &sum);
    else
        sum_parts(n, rule, 0, &sum);
    const area_terms *const of = &sum.of;
    const vfloat s =
        fold_eight(of->reflected, of->fresnel[0], of->fresnel[1], of->facets, of->x, of->y, of->z, of->cap);
    *sums = (area_node_sums){ s[0], { s[1], s[2] }, s[3], s[4], s[5], s[6], s[7], { 0.0F, 0.0F, 0.0F } };
    for (int i = 0; n->has_base && i < 3; i++)
        sums->cosine[i] = fold_one(sum.cosine[i]);
}
