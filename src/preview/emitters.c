/* Lists the triangles that glow, with their power as the probability to look at them. */
#include "preview/emitters.h"

#include <stdlib.h>

#define MOST_TRIANGLES (1 << 26)

static const scene_material *material_of(const geometry *g, int instance)
{
    return &g->scene->materials[g->scene->meshes[g->scene->instances[instance].mesh].material];
}

/* What is masked, blended, unlit or coated stays with the rays that bounce into it. */
static bool is_emitter(const geometry *g, int instance)
{
    const scene_material *const m = material_of(g, instance);
    return g->instances[instance].visible && m->emissive[0] + m->emissive[1] + m->emissive[2] > 0.0F && !m->unlit &&
           m->alpha_mode == SCENE_ALPHA_OPAQUE && !(m->clearcoat > 0.0F);
}

static uint32_t triangles_of(const geometry *g, int instance)
{
    return g->scene->meshes[g->scene->instances[instance].mesh].triangle_count;
}

static void world_corners(const geometry *g, int instance, uint32_t triangle, vec3 corner[3])
{
    const triangle_corners c = geometry_triangle(g, instance, triangle);
    for (int k = 0; k < 3; ++k)
        corner[k] = m4_point(g->instances[instance].to_world, c.position[k]);
}

/* The power of a triangle but for its texture, and its area. */
static double add_triangle(const geometry *g, int instance, uint32_t triangle, emitter *to)
{
    const scene_material *const m = material_of(g, instance);
    vec3 c[3];
    world_corners(g, instance, triangle, c);
    const double area = 0.5 * v3_length(v3_cross(v3_sub(c[1], c[0]), v3_sub(c[2], c[0])));
    *to = (emitter){ instance, triangle, isfinite(area) ? area : 0.0 };
    return to->area_m2 * ((double)m->emissive[0] + (double)m->emissive[1] + (double)m->emissive[2]);
}

static size_t count_triangles(const geometry *g)
{
    size_t count = 0;
    for (int i = 0; i < g->scene->instance_count; ++i)
        count += is_emitter(g, i) ? triangles_of(g, i) : 0;
    return count;
}

static void list_triangles(emitters *e)
{
    double sum = 0.0;
    e->edges[0] = 0.0;
    for (int i = 0; i < e->geometry->scene->instance_count; ++i) {
        e->first[i] = is_emitter(e->geometry, i) ? e->count : -1;
        for (uint32_t t = 0; e->first[i] >= 0 && t < triangles_of(e->geometry, i); ++t) {
            sum += add_triangle(e->geometry, i, t, &e->triangles[e->count]);
            e->edges[++e->count] = sum;
        }
    }
    for (int k = 1; k <= e->count && sum > 0.0; ++k)
        e->edges[k] /= sum;
    if (!(sum > 0.0) || !isfinite(sum)) /* none of them has an area */
        e->count = 0;
}

bool emitters_make(const geometry *g, emitters *out, report *r)
{
    const size_t count = count_triangles(g);
    *out = (emitters){ .geometry = g };
    if (count == 0 || count > MOST_TRIANGLES) /* so many, and a ray finds them anyway */
        return true;
    out->triangles = malloc(count * sizeof *out->triangles);
    out->edges = calloc(count + 1, sizeof *out->edges);
    out->first = malloc((size_t)g->scene->instance_count * sizeof *out->first);
    if (out->triangles == NULL || out->edges == NULL || out->first == NULL)
        return report_error(r, "no memory for %zu triangles that glow", count);
    list_triangles(out);
    return true;
}

void emitters_free(emitters *e)
{
    free(e->triangles);
    free(e->edges);
    free(e->first);
    *e = (emitters){ 0 };
}

static void describe(const emitters *e, int k, emitter_point *out)
{
    const emitter *const from = &e->triangles[k];
    const triangle_corners c = geometry_triangle(e->geometry, from->instance, from->triangle);
    const vec3 flat = v3_cross(v3_sub(c.position[1], c.position[0]), v3_sub(c.position[2], c.position[0]));
    out->normal = v3_normalize(m4_transposed_vector(e->geometry->instances[from->instance].to_object, flat));
    out->two_sided = material_of(e->geometry, from->instance)->double_sided;
    out->area_m2 = from->area_m2;
    out->pdf_per_area = from->area_m2 > 0.0 ? (e->edges[k + 1] - e->edges[k]) / from->area_m2 : 0.0;
}

void emitters_sample(const emitters *e, const double u[2], emitter_point *out)
{
    int low = 0, high = e->count;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (e->edges[middle] <= u[0])
            low = middle;
        else
            high = middle;
    }
    const double span = e->edges[low + 1] - e->edges[low];
    const double again = span > 0.0 ? (u[0] - e->edges[low]) / span : 0.5;
    const double root = sqrt(again); /* even over the triangle: pbrt's uniform triangle */
    const double weights[2] = { root * (1.0 - u[1]), root * u[1] };
    vec3 c[3];
    world_corners(e->geometry, e->triangles[low].instance, e->triangles[low].triangle, c);
    describe(e, low, out);
    out->position = v3_mad(v3_mad(c[0], v3_sub(c[1], c[0]), weights[0]), v3_sub(c[2], c[0]), weights[1]);
    out->at = (trace_hit){ e->triangles[low].instance, e->triangles[low].triangle, 0.0, { weights[0], weights[1] } };
}

bool emitters_find(const emitters *e, const trace_hit *at, emitter_point *out)
{
    if (e->count == 0 || e->first[at->instance] < 0)
        return false;
    describe(e, e->first[at->instance] + (int)at->triangle, out);
    out->at = *at;
    return true;
}
