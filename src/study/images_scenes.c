/* The four scenes of the study of images, made by formula: a plane near by with few flakes, one that runs to the
 * horizon with many, a ball under a lamp, and a ball with glints below and in its coat. */
#include "study/images.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const images_names[IMAGES_SCENES] = { "near-sparse", "far-dense", "area-lit", "layered" };

/* Angular diameters, radians: the sun, and a lamp of five degrees, under which a few facets a pixel are lit. */
#define SUN 0.0093F
#define LAMP 0.09F

static void set3(float *to, double x, double y, double z)
{
    to[0] = (float)x;
    to[1] = (float)y;
    to[2] = (float)z;
}

/* Columns x, y, z (z from `at` to `from`), then `from`. */
static void look(float m[16], const double from[3], const double at[3])
{
    double z[3], x[3], length = 0.0;
    for (int k = 0; k < 3; k++) {
        z[k] = from[k] - at[k];
        length += z[k] * z[k];
    }
    for (int k = 0; k < 3; k++)
        z[k] /= sqrt(length);
    const double across = sqrt(z[0] * z[0] + z[2] * z[2]);
    x[0] = z[2] / across;
    x[1] = 0.0;
    x[2] = -z[0] / across;
    set3(m, x[0], x[1], x[2]);
    set3(m + 4, z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]);
    set3(m + 8, z[0], z[1], z[2]);
    set3(m + 12, from[0], from[1], from[2]);
    m[3] = m[7] = m[11] = 0.0F;
    m[15] = 1.0F;
}

/* One more entry of zeros at the end of an array; NULL without memory, and the array stays. */
static void *append(void **array, int *count, size_t size)
{
    char *const grown = realloc(*array, ((size_t)*count + 1) * size);
    if (!grown)
        return NULL;
    *array = grown;
    memset(grown + (size_t)*count * size, 0, size);
    return grown + (size_t)(*count)++ * size;
}

static int add_material(scene *s, const scene_material *m)
{
    scene_material *const to = append((void **)&s->materials, &s->material_count, sizeof *to);
    if (to)
        *to = *m;
    return to ? s->material_count - 1 : SCENE_NONE;
}

/* A mesh with room for so many vertices and triangles, and its instance. */
static scene_mesh *add_mesh(scene *s, int material, uint32_t vertices, uint32_t triangles)
{
    scene_mesh *const mesh = append((void **)&s->meshes, &s->mesh_count, sizeof *mesh);
    scene_instance *const instance = mesh ? append((void **)&s->instances, &s->instance_count, sizeof *instance) : NULL;
    if (!instance || material == SCENE_NONE)
        return NULL;
    instance->mesh = s->mesh_count - 1;
    for (int k = 0; k < 4; k++)
        instance->to_world[5 * k] = 1.0F;
    mesh->material = material;
    mesh->vertex_count = vertices;
    mesh->triangle_count = triangles;
    mesh->position = calloc(vertices, 3 * sizeof(float));
    mesh->normal = calloc(vertices, 3 * sizeof(float));
    mesh->tangent = calloc(vertices, 4 * sizeof(float));
    mesh->texcoord[0] = calloc(vertices, 2 * sizeof(float));
    mesh->index = calloc(triangles, 3 * sizeof(uint32_t));
    const int whole = mesh->position && mesh->normal && mesh->tangent && mesh->texcoord[0] && mesh->index;
    return whole ? mesh : NULL;
}

/* (s, t) in [0, 1]^2 over a net of n x n quads. */
static void net(scene_mesh *mesh, uint32_t n)
{
    uint32_t *to = mesh->index;
    for (uint32_t j = 0; j < n; j++)
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            const uint32_t both[6] = { a, c, b, b, c, d };
            memcpy(to, both, sizeof both);
            to += 6;
        }
}

/* Metres are texture coordinates, at y = 0. */
static bool add_ground(scene *s, int material, double half)
{
    scene_mesh *const mesh = add_mesh(s, material, 4, 2);
    if (!mesh)
        return false;
    for (int i = 0; i < 4; i++) {
        const double x = (i & 1 ? half : -half), z = (i > 1 ? half : -half);
        set3(&mesh->position[3 * i], x, 0.0, z);
        set3(&mesh->normal[3 * i], 0.0, 1.0, 0.0);
        set3(&mesh->tangent[4 * i], 1.0, 0.0, 0.0);
        mesh->tangent[4 * i + 3] = -1.0F;
        mesh->texcoord[0][2 * i] = (float)x;
        mesh->texcoord[0][2 * i + 1] = (float)z;
    }
    net(mesh, 1);
    return true;
}

/* On the ground, over the origin. */
static bool add_ball(scene *s, int material, double radius)
{
    enum { N = 96 };
    scene_mesh *const mesh = add_mesh(s, material, (N + 1) * (N + 1), 2 * N * N);
    if (!mesh)
        return false;
    for (int i = 0; i < (N + 1) * (N + 1); i++) {
        const int column = i % (N + 1), row = i / (N + 1);
        const double u = (double)column / N, v = (double)row / N;
        const double phi = 6.283185307179586 * u, theta = 3.141592653589793 * v;
        const double x = sin(theta) * sin(phi), y = cos(theta), z = sin(theta) * cos(phi);
        set3(&mesh->position[3 * i], radius * x, radius * (1.0 + y), radius * z);
        set3(&mesh->normal[3 * i], x, y, z);
        set3(&mesh->tangent[4 * i], cos(phi), 0.0, -sin(phi));
        mesh->tangent[4 * i + 3] = -1.0F;
        mesh->texcoord[0][2 * i] = (float)(radius * phi);
        mesh->texcoord[0][2 * i + 1] = (float)(radius * theta);
    }
    net(mesh, N);
    return true;
}

