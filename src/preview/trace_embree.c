/* Rays by Embree 3: the only file that includes it. One Embree scene a mesh, one instance a node. */
#include "preview/trace.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdlib.h>

#include "preview/hash.h"

/* Embree's builder cuts its work by the number of its threads, and with it the order of coincident triangles. A fixed
 * number gives the same picture with any number of render threads. */
#define BUILD_CONFIGURATION "threads=4"

/* A fine tree takes some 1900 instructions a triangle more than a quick one (a shader ball of 318 000), a sample some
 * 5800 in either. In a scene of evenly large triangles quick trees are as good within a percent; were rays twice as
 * dear in one, it would still pay up to one sample for three triangles. */
#define TRIANGLES_A_SAMPLE 3.0

typedef struct mesh_geometry {
    RTCScene scene; /* NULL: no instance needs it */
    scene_alpha_mode alpha_mode;
    float alpha_cutoff;
    bool double_sided;
} mesh_geometry;

struct trace_scene {
    RTCDevice device;
    RTCScene top;
    mesh_geometry *meshes;
    const geometry *geometry;
    enum RTCBuildQuality quality;
    trace_opacity opacity;
    const void *user;
};

/* The context that Embree hands to the filters, which see this around it. */
typedef struct query {
    struct RTCIntersectContext context; /* first: the filters cast */
    const trace_scene *scene;
    const trace_ray *const *rays; /* by Embree's id of a ray */
    trace_blending blending;
    bool shadow;
    float nearest_back[TRACE_PACKET]; /* that the ray passed, by its id; not set of shadows */
} query;

/* Whether a blended surface stops this ray. The draw belongs to the triangle and the ray, not to the order in which
 * Embree offers its hits. */
static bool stops(const query *q, const mesh_geometry *mesh, const trace_ray *ray, const trace_hit *at)
{
    const float opacity = q->scene->opacity(q->scene->user, at);
    if (mesh->alpha_mode == SCENE_ALPHA_MASK)
        return opacity >= mesh->alpha_cutoff;
    if (q->blending == TRACE_BLEND_SOLID)
        return opacity > 0.0F;
    return hash_uniform(hash_combine(hash_combine(ray->random, (uint32_t)at->instance), at->triangle)) < opacity;
}

/* A packet of N rays or hits is an array of N for each member in turn. Embree has names for them in C++ only. */
enum { RAY_DIRECTION = 4, RAY_FAR = 8, RAY_ID = 10, HIT_NORMAL = 0, HIT_U = 3, HIT_V, HIT_TRIANGLE };

static float member(const void *packet, unsigned n, unsigned which, unsigned i)
{
    return ((const float *)packet)[which * n + i];
}

static uint32_t member_bits(const void *packet, unsigned n, unsigned which, unsigned i)
{
    return ((const uint32_t *)packet)[which * n + i];
}

static bool stops_by_opacity(const query *q, const mesh_geometry *mesh, const struct RTCFilterFunctionNArguments *a,
                             unsigned i)
{
    const unsigned n = a->N;
    if (mesh->alpha_mode == SCENE_ALPHA_OPAQUE)
        return true;

    const trace_ray *const exact = q->rays[member_bits(a->ray, n, RAY_ID, i)];
    trace_hit at = { .instance = (int)q->context.instID[0],
                     .triangle = member_bits(a->hit, n, HIT_TRIANGLE, i),
                     .distance = (double)member(a->ray, n, RAY_FAR, i),
                     .weights = { (double)member(a->hit, n, HIT_U, i), (double)member(a->hit, n, HIT_V, i) } };
    geometry_meet(q->scene->geometry, at.instance, at.triangle, exact->origin, exact->direction, at.weights,
                  &at.distance);
    return stops(q, mesh, exact, &at);
}

