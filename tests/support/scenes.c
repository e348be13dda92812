/* Geometry by formula. */
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "png_file.h"

#define PI 3.14159265358979323846

static void *checked(void *memory)
{
    if (memory == NULL) {
        fputs("scenes: no memory\n", stderr);
        abort();
    }
    return memory;
}

/* Makes room for one more entry at the end of an array. */
static void *append(void *array, int *count, size_t entry_size)
{
    void *const grown = checked(realloc(array, ((size_t)*count + 1) * entry_size));
    memset((char *)grown + (size_t)*count * entry_size, 0, entry_size);
    ++*count;
    return grown;
}

scene scenes_empty(void)
{
    scene s = { 0 };
    for (int i = 0; i < 3; ++i) {
        s.bounds_min[i] = INFINITY;
        s.bounds_max[i] = -INFINITY;
    }
    return s;
}

scene_material scenes_matte(float color)
{
    scene_material m = scene_material_default();
    m.base_color[0] = m.base_color[1] = m.base_color[2] = color;
    m.metallic = 0.0F;
    m.specular = 0.0F;
    return m;
}

scene_material scenes_flakes(float roughness, float facets_per_m2)
{
    scene_material m = scene_material_default();
    m.roughness = roughness;
    m.glint.present = true;
    m.glint.factor = 1.0F;
    m.glint.density = facets_per_m2;
    m.glint.facet_roughness = 0.0F;
    m.glint.uv_scale = 1.0F;
    return m;
}

int scenes_add_material(scene *s, const scene_material *m)
{
    s->materials = append(s->materials, &s->material_count, sizeof *s->materials);
    s->materials[s->material_count - 1] = *m;
    return s->material_count - 1;
}

static scene_mesh *add_mesh(scene *s, int material, uint32_t vertex_count, uint32_t triangle_count)
{
    s->meshes = append(s->meshes, &s->mesh_count, sizeof *s->meshes);
    scene_mesh *const mesh = &s->meshes[s->mesh_count - 1];
    mesh->material = material;
    mesh->vertex_count = vertex_count;
    mesh->triangle_count = triangle_count;
    mesh->position = checked(calloc(vertex_count, 3 * sizeof(float)));
    mesh->normal = checked(calloc(vertex_count, 3 * sizeof(float)));
    mesh->index = checked(calloc(triangle_count, 3 * sizeof(uint32_t)));
    return mesh;
}

static void add_coordinates(scene_mesh *mesh)
{
    mesh->tangent = checked(calloc(mesh->vertex_count, 4 * sizeof(float)));
    mesh->texcoord[0] = checked(calloc(mesh->vertex_count, 2 * sizeof(float)));
}

static void set(float *to, double x, double y, double z)
{
    to[0] = (float)x;
    to[1] = (float)y;
    to[2] = (float)z;
}

int scenes_add_square(scene *s, int material, float half_size)
{
    scene_mesh *const mesh = add_mesh(s, material, 4, 2);
    add_coordinates(mesh);
    for (size_t i = 0; i < 4; ++i) {
        const bool right = (i & 1) != 0, near = i > 1;
        set(&mesh->position[3 * i], (double)(right ? half_size : -half_size), 0.0,
            (double)(near ? half_size : -half_size));
        set(&mesh->normal[3 * i], 0.0, 1.0, 0.0);
        set(&mesh->tangent[4 * i], 1.0, 0.0, 0.0);
        mesh->tangent[4 * i + 3] = 1.0F; /* the bitangent is cross(+y, +x) = -z: up in the picture */
        mesh->texcoord[0][2 * i] = (float)right;
        mesh->texcoord[0][2 * i + 1] = (float)near;
    }
    static const uint32_t index[6] = { 0, 2, 1, 1, 2, 3 };
    memcpy(mesh->index, index, sizeof index);
    return s->mesh_count - 1;
}

static void set_sphere_vertex(scene_mesh *mesh, size_t i, double radius, double s, double t)
{
    const double longitude = 2.0 * PI * s, colatitude = PI * t;
    const double x = sin(colatitude) * sin(longitude), y = cos(colatitude), z = sin(colatitude) * cos(longitude);
    set(&mesh->position[3 * i], radius * x, radius * y, radius * z);
    set(&mesh->normal[3 * i], x, y, z);
    set(&mesh->tangent[4 * i], cos(longitude), 0.0, -sin(longitude));
    mesh->tangent[4 * i + 3] = 1.0F;
    mesh->texcoord[0][2 * i] = (float)s;
    mesh->texcoord[0][2 * i + 1] = (float)t;
}

int scenes_add_sphere(scene *s, int material, float radius, int slices, int stacks)
{
    const uint32_t columns = (uint32_t)slices + 1, rows = (uint32_t)stacks + 1;
    scene_mesh *const mesh = add_mesh(s, material, columns * rows, 2 * (uint32_t)slices * (uint32_t)stacks);
    add_coordinates(mesh);
    for (uint32_t r = 0; r < rows; ++r)
        for (uint32_t c = 0; c < columns; ++c)
            set_sphere_vertex(mesh, (size_t)r * columns + c, (double)radius, (double)c / slices, (double)r / stacks);
    uint32_t *to = mesh->index;
    for (uint32_t r = 0; r + 1 < rows; ++r) {
        for (uint32_t c = 0; c + 1 < columns; ++c) {
            const uint32_t a = r * columns + c, b = a + columns;
            const uint32_t corners[6] = { a, b, b + 1, a, b + 1, a + 1 };
            memcpy(to, corners, sizeof corners);
            to += 6;
        }
    }
    return s->mesh_count - 1;
}

