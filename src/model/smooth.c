/* The smooth model: infinitely many facets, a Cook-Torrance lobe (Cook and Torrance 1982; Walter et al. 2007). */
#include "math/effects.h"
#include "model/area.h"
#include "model/area_kernel.h"
#include "model/lobe.h"
#include "model/lobe_kernel.h"

static void smooth_eval(const model_query *q, glint_value *value)
{
    *value = (glint_value){ 0 };
    if (LIBRARY_AREA_LIGHTS && q->area_light) {
        area_value area;
        area_eval(q, &area);
        for (int c = 0; c < 3; c++)
            value->rgb[c] = value->smooth[c] = area.specular[c] + area.diffuse[c];
        return;
    }
    lobe_value lobe;
    lobe_eval(q, &lobe);
    for (int c = 0; c < 3; c++)
        value->rgb[c] = value->smooth[c] = lobe.specular[c] + lobe.diffuse[c];
}

static void smooth_eval_many(const model_query *q, size_t count, glint_value *value)
{
    lobe_lit lit;
    for (size_t first = 0; first < count; first += LOBE_MOST) {
        const size_t number = count - first < LOBE_MOST ? count - first : LOBE_MOST;
        (LIBRARY_AREA_LIGHTS && q->area_light ? area_eval_many : lobe_eval_many)(q + first, number, 0, &lit);
        for (size_t i = 0; i < number; i++) {
            glint_value *v = &value[first + i];
            *v = (glint_value){ 0 };
            for (int c = 0; c < 3; c++)
                v->rgb[c] = v->smooth[c] = lit.specular[c][i] + lit.diffuse[c][i];
        }
    }
}

const struct model smooth_model = {
    .name = "smooth",
    .features = GLINT_FEATURE_GGX | GLINT_FEATURE_BECKMANN | GLINT_FEATURE_ANISOTROPIC | GLINT_FEATURE_SAMPLE |
                GLINT_FEATURE_VARYING_SURFACE | GLINT_FEATURE_EQUAL_AREA | GLINT_FEATURE_EQUAL_PROJECTED_AREA |
                GLINT_FEATURE_COLOR,
    .eval = smooth_eval,
    .eval_many = smooth_eval_many,
    .sample = lobe_sample,
    .pdf = lobe_pdf,
};
