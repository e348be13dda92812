/* What a mesh says about the point that a ray has hit: frame, texture coordinates, colour, and their derivatives. */
#ifndef PREVIEW_HIT_H
#define PREVIEW_HIT_H

#include "preview/differential.h"
#include "preview/kernels.h"
#include "preview/trace.h"

typedef struct hit {
    const scene_mesh *mesh;
    const scene_instance *instance;
    const geometry_instance *placed;
    uint32_t corner[3]; /* the triangle's vertices */
    double weights[2];  /* of the corners 1 and 2 */
    double distance;
    vec3 position, position_object;
    bool front;                    /* seen from its front: counter-clockwise in the object's space */
    vec3 geometric_normal, normal; /* world, unit, on the viewer's side */
    vec3 tangent;                  /* world, unit, perpendicular to normal; along u where the mesh has tangents */
    vec3 bitangent;                /* along v: cross(normal, tangent) times the handedness, normal of the front */
    vec3 shadow_origin;            /* where shadow rays start: on the surface that the normals suggest */
    double clearance;              /* metres: see hit_leave */
} hit;

/* How the weights of the triangle and with them everything interpolated changes with a step of one pixel. */
typedef struct hit_step {
    surface_step position;
    double weights_dx[2], weights_dy[2];
} hit_step;

/* Only what needs no view of it: the triangle and the place in it. */
void hit_locate(const geometry *g, const trace_hit *found, hit *out);

/* A hit that is to be made ready. */
typedef struct hit_task {
    const trace_ray *ray;
    const differential *step; /* of the ray */
    trace_hit *found;         /* in and out: made exact */
    hit *hit;                 /* out, this and the next */
    hit_step *hit_step;       /* what the step does on the surface */
} hit_task;

void hit_resolve(const geometry *g, const hit_task *task);
/* The same for many, bit for bit. */
void hit_resolve_many(const geometry *g, const kernels *k, const hit_task *tasks, int count);

/* How the interpolated unit normal turns along the same steps. */
surface_step hit_turn(const hit *h, const hit_step *step);

/* Texture coordinates; 0 where the mesh has none. */
void hit_texcoord(const hit *h, int set, double st[2]);
/* Colour of the vertices; 1 where they have none. */
void hit_color(const hit *h, float rgba[4]);

/* d(s, t)/dx and /dy of a set of texture coordinates; zero where the mesh has none. */
void hit_texcoord_step(const hit *h, const hit_step *step, int set, double dx[2], double dy[2]);

/* Where a set of texture coordinates runs to, in world space and of any length: of the triangle, or along the mesh's
 * tangents, which are smooth, where they say the same. Zero where the coordinates do not tell. */
void hit_texcoord_axes(const hit *h, int set, vec3 *s, vec3 *t);

/* Moves the start of a ray off the surface, to the viewer's side, by more than the rounding of single precision. */
vec3 hit_leave(const hit *h, vec3 from);

#endif