/* Whether ray i of n is stopped by what it meets. */
static bool accepts(query *q, const mesh_geometry *mesh, const struct RTCFilterFunctionNArguments *a, unsigned i)
{
    const unsigned n = a->N;
    /* Both vectors are in the object's space, where counter-clockwise is the front whatever the node's transform. */
    float facing = 0.0F;
    for (unsigned k = 0; k < 3; ++k)
        facing += member(a->hit, n, HIT_NORMAL + k, i) * member(a->ray, n, RAY_DIRECTION + k, i);
    const bool stopped = stops_by_opacity(q, mesh, a, i);
    if (mesh->double_sided || q->shadow || !(facing > 0.0F))
        return stopped;
    float *const back = &q->nearest_back[member_bits(a->ray, n, RAY_ID, i)];
    if (stopped)
        *back = fminf(*back, member(a->ray, n, RAY_FAR, i));
    return false;
}

static void filter(const struct RTCFilterFunctionNArguments *arguments)
{
    query *const q = (query *)(void *)arguments->context;
    for (unsigned i = 0; i < arguments->N; ++i)
        if (arguments->valid[i] == -1 && !accepts(q, arguments->geometryUserPtr, arguments, i))
            arguments->valid[i] = 0;
}

/* ---- building ---- */

trace_trees trace_trees_for(const geometry *g, double samples)
{
    double triangles = 0.0;
    for (int i = 0; i < g->scene->mesh_count; ++i)
        triangles += g->scene->meshes[i].triangle_count;
    return TRIANGLES_A_SAMPLE * samples < triangles ? TRACE_TREES_QUICK : TRACE_TREES_FINE;
}

static bool embree_failed(RTCDevice device, const char *what, report *r)
{
    const enum RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_NONE)
        return false;
    report_error(r, "Embree failed while %s: %s", what,
                 code == RTC_ERROR_OUT_OF_MEMORY     ? "out of memory"
                 : code == RTC_ERROR_UNSUPPORTED_CPU ? "this processor is not supported"
                                                     : "internal error");
    return true;
}

static bool build_mesh(trace_scene *t, int index, report *r)
{
    const scene_mesh *const mesh = &t->geometry->scene->meshes[index];
    const scene_material *const material = &t->geometry->scene->materials[mesh->material];
    mesh_geometry *const to = &t->meshes[index];
    to->alpha_mode = material->alpha_mode;
    to->alpha_cutoff = material->alpha_cutoff;
    to->double_sided = material->double_sided;

    RTCGeometry triangles = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    /* A buffer of Embree's own: it reads 16 bytes a vertex, past the end of ours. */
    float *const vertices = rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                    3 * sizeof(float), mesh->vertex_count);
    if (vertices != NULL) {
        for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; ++i)
            vertices[i] = mesh->position[i];
    }
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->index, 0,
                               3 * sizeof(uint32_t), mesh->triangle_count);
    rtcSetGeometryUserData(triangles, to);
    rtcSetGeometryBuildQuality(triangles, t->quality);
    if (to->alpha_mode != SCENE_ALPHA_OPAQUE)
        rtcSetGeometryOccludedFilterFunction(triangles, filter);
    if (to->alpha_mode != SCENE_ALPHA_OPAQUE || !to->double_sided)
        rtcSetGeometryIntersectFilterFunction(triangles, filter);
    rtcCommitGeometry(triangles);

    to->scene = rtcNewScene(t->device);
    rtcSetSceneFlags(to->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(to->scene, t->quality);
    rtcAttachGeometry(to->scene, triangles);
    rtcReleaseGeometry(triangles);
    rtcCommitScene(to->scene);
    return !embree_failed(t->device, mesh->name ? mesh->name : "building a mesh", r);
}

