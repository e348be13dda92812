/* The square, and calls that fail the test when they fail. */
#include "caller.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

const float SQUARE_POSITIONS[12] = { -1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1 };
static const float NORMALS[12] = { 0, 1, 0, 0, 2, 0, 0, 1, 0, 0, 1, 0 };
static const float TEXCOORDS[8] = { 0, 0, 0, 1, 1, 1, 1, 0 };
static const uint32_t INDICES[6] = { 0, 1, 2, 0, 2, 3 };
const float IDENTITY[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
static const int32_t ZERO[1] = { 0 };

void make_square(square_scene *s)
{
    s->mesh = (glint_preview_mesh)GLINT_PREVIEW_MESH_INIT;
    s->mesh.vertex_count = 4;
    s->mesh.triangle_count = 2;
    s->mesh.positions = SQUARE_POSITIONS;
    s->mesh.normals = NORMALS;
    s->mesh.texcoords[0] = TEXCOORDS;
    s->mesh.indices = INDICES;
    s->sun = (glint_preview_light)GLINT_PREVIEW_LIGHT_INIT;
    const float down[16] = { 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1 }; /* z points up, the light down */
    memcpy(s->sun.to_world, down, sizeof down);
    s->sun.intensity = 3.0F;
    s->options = (glint_preview_scene_options)GLINT_PREVIEW_SCENE_OPTIONS_INIT;
    s->options.materials = "{\"materials\": [" MATTE("0.5, 0.25, 0.125", "") "]}";
    s->options.meshes = &s->mesh;
    s->options.mesh_count = 1;
    s->options.instance_count = 1;
    s->options.instance_to_world = IDENTITY;
    s->options.instance_mesh = ZERO;
    s->options.lights = &s->sun;
    s->options.light_count = 1;
}

glint_preview_camera from_above(float half_size)
{
    glint_preview_camera c = GLINT_PREVIEW_CAMERA_INIT;
    const float to_world[16] = { 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 4, 0, 1 };
    memcpy(c.to_world, to_world, sizeof to_world);
    c.projection = GLINT_PREVIEW_ORTHOGRAPHIC;
    c.left = c.bottom = -half_size;
    c.right = c.top = half_size;
    return c;
}

glint_preview_picture_options small(const glint_preview_camera *camera)
{
    glint_preview_picture_options o = GLINT_PREVIEW_PICTURE_OPTIONS_INIT;
    o.camera = camera;
    o.width = o.height = 8;
    o.samples = 4;
    o.bounces = 0;
    o.threads = 1;
    return o;
}

glint_preview_scene *create(const glint_preview_scene_options *o)
{
    glint_preview_scene *s;
    char message[512];
    if (glint_preview_scene_create(o, &s, message, sizeof message) != GLINT_PREVIEW_OK)
        fail_msg("no scene: %s", message);
    return s;
}

glint_preview_picture *begin(const glint_preview_scene *s, const glint_preview_picture_options *o)
{
    glint_preview_picture *p;
    char message[512];
    if (glint_preview_picture_create(s, o, &p, message, sizeof message) != GLINT_PREVIEW_OK)
        fail_msg("no picture: %s", message);
    return p;
}

void refine(glint_preview_picture *p, int32_t samples)
{
    char message[512];
    if (glint_preview_picture_refine(p, samples, message, sizeof message) != GLINT_PREVIEW_OK)
        fail_msg("not refined: %s", message);
}

void get(const glint_preview_picture *p, int32_t pass, float *values, size_t count)
{
    char message[512];
    if (glint_preview_picture_read(p, pass, 1, values, count, message, sizeof message) != GLINT_PREVIEW_OK)
        fail_msg("not read: %s", message);
}

void refuse(const glint_preview_scene_options *o, const char *named)
{
    static char elsewhere;
    glint_preview_scene *s = (void *)&elsewhere;
    char message[512] = "";
    assert_int_equal(glint_preview_scene_create(o, &s, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_null(s);
    if (strstr(message, named) == NULL || strstr(message, "expected") == NULL)
        fail_msg("\"%s\" does not say \"%s\" and what was expected", message, named);
}
