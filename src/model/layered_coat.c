/* What a coat lets through: t = 1 - R, R at least what the coat reflects of light from one direction.
 *
 * The mean of F(h.wo) over visible facets is more than F(n.wo), because F rises so steeply towards grazing angles; a
 * white base that got 1 - F(n.wo) would give back up to three thousandths more light than came in under a coat of index
 * 1.5. So R takes F at a lower cosine.
 */
#include "model/layered_coat.h"

#include "model/lobe.h"

static float clamp01(float x)
{
    return x < 0.0F ? 0.0F : x > 1.0F ? 1.0F : x;
}

/* Facets bring a direction with cosine c closer to their horizon: the coat reflects no more than one facet does at
 * slant * c. A fit from above to the albedo of GGX and Beckmann under Smith's masking and V-cavities, for alpha from
 * 1e-4 to 1, whose own slants are .844 and more. */
static float slant_of_alpha(const glint_surface *s)
{
    const float alpha = s->alpha_x > s->alpha_y ? s->alpha_x : s->alpha_y;
    return 1.0F - (alpha < 0.2F ? 0.8F * alpha : 0.16F);
}

/* No facet that sends light up from a direction with cosine c sees it at less than c / 2: wi.z = 2 (h.wo) h.z - wo.z is
 * above 0. This holds for every distribution, the most that a stretched one is taken for. */
#define LEAST_SLANT 0.5F

float coat_slant(const struct glint_material *coat, float measured, const glint_surface *s)
{
    if (!(measured > 0.0F))
        return slant_of_alpha(s);
    const glint_surface *own = &coat->options.surface;
    const float x = s->alpha_x / own->alpha_x, y = s->alpha_y / own->alpha_y, most = x > y ? x : y;
    const float slant = 1.0F - (1.0F - measured) * (most > 1.0F ? most : 1.0F);
    return slant > LEAST_SLANT ? slant : LEAST_SLANT;
}

/* R: at least what the facets of the coat reflect of light from this cosine. Reflectance has its largest value on an
 * interval of angles at one of its ends, for metals too. */
static float facets_bound(const model_query *coat, int channel, float slant, float cosine)
{
    const float slanted = lobe_facet_reflectance(coat, channel, slant * cosine);
    const float head_on = lobe_facet_reflectance(coat, channel, 1.0F);
    return coat->material->options.coverage * (slanted > head_on ? slanted : head_on);
}

static float transmit_channel(const model_query *coat, int c, float slant, float cosine)
{
    const float diffuse = coat->surface->diffuse[c], past = 1.0F - facets_bound(coat, c, slant, cosine);
    if (!(diffuse > 0.0F))
        return clamp01(past);
    const float entered = 1.0F - coat->material->options.coverage * lobe_facet_reflectance(coat, c, cosine);
    return clamp01(past - diffuse * entered);
}

/* Whether all channels are the same, as those of a lacquer are. */
static int is_gray(const model_query *coat)
{
    const glint_surface *s = coat->surface;
    int same = coat->material->options.fresnel != GLINT_FRESNEL_CONDUCTOR;
    for (int c = 1; c < 3; c++)
        same = same && s->f0[c] == s->f0[0] && s->f90[c] == s->f90[0] && s->diffuse[c] == s->diffuse[0];
    return same;
}

/* t: what neither the facets nor what is diffuse in the coat keep from the base. */
void coat_transmit(const model_query *coat, float slant, float cosine, float t[3])
{
    const float clamped = clamp01(cosine);
    const int gray = is_gray(coat);
    for (int c = 0; c < 3; c++)
        t[c] = c > 0 && gray ? t[0] : transmit_channel(coat, c, slant, clamped);
}

/* What the facets of a material reflect to wo in one channel: the mean weight of its own samples. */
static float sampled_albedo(const model_query *q, int channel)
{
    enum { SIDE = 16 };
    float sum = 0.0F;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int row = i / SIDE, column = i % SIDE;
        const float random[3] = { 0.0F, ((float)row + 0.5F) / SIDE, ((float)column + 0.5F) / SIDE };
        glint_sample s;
        if (q->material->model->sample(q, random, &s))
            sum += s.weight[channel];
    }
    return sum / (SIDE * SIDE);
}

/* The slant of a material whose normals come from a map and not from alpha, measured: the largest that keeps R above
 * what it reflects, less what 256 samples in 80 directions may have missed (a fiftieth, taste). */
float coat_measured_slant(const struct glint_material *coat)
{
    enum { AROUND = 8, DOWN = 10 };
    const float step = 0.02F;
    if (coat->options.model != GLINT_MODEL_EXAMPLE)
        return 0.0F;
    glint_surface s = coat->options.surface;
    for (int c = 0; c < 3; c++) {
        s.diffuse[c] = s.f0[c] = 0.0F;
        s.f90[c] = 1.0F;
    }
    model_query q = { .material = coat, .surface = &s, .total_area = coat->total_area };
    float slant = 1.0F;
    for (int i = 0; i < AROUND * DOWN; i++) {
        const int row = i / AROUND, column = i % AROUND;
        const float cosine = ((float)row + 0.5F) / DOWN;
        const vec3 around = lobe_cosine_direction(((float)column + 0.5F) / AROUND, 1.0F);
        const float sine = sqrtf(1.0F - cosine * cosine);
        q.wo = (vec3){ around.x * sine, around.y * sine, cosine };
        for (int c = 0; c < 3; c++) {
            const float albedo = sampled_albedo(&q, c);
            while (slant > LEAST_SLANT && albedo > facets_bound(&q, c, slant, cosine))
                slant -= step;
        }
    }
    return slant - step > LEAST_SLANT ? slant - step : LEAST_SLANT;
}