static bool build_instance(trace_scene *t, int index, report *r)
{
    const scene_instance *const instance = &t->geometry->scene->instances[index];
    const scene_mesh *const mesh = &t->geometry->scene->meshes[instance->mesh];
    if (!t->geometry->instances[index].visible || mesh->triangle_count == 0)
        return true;
    if (t->meshes[instance->mesh].scene == NULL && !build_mesh(t, instance->mesh, r))
        return false;

    RTCGeometry placed = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(placed, t->meshes[instance->mesh].scene);
    rtcSetGeometryTimeStepCount(placed, 1);
    rtcSetGeometryTransform(placed, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, instance->to_world);
    rtcCommitGeometry(placed);
    rtcAttachGeometryByID(t->top, placed, (unsigned)index);
    rtcReleaseGeometry(placed);
    return !embree_failed(t->device, "placing an instance", r);
}

bool trace_build(const geometry *g, trace_trees trees, trace_opacity opacity, const void *user, trace_scene **out,
                 report *r)
{
    *out = NULL;
    trace_scene *const t = calloc(1, sizeof *t);
    const size_t mesh_count = (size_t)g->scene->mesh_count;
    mesh_geometry *const meshes = calloc(mesh_count > 0 ? mesh_count : 1U, sizeof *meshes);
    if (t == NULL || meshes == NULL) {
        free(t);
        free(meshes);
        return report_error(r, "no memory for %zu meshes", mesh_count);
    }
    *t = (trace_scene){ .meshes = meshes, .geometry = g, .opacity = opacity, .user = user };
    t->quality = trees == TRACE_TREES_QUICK ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM;
    t->device = rtcNewDevice(BUILD_CONFIGURATION);
    bool ok = t->device != NULL || (!embree_failed(NULL, "starting", r) && report_error(r, "Embree does not start"));
    if (ok) {
        t->top = rtcNewScene(t->device);
        rtcSetSceneFlags(t->top, RTC_SCENE_FLAG_ROBUST);
    }
    for (int i = 0; ok && i < g->scene->instance_count; ++i)
        ok = build_instance(t, i, r);
    if (ok) {
        rtcCommitScene(t->top);
        ok = !embree_failed(t->device, "building the scene", r);
    }
    if (!ok) {
        trace_free(t);
        return false;
    }
    *out = t;
    return true;
}

void trace_free(trace_scene *t)
{
    if (t == NULL)
        return;
    if (t->top != NULL)
        rtcReleaseScene(t->top);
    for (int i = 0; i < t->geometry->scene->mesh_count; ++i) {
        if (t->meshes[i].scene != NULL)
            rtcReleaseScene(t->meshes[i].scene);
    }
    if (t->device != NULL)
        rtcReleaseDevice(t->device);
    free(t->meshes);
    free(t);
}

/* ---- rays ---- */

static struct RTCRay embree_ray(const trace_ray *ray)
{
    return (struct RTCRay){ .org_x = (float)ray->origin.x,
                            .org_y = (float)ray->origin.y,
                            .org_z = (float)ray->origin.z,
                            .tnear = (float)ray->near,
                            .dir_x = (float)ray->direction.x,
                            .dir_y = (float)ray->direction.y,
                            .dir_z = (float)ray->direction.z,
                            .tfar = (float)ray->far,
                            .mask = UINT32_MAX };
}

static query make_query(const trace_scene *t, const trace_ray *const *rays, trace_blending blending, bool shadow)
{
    query q = { .scene = t, .rays = rays, .blending = blending, .shadow = shadow };
    rtcInitIntersectContext(&q.context);
    for (int i = 0; !shadow && i < TRACE_PACKET; ++i)
        q.nearest_back[i] = INFINITY;
    return q;
}

/* A back so close to what is hit is its other side: shadow rays towards it end there, too. */
#define BEFORE 0.9999F

bool trace_closest(const trace_scene *t, const trace_ray *ray, trace_blending blending, trace_hit *hit)
{
    query q = make_query(t, &ray, blending, false);
    struct RTCRayHit found = { .ray = embree_ray(ray) };
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(t->top, &q.context, &found);
    const bool through_back = q.nearest_back[0] < BEFORE * found.ray.tfar;
    hit->through_back = through_back;
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    *hit = (trace_hit){ .instance = (int)found.hit.instID[0],
                        .triangle = found.hit.primID,
                        .distance = (double)found.ray.tfar,
                        .weights = { (double)found.hit.u, (double)found.hit.v },
                        .through_back = through_back };
    return true;
}

