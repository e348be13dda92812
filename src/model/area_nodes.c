/* The sums of area_plain.h over the points of one light, eight of them at a time. */
#include "model/area_nodes.h"

#define GLINT_LANES 8
#include "model/area_fold.h"
#include "model/area_plain.h"

static vfloat3 splat3(vec3 v)
{
    return (vfloat3){ splat(v.x), splat(v.y), splat(v.z) };
}

#if defined(__AVX2__) && defined(GLINT_AREA_QUAD_AVX2)
#define AREA_NODES_SUM area_nodes_sum_avx2
#else
#define AREA_NODES_SUM area_nodes_sum_base
#endif

void AREA_NODES_SUM(const area_nodes *n, const cubature *rule, area_node_sums *sums)
{
    const area_lobe lobe = area_lobe_of(n->is_ggx, n->is_schlick, splat3(n->wo), splat(n->visible_o), splat(n->alpha_x),
                                        splat(n->alpha_y));
    plain_sums sum = plain_no_sums(), terms;
    int is_first = 1;
    for (int k = 0; k < n->count; k++) {
        const area_patch *const p = &n->patch[k];
        const plain_light light = {
            .middle = splat3(p->middle), .u = splat3(p->u), .v = splat3(p->v), .size = splat(p->size)
        };
        for (int i = 0; i < rule->row_count; i++) {
            const float(*const row)[CUBATURE_ROW] = rule->row[i];
            plain_terms_at(&lobe, &light, load_f(row[0]), load_f(row[1]), load_f(row[2]), n->has_base,
                           is_first ? &sum : &terms);
            if (!is_first)
                plain_add(&sum, &terms, n->has_base);
            is_first = 0;
        }
    }
    const area_terms *const of = &sum.of;
    const vfloat s =
        fold_eight(of->reflected, of->fresnel[0], of->fresnel[1], of->facets, of->x, of->y, of->z, of->cap);
    *sums = (area_node_sums){ s[0], { s[1], s[2] }, s[3], s[4], s[5], s[6], s[7], { 0.0F, 0.0F, 0.0F } };
    for (int i = 0; n->has_base && i < 3; i++)
        sums->cosine[i] = fold_one(sum.cosine[i]);
}
