/* The sums of area_plain.h over the points of one light, eight of them at a time. */
#include "model/area_nodes.h"

#define GLINT_LANES 8
#include "model/area_eight.h"
#include "model/area_polygon.h"

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
    const area_lobe lobe = area_lobe_seen(&n->eye);
    plain_sums terms;
    int is_first = 1;
    for (int k = 0; k < n->count; k++) {
        const plain_quad part = part_of(&n->parts, 2 * k, is_bent);
        const plain_light light = { .middle = part.middle, .u = part.u, .v = part.v, .size = part.size };
        for (int i = 0; i < rule->row_count; i++) {
            const float(*const row)[CUBATURE_ROW] = rule->row[i];
            const vfloat x = load_f(row[0]), y = load_f(row[1]), weight = load_f(row[2]);
            if (is_bent)
                plain_quad_terms_at(&lobe, &part, x, y, weight, n->eye.has_base, is_first ? sum : &terms);
            else
                plain_terms_at(&lobe, &light, x, y, weight, n->eye.has_base, is_first ? sum : &terms);
            if (!is_first)
                plain_add(sum, &terms, n->eye.has_base);
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
    area_fold_sums(&sum, n->eye.has_base, sums);
}