bool trace_occluded(const trace_scene *t, const trace_ray *ray)
{
    query q = make_query(t, &ray, TRACE_BLEND_RANDOM, true);
    struct RTCRay shadow = embree_ray(ray);
    rtcOccluded1(t->top, &q.context, &shadow);
    return shadow.tfar < 0.0F;
}

/* ---- packets ---- */

static const trace_ray no_ray;

/* valid: -1 where there is a ray. False: there is none, and Embree would never come back from it. */
static bool set_packet(const trace_ray *const rays[TRACE_PACKET], struct RTCRay16 *to, int valid[TRACE_PACKET])
{
    int is_any = 0;
    for (unsigned i = 0; i < TRACE_PACKET; ++i) {
        /* Narrower machines look at the numbers of lanes without a ray, too. */
        const trace_ray *const ray = rays[i] != NULL ? rays[i] : &no_ray;
        valid[i] = rays[i] != NULL ? -1 : 0;
        is_any |= valid[i];
        to->org_x[i] = (float)ray->origin.x;
        to->org_y[i] = (float)ray->origin.y;
        to->org_z[i] = (float)ray->origin.z;
        to->tnear[i] = (float)ray->near;
        to->dir_x[i] = (float)ray->direction.x;
        to->dir_y[i] = (float)ray->direction.y;
        to->dir_z[i] = (float)ray->direction.z;
        to->tfar[i] = (float)ray->far;
        to->id[i] = i;
        to->time[i] = 0.0F;
        to->mask[i] = UINT32_MAX;
        to->flags[i] = 0;
    }
    return is_any != 0;
}

uint32_t trace_closest_packet(const trace_scene *t, const trace_ray *const rays[TRACE_PACKET], trace_blending blending,
                              trace_hit hits[TRACE_PACKET])
{
    _Alignas(64) int valid[TRACE_PACKET];
    struct RTCRayHit16 found;
    query q = make_query(t, rays, blending, false);
    /* Rays of the camera: they go the same way through the tree. Shadow rays that are told so take more instructions.
     */
    if (blending == TRACE_BLEND_SOLID)
        q.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (!set_packet(rays, &found.ray, valid)) {
        for (int i = 0; i < TRACE_PACKET; ++i)
            hits[i].through_back = false;
        return 0;
    }
    for (int i = 0; i < TRACE_PACKET; ++i)
        found.hit.geomID[i] = found.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect16(valid, t->top, &q.context, &found);

    uint32_t hit = 0;
    for (int i = 0; i < TRACE_PACKET; ++i) {
        if (rays[i] == NULL)
            continue;
        const bool through_back = q.nearest_back[i] < BEFORE * found.ray.tfar[i];
        hits[i].through_back = through_back;
        if (found.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
            continue;
        hits[i] = (trace_hit){ .instance = (int)found.hit.instID[0][i],
                               .triangle = found.hit.primID[i],
                               .distance = (double)found.ray.tfar[i],
                               .weights = { (double)found.hit.u[i], (double)found.hit.v[i] },
                               .through_back = through_back };
        hit |= 1U << i;
    }
    return hit;
}

uint32_t trace_occluded_packet(const trace_scene *t, const trace_ray *const rays[TRACE_PACKET])
{
    _Alignas(64) int valid[TRACE_PACKET];
    struct RTCRay16 shadows;
    query q = make_query(t, rays, TRACE_BLEND_RANDOM, true);
    if (!set_packet(rays, &shadows, valid))
        return 0;
    rtcOccluded16(valid, t->top, &q.context, &shadows);

    uint32_t occluded = 0;
    for (int i = 0; i < TRACE_PACKET; ++i)
        if (rays[i] != NULL && shadows.tfar[i] < 0.0F)
            occluded |= 1U << i;
    return occluded;
}