/* diameter: of a directional light, radians. */
static bool add_light(scene *s, scene_light_kind kind, const double from[3], float intensity, float diameter)
{
    static const double origin[3] = { 0.0, 0.0, 0.0 };
    scene_light *const l = append((void **)&s->lights, &s->light_count, sizeof *l);
    if (!l)
        return false;
    *l = (scene_light){ .kind = kind, .color = { 1.0F, 1.0F, 1.0F }, .intensity = intensity };
    l->angular_diameter_rad = diameter;
    l->width_m = l->height_m = 0.25F;
    look(l->to_world, from, origin);
    return true;
}

static bool add_camera(scene *s, const double from[3], const double at[3], double yfov)
{
    scene_camera *const c = append((void **)&s->cameras, &s->camera_count, sizeof *c);
    if (!c)
        return false;
    *c = (scene_camera){ .projection = SCENE_PERSPECTIVE, .yfov_rad = (float)yfov, .znear = 0.001F };
    look(c->to_world, from, at);
    return true;
}

static scene_material flakes(float roughness, float per_m2)
{
    scene_material m = scene_material_default();
    m.roughness = roughness;
    m.base_color[0] = m.base_color[1] = m.base_color[2] = 0.8F;
    m.glint.present = true;
    m.glint.factor = 1.0F;
    m.glint.density = per_m2;
    return m;
}

static scene_material matte(float grey)
{
    scene_material m = scene_material_default();
    m.base_color[0] = m.base_color[1] = m.base_color[2] = grey;
    m.metallic = 0.0F;
    return m;
}

static void bound(scene *s)
{
    for (int k = 0; k < 3; k++) {
        s->bounds_min[k] = INFINITY;
        s->bounds_max[k] = -INFINITY;
    }
    for (int i = 0; i < s->mesh_count; i++)
        for (uint32_t v = 0; v < 3 * s->meshes[i].vertex_count; v++) {
            s->bounds_min[v % 3] = fminf(s->bounds_min[v % 3], s->meshes[i].position[v]);
            s->bounds_max[v % 3] = fmaxf(s->bounds_max[v % 3], s->meshes[i].position[v]);
        }
}

static bool make_plane(scene *s, const scene_material *m, double half, const double eye[3], const double at[3],
                       double yfov, const double sun[3], float diameter)
{
    return add_ground(s, add_material(s, m), half) && add_camera(s, eye, at, yfov) &&
           add_light(s, SCENE_LIGHT_DIRECTIONAL, sun, 3.0F, diameter);
}

static bool make_ball(scene *s, const scene_material *m, scene_light_kind kind, const double from[3], float intensity)
{
    static const double eye[3] = { 0.0, 0.16, 0.42 }, at[3] = { 0.0, 0.07, 0.0 };
    const scene_material ground = matte(0.3F);
    return add_ball(s, add_material(s, m), 0.08) && add_ground(s, add_material(s, &ground), 0.5) &&
           add_camera(s, eye, at, 0.5) && add_light(s, kind, from, intensity, LAMP);
}

static bool make(int which, scene *s)
{
    static const double near_eye[3] = { 0.0, 0.16, 0.16 }, middle[3] = { 0.0, 0.0, 0.0 };
    static const double far_eye[3] = { 0.0, 1.6, 6.0 }, far_at[3] = { 0.0, 0.0, 0.0 };
    static const double near_sun[3] = { 0.1, 1.0, -1.0 }, far_sun[3] = { 0.05, 0.35, -1.0 };
    static const double lamp[3] = { 0.25, 0.45, 0.25 }, sun[3] = { 0.5, 0.9, 0.6 };
    scene_material m = flakes(0.5F, 1e6F);
    switch (which) {
    case IMAGES_SPARSE:
        return make_plane(s, &m, 0.3, near_eye, middle, 0.4, near_sun, LAMP);
    case IMAGES_DENSE:
        m = flakes(0.55F, 3e7F);
        return make_plane(s, &m, 30.0, far_eye, far_at, 0.5, far_sun, SUN);
    case IMAGES_AREA:
        m = flakes(0.5F, 4e6F);
        return make_ball(s, &m, SCENE_LIGHT_RECT, lamp, 12.0F);
    default:
        break;
    }
    m = flakes(0.6F, 2e6F);
    m.base_color[0] = 0.9F;
    m.base_color[1] = 0.35F;
    m.base_color[2] = 0.2F;
    m.clearcoat = 1.0F;
    m.clearcoat_roughness = 0.3F;
    m.coat_glint = m.glint;
    m.coat_glint.seed = 1U;
    m.coat_glint.layer = SCENE_LAYER_CLEARCOAT;
    m.coat_glint.density = 5e5F;
    return make_ball(s, &m, SCENE_LIGHT_DIRECTIONAL, sun, 3.0F);
}

bool images_make(int which, scene *s, report *r)
{
    *s = (scene){ 0 };
    if (!make(which, s))
        return report_error(r, "images: no memory for the scene %s", images_names[which]);
    bound(s);
    return true;
}
