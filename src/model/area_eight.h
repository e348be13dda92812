/* One lobe in all of eight lanes, and the sums of area_plain.h over them. */
#ifndef MODEL_AREA_EIGHT_H
#define MODEL_AREA_EIGHT_H

#include "model/area_fold.h"
#include "model/area_nodes.h"
#include "model/area_plain.h"

static inline vfloat3 splat_3(vec3 v)
{
    return (vfloat3){ splat(v.x), splat(v.y), splat(v.z) };
}

static inline vfloat3 splat_at(const float from[3][AREA_ROOM], int i)
{
    return (vfloat3){ splat(from[0][i]), splat(from[1][i]), splat(from[2][i]) };
}

static inline area_lobe area_lobe_seen(const area_eye *eye)
{
    return area_lobe_of(eye->is_ggx, eye->is_schlick, splat_3(eye->wo), splat(eye->visible_o), splat(eye->alpha_x),
                        splat(eye->alpha_y));
}

static inline void area_fold_sums(const plain_sums *sum, int has_base, area_node_sums *sums)
{
    const area_terms *const of = &sum->of;
    const vfloat s =
        fold_eight(of->reflected, of->fresnel[0], of->fresnel[1], of->facets, of->x, of->y, of->z, of->cap);
    *sums = (area_node_sums){ s[0], { s[1], s[2] }, s[3], s[4], s[5], s[6], s[7], { 0.0F, 0.0F, 0.0F } };
    for (int i = 0; has_base && i < 3; i++)
        sums->cosine[i] = fold_one(sum->cosine[i]);
}

#endif
