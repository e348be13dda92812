/* Evaluation of many points: checks of directions several at a time, then the model's own batch, chunk by chunk. */
#include <string.h>

#include "glint_query.h"

enum { CHUNK = 64 };

static int has_all(const glint_batch *b)
{
    const void *const arrays[] = { b->u, b->v, b->dudx, b->dudy, b->dvdx, b->dvdy, b->wo[0], b->wo[1], b->wo[2] };
    for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); i++)
        if (!arrays[i])
            return 0;
    if (!b->values && !(b->rgb[0] && b->rgb[1] && b->rgb[2]))
        return 0;
    return (LIBRARY_AREA_LIGHTS && b->area_lights) || (b->wi[0] && b->wi[1] && b->wi[2] && b->solid_angle_sr);
}

/* The float as it came where mask is -1, 0 where it is 0. */
static float masked(float x, int32_t mask)
{
    uint32_t u = bits_of_float(x) & (uint32_t)mask;
    memcpy(&x, &u, sizeof(x));
    return x;
}

/* Clears ok[j] where entry j is no direction, or below the horizon of a material with one. Without a branch, so that
 * the compiler takes several at a time; nothing is multiplied that might be no number. */
static void check_directions(const float *const w[3], size_t first, size_t count, int has_horizon, int32_t *ok)
{
    const float *const x = w[0] + first, *const y = w[1] + first, *const z = w[2] + first;
    const int32_t below = has_horizon ? 0 : INT32_MIN;
    for (size_t j = 0; j < count; j++) {
        const int32_t small =
            -(is_below(x[j], MOST_COMPONENT) & is_below(y[j], MOST_COMPONENT) & is_below(z[j], MOST_COMPONENT));
        const vec3 v = { masked(x[j], small), masked(y[j], small), masked(z[j], small) };
        ok[j] &= small & -is_below(vec3_dot(v, v) - 1.0F, MOST_OFF) & -((int32_t)bits_of_float(z[j]) > below);
    }
}

/* Fills all of *q for entry i, whose directions have been checked. False: there is nothing to see. */
static int fill(model_query *q, checked *c, glint_footprint *f, const glint_material *material, const glint_batch *b,
                size_t i)
{
    *f = (glint_footprint){ b->u[i],
                            b->v[i],
                            b->dudx[i],
                            b->dudy[i],
                            b->dvdx[i],
                            b->dvdy[i],
                            b->seed ? b->seed[i] : 0U,
                            b->draw ? b->draw[i] : 0U };
    if (!query_fill(q, c, material, LIBRARY_SURFACES && b->surfaces ? &b->surfaces[i] : NULL, f))
        return 0;
    q->wo = (vec3){ b->wo[0][i], b->wo[1][i], b->wo[2][i] };
    if (LIBRARY_AREA_LIGHTS && b->area_lights) {
        q->area_light = &b->area_lights[i];
        return 1;
    }
    q->wi = (vec3){ b->wi[0][i], b->wi[1][i], b->wi[2][i] };
    q->solid_angle_sr = query_solid_angle(b->solid_angle_sr[i]);
    return 1;
}

static void clear(const glint_batch *b, size_t first, size_t count)
{
    if (b->values)
        memset(b->values + first, 0, count * sizeof(*b->values));
    for (int k = 0; k < 3; k++)
        if (b->rgb[k])
            memset(b->rgb[k] + first, 0, count * sizeof(float));
}

static void put(const glint_batch *b, size_t i, const glint_value *value)
{
    if (b->values) {
        b->values[i] = *value;
        value_make_finite(&b->values[i]);
    }
    for (int k = 0; k < 3; k++)
        if (b->rgb[k])
            b->rgb[k][i] = value_finite(value->rgb[k]);
}

static void eval_chunk(const glint_material *material, const glint_batch *b, size_t first, size_t count)
{
    checked c[CHUNK];
    glint_footprint footprint[CHUNK];
    model_query query[CHUNK];
    glint_value value[CHUNK];
    size_t index[CHUNK], lit = 0;
    int32_t ok[CHUNK];
    memset(ok, 0xff, sizeof(ok));
    check_directions(b->wo, first, count, query_has_horizon(material), ok);
    if (!LIBRARY_AREA_LIGHTS || !b->area_lights)
        check_directions(b->wi, first, count, query_has_horizon(material), ok);
    for (size_t j = 0; j < count; j++)
        if (ok[j] && fill(&query[lit], &c[lit], &footprint[lit], material, b, first + j))
            index[lit++] = first + j;
    clear(b, first, count);
    if (lit == 0)
        return;
    material->model->eval_many(query, lit, value);
    for (size_t j = 0; j < lit; j++)
        put(b, index[j], &value[j]);
}

glint_result glint_eval_batch(const glint_material *material, const glint_batch *batch)
{
    if (!material || !batch || batch->size != sizeof(*batch) || (batch->count > 0 && !has_all(batch)))
        return GLINT_ERROR_ARGUMENT;
    for (size_t first = 0; first < batch->count; first += CHUNK)
        eval_chunk(material, batch, first, batch->count - first < CHUNK ? batch->count - first : CHUNK);
    return GLINT_OK;
}
