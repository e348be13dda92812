/* One facet of the explicit surface under a light of real size. */
#include "model/explicit_area.h"

#include "light/sweep.h"
#include "model/facet_lobe.h"
#include "model/lobe.h"

/* The part of a facet's reflection that meets the light, in [0, 1]. */
static float lit_part(const model_query *q, const area_light *light, vec3 h, vec3d mirrored)
{
    const float alpha = q->material->options.facet_alpha;
    if (!(alpha >= LEAST_FACET_ALPHA))
        return area_contains(light, mirrored) ? 1.0F : 0.0F;
    /* The lobe is one of half vectors, round in slopes around the facet's own normal. */
    const double width = 1.0 / (double)alpha;
    const vec3d normal = vec3d_normalize(vec3d_of(h)), x = vec3d_any_normal(normal), y = vec3d_cross(normal, x);
    const sweep_map map = { { vec3d_scale(x, width), vec3d_scale(y, width), normal },
                            vec3d_of(q->wo),
                            lobe_ndf(q).kind == NDF_BECKMANN };
    return (float)sweep_mass(light, &map, mirrored);
}

void explicit_area_facet(const model_query *q, const area_light *light, vec3 h, float rgb[3])
{
    const float cosine = vec3_dot(q->wo, h);
    rgb[0] = rgb[1] = rgb[2] = 0.0F;
    if (!(cosine > 0.0F))
        return;
    const vec3 wi = vec3_add(vec3_scale(h, 2.0F * cosine), vec3_scale(q->wo, -1.0F));
    if (!(wi.z > 0.0F))
        return;
    const float lit = lit_part(q, light, h, vec3d_of(wi));
    if (!(lit > 0.0F))
        return;
    const ndf n = lobe_ndf(q);
    const float masking = ndf_masking_over_cosine(&n, q->wo, wi);
    for (int c = 0; c < 3; c++)
        rgb[c] = lit * masking * cosine * lobe_facet_reflectance(q, c, fminf(cosine, 1.0F));
}