int scenes_add_triangles(scene *s, int material, const float *positions, uint32_t triangle_count)
{
    scene_mesh *const mesh = add_mesh(s, material, 3 * triangle_count, triangle_count);
    memcpy(mesh->position, positions, 9 * (size_t)triangle_count * sizeof(float));
    for (size_t t = 0; t < triangle_count; ++t) {
        const float *const p = &positions[9 * t];
        const double a[3] = { (double)(p[3] - p[0]), (double)(p[4] - p[1]), (double)(p[5] - p[2]) };
        const double b[3] = { (double)(p[6] - p[0]), (double)(p[7] - p[1]), (double)(p[8] - p[2]) };
        const double n[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (size_t k = 0; k < 3; ++k) {
            mesh->index[3 * t + k] = (uint32_t)(3 * t + k);
            if (length > 0.0)
                set(&mesh->normal[9 * t + 3 * k], n[0] / length, n[1] / length, n[2] / length);
            else
                set(&mesh->normal[9 * t + 3 * k], 0.0, 1.0, 0.0);
        }
    }
    return s->mesh_count - 1;
}

void scenes_translation(float m[16], float x, float y, float z)
{
    const float identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1 };
    memcpy(m, identity, sizeof identity);
}

void scenes_add_instance(scene *s, int mesh, const float *to_world, int node)
{
    s->instances = append(s->instances, &s->instance_count, sizeof *s->instances);
    scene_instance *const instance = &s->instances[s->instance_count - 1];
    instance->mesh = mesh;
    instance->node = node;
    if (to_world != NULL)
        memcpy(instance->to_world, to_world, sizeof instance->to_world);
    else
        scenes_translation(instance->to_world, 0.0F, 0.0F, 0.0F);

    const float *const m = instance->to_world;
    const scene_mesh *const from = &s->meshes[mesh];
    for (size_t v = 0; v < from->vertex_count; ++v) {
        const float *const p = &from->position[3 * v];
        for (size_t k = 0; k < 3; ++k) {
            const float at = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
            s->bounds_min[k] = fminf(s->bounds_min[k], at);
            s->bounds_max[k] = fmaxf(s->bounds_max[k], at);
        }
    }
}

/* Axes of something at eye whose -z points at target. */
static void look(float m[16], const float eye[3], const float target[3])
{
    double z[3], length = 0.0;
    for (int k = 0; k < 3; ++k) {
        z[k] = (double)eye[k] - (double)target[k];
        length += z[k] * z[k];
    }
    for (int k = 0; k < 3; ++k)
        z[k] /= sqrt(length);
    const bool steep = fabs(z[1]) > 0.999;
    const double up[3] = { 0.0, steep ? 0.0 : 1.0, steep ? -1.0 : 0.0 };
    double x[3] = { up[1] * z[2] - up[2] * z[1], up[2] * z[0] - up[0] * z[2], up[0] * z[1] - up[1] * z[0] };
    const double x_length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int k = 0; k < 3; ++k)
        x[k] /= x_length;
    scenes_translation(m, eye[0], eye[1], eye[2]);
    set(&m[0], x[0], x[1], x[2]);
    set(&m[4], z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]);
    set(&m[8], z[0], z[1], z[2]);
}

scene_light *scenes_add_light(scene *s, scene_light_kind kind, const float from[3], float intensity)
{
    static const float origin[3] = { 0.0F, 0.0F, 0.0F };
    s->lights = append(s->lights, &s->light_count, sizeof *s->lights);
    scene_light *const l = &s->lights[s->light_count - 1];
    *l = (scene_light){ .kind = kind,
                        .color = { 1.0F, 1.0F, 1.0F },
                        .intensity = intensity,
                        .outer_cone_rad = 0.7853982F,
                        .angular_diameter_rad = 0.00929F,
                        .radius_m = 0.01F };
    look(l->to_world, from, origin);
    return l;
}

scene_camera scenes_camera(scene_projection projection, const float eye[3], const float target[3], float size)
{
    scene_camera c = { .projection = projection, .yfov_rad = size, .xmag = size, .ymag = size };
    look(c.to_world, eye, target);
    return c;
}

scene_texture scenes_add_texture(scene *s, const uint8_t *rgba, int width, int height)
{
    size_t byte_count;
    uint8_t *const png = png_file(rgba, width, height, &byte_count);
    s->images = append(s->images, &s->image_count, sizeof *s->images);
    s->images[s->image_count - 1] = (scene_image){ .bytes = png, .byte_count = byte_count };
    s->images[s->image_count - 1].name = checked(calloc(1, sizeof "test.png"));
    memcpy(s->images[s->image_count - 1].name, "test.png", sizeof "test.png");
    scene_texture t = scene_texture_none();
    t.image = s->image_count - 1;
    t.nearest = true;
    return t;
}
