/* Brings hits into the structure of arrays that the kernels take, and back. */
#include "preview/hit_batch.h"

static void put(double to[3][HIT_BATCH], int i, vec3 a)
{
    to[0][i] = a.x;
    to[1][i] = a.y;
    to[2][i] = a.z;
}

static vec3 take(const double from[3][HIT_BATCH], int i)
{
    return v3(from[0][i], from[1][i], from[2][i]);
}

static void put_ray(hit_batch *b, int i, const hit_task *task)
{
    const differential *const step = task->step;
    put(b->origin, i, task->ray->origin);
    put(b->direction, i, task->ray->direction);
    put(b->step[0], i, step->origin_dx);
    put(b->step[1], i, step->origin_dy);
    put(b->step[2], i, step->direction_dx);
    put(b->step[3], i, step->direction_dy);
    b->weights[0][i] = task->found->weights[0];
    b->weights[1][i] = task->found->weights[1];
    b->distance[i] = task->found->distance;
}

static void put_triangle(hit_batch *b, int i, const hit *h)
{
    for (int k = 0; k < 3; ++k) {
        const float *const position = &h->mesh->position[3U * (size_t)h->corner[k]];
        const float *const normal = &h->mesh->normal[3U * (size_t)h->corner[k]];
        for (int axis = 0; axis < 3; ++axis) {
            b->position[k][axis][i] = position[axis];
            b->normal[k][axis][i] = normal[axis];
        }
    }
    b->placed[i] = h->placed;
    b->handedness[i] = h->placed->mirrored ? -1.0 : 1.0;
}

static void put_tangents(hit_batch *b, int i, const hit *h)
{
    const float *const tangent = h->mesh->tangent;
    for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
            b->tangent[k][axis][i] = tangent != NULL ? tangent[4U * (size_t)h->corner[k] + (size_t)axis] : 0.0F;
    if (tangent != NULL && tangent[4U * (size_t)h->corner[0] + 3U] < 0.0F)
        b->handedness[i] = -b->handedness[i];
}

static void take_hit(const hit_batch *b, int i, const hit_task *task)
{
    hit *const h = task->hit;
    h->weights[0] = task->found->weights[0] = b->weights[0][i];
    h->weights[1] = task->found->weights[1] = b->weights[1][i];
    h->distance = task->found->distance = b->distance[i];
    h->position = take(b->place, i);
    h->position_object = take(b->place_object, i);
    h->front = b->side[i] > 0.0;
    h->geometric_normal = take(b->flat, i);
    h->normal = take(b->smooth, i);
    h->tangent = take(b->along, i);
    h->bitangent = take(b->across, i);
    h->shadow_origin = take(b->shadow_origin, i);
    h->clearance = b->clearance[i];

    hit_step *const s = task->hit_step;
    s->position.dx = take(b->place_step[0], i);
    s->position.dy = take(b->place_step[1], i);
    for (int k = 0; k < 2; ++k) {
        s->weights_dx[k] = b->weights_step[0][k][i];
        s->weights_dy[k] = b->weights_step[1][k][i];
    }
}

/* At most HIT_BATCH. Lanes that are left over do what the last one does. */
static void resolve_some(const geometry *g, const kernels *k, const hit_task *tasks, int count)
{
    hit_batch b;
    b.has_tangents = false;
    for (int i = 0; i < count; ++i) {
        hit_locate(g, tasks[i].found, tasks[i].hit);
        b.has_tangents = b.has_tangents || tasks[i].hit->mesh->tangent != NULL;
    }
    for (int i = 0; i < count || i % k->lanes != 0; ++i) {
        const hit_task *const task = &tasks[i < count ? i : count - 1];
        put_ray(&b, i, task);
        put_triangle(&b, i, task->hit);
        if (b.has_tangents)
            put_tangents(&b, i, task->hit);
    }
    k->hit(&b, count);
    for (int i = 0; i < count; ++i)
        take_hit(&b, i, &tasks[i]);
}

void hit_resolve_many(const geometry *g, const kernels *k, const hit_task *tasks, int count)
{
    for (int first = 0; first < count; first += HIT_BATCH)
        resolve_some(g, k, &tasks[first], count - first < HIT_BATCH ? count - first : HIT_BATCH);
}

void hit_resolve(const geometry *g, const hit_task *task)
{
    hit_resolve_many(g, &kernels_1, task, 1);
}
