/* The instances of a scene with their inverse transforms, and where exactly a ray meets one of their triangles. */
#ifndef PREVIEW_GEOMETRY_H
#define PREVIEW_GEOMETRY_H

#include "preview/vector.h"
#include "scene/report.h"
#include "scene/scene.h"

typedef struct geometry_instance {
    double to_world[16], to_object[16];
    vec3 axis_scale; /* length of each axis of the object in metres */
    bool mirrored;   /* right and left are swapped */
    bool visible;    /* false: its transform flattens it, nothing can be hit */
} geometry_instance;

typedef struct geometry {
    const scene *scene;
    geometry_instance *instances; /* scene->instance_count */
} geometry;

/* Warns of every instance that is flattened. The scene must outlive the geometry. */
bool geometry_make(const scene *s, geometry *out, report *r);
/* Names the instances that are not visible. */
void geometry_warn_of_flat(const geometry *g, report *r);
void geometry_free(geometry *g);

typedef struct triangle_corners {
    uint32_t index[3];
    vec3 position[3]; /* object space */
} triangle_corners;

triangle_corners geometry_triangle(const geometry *g, int instance, uint32_t triangle);

/* Weights of the corners 1 and 2 and the distance along the ray (world space) to the plane of the triangle.
 * Computed in double precision and in one order of operations, so that a picture does not depend on the vector width
 * that Embree chose on this machine. The weights are clamped into the triangle: at grazing angles Embree's float ray
 * may hit where the exact one just misses. Returns false when the plane is edge-on, or the triangle has no area. */
bool geometry_meet(const geometry *g, int instance, uint32_t triangle, vec3 origin, vec3 direction, double weights[2],
                   double *distance);

#endif
