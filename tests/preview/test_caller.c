/* libglint_preview.so as another program uses it: pictures that are known by hand, passes, failing input, no leaks. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "preview/glint_preview.h"

/* A square of 2 m in the plane y = 0, facing up, (s, t) from (0, 0) at (-1, -1) to (1, 1); two triangles. */
static const float POSITIONS[12] = { -1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1 };
static const float NORMALS[12] = { 0, 1, 0, 0, 2, 0, 0, 1, 0, 0, 1, 0 };
static const float TEXCOORDS[8] = { 0, 0, 0, 1, 1, 1, 1, 0 };
static const uint32_t INDICES[6] = { 0, 1, 2, 0, 2, 3 };
static const float IDENTITY[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
static const int32_t ZERO[1] = { 0 };

/* Diffuse and nothing else: f = color / pi. */
#define MATTE(color, more)                                                                                             \
    "{\"pbrMetallicRoughness\": {\"baseColorFactor\": [" color ", 1], \"metallicFactor\": 0" more                      \
    "}, \"extensions\": {\"KHR_materials_specular\": {\"specularFactor\": 0}}}"

/* Everything that a scene of one square needs, with a sun straight above. */
typedef struct square_scene {
    glint_preview_mesh mesh;
    glint_preview_light sun;
    glint_preview_scene_options options;
} square_scene;

static void make_square(square_scene *s)
{
    s->mesh = (glint_preview_mesh)GLINT_PREVIEW_MESH_INIT;
    s->mesh.vertex_count = 4;
    s->mesh.triangle_count = 2;
    s->mesh.positions = POSITIONS;
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

/* Orthographic, 4 m above, looking down; sees a square of 2 half_size; x to the right, z downwards. */
static glint_preview_camera from_above(float half_size)
{
    glint_preview_camera c = GLINT_PREVIEW_CAMERA_INIT;
    const float to_world[16] = { 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 4, 0, 1 };
    memcpy(c.to_world, to_world, sizeof to_world);
    c.projection = GLINT_PREVIEW_ORTHOGRAPHIC;
    c.left = c.bottom = -half_size;
    c.right = c.top = half_size;
    return c;
}

static glint_preview_picture_options small(const glint_preview_camera *camera)
{
    glint_preview_picture_options o = GLINT_PREVIEW_PICTURE_OPTIONS_INIT;
    o.camera = camera;
    o.width = o.height = 8;
    o.samples = 4;
    o.bounces = 0;
    o.threads = 1;
    return o;
}

static glint_preview_scene *create(const glint_preview_scene_options *o)
{
    glint_preview_scene *s;
    char message[512];
    if (glint_preview_scene_create(o, &s, message, sizeof message) != GLINT_PREVIEW_OK)
        fail_msg("no scene: %s", message);
    return s;
}

static glint_preview_picture *begin(const glint_preview_scene *s, const glint_preview_picture_options *o)
{
    glint_preview_picture *p;
    char message[512];
    if (glint_preview_picture_create(s, o, &p, message, sizeof message) != GLINT_PREVIEW_OK)
        fail_msg("no picture: %s", message);
    return p;
}

static void refine(glint_preview_picture *p, int32_t samples)
{
    char message[512];
    if (glint_preview_picture_refine(p, samples, message, sizeof message) != GLINT_PREVIEW_OK)
        fail_msg("not refined: %s", message);
}

static void get(const glint_preview_picture *p, int32_t pass, float *values, size_t count)
{
    char message[512];
    if (glint_preview_picture_read(p, pass, 1, values, count, message, sizeof message) != GLINT_PREVIEW_OK)
        fail_msg("not read: %s", message);
}

static void assert_relative(float value, double expected, double bound)
{
    if (!(fabs((double)value - expected) <= bound * fabs(expected)))
        fail_msg("%.9g is not %.9g", (double)value, expected);
}

/* ---- pictures that are known ---- */

/* E albedo / pi; single precision and cosines of a sun of half a degree around 1: (.00465)^2 / 4. */
static void a_matte_square_under_the_sun_has_the_radiance_of_lambert(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    glint_preview_scene *const s = create(&q.options);
    assert_string_equal(glint_preview_scene_warnings(s), "");
    const glint_preview_camera camera = from_above(0.9F);
    const glint_preview_picture_options o = small(&camera);
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 4);
    float rgba[256], normal[192], depth[64], albedo[192];
    get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
    get(p, GLINT_PREVIEW_NORMAL, normal, 192);
    get(p, GLINT_PREVIEW_ALBEDO, albedo, 192);
    get(p, GLINT_PREVIEW_DEPTH, depth, 64);
    const double color[3] = { 0.5, 0.25, 0.125 };
    for (size_t i = 0; i < 64; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            assert_relative(rgba[4 * i + c], 3.0 * color[c] / 3.14159265358979, 1e-4);
            assert_relative(albedo[3 * i + c], color[c], 1e-6);
        }
        assert_true(rgba[4 * i + 3] == 1.0F);
        assert_relative(normal[3 * i + 1], 1.0, 1e-6);
        assert_relative(depth[i], 4.0, 1e-6);
    }
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
}

static void what_surrounds_the_scene_is_seen_unless_it_is_transparent(void **state)
{
    (void)state;
    glint_preview_scene_options empty = GLINT_PREVIEW_SCENE_OPTIONS_INIT;
    empty.world.color[0] = 0.25F;
    empty.world.color[2] = 2.0F;
    glint_preview_scene *const s = create(&empty);
    const glint_preview_camera camera = from_above(1.0F);
    glint_preview_picture_options o = small(&camera);
    for (int transparent = 0; transparent < 2; ++transparent) {
        o.transparent = transparent;
        glint_preview_picture *const p = begin(s, &o);
        refine(p, 4);
        float rgba[256];
        get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
        assert_true(rgba[0] == (transparent ? 0.0F : 0.25F) && rgba[2] == (transparent ? 0.0F : 2.0F));
        assert_true(rgba[3] == (transparent ? 0.0F : 1.0F));
        glint_preview_picture_destroy(p);
    }
    glint_preview_scene_destroy(s);
}

/* Red above the horizon, green below, and blue in the quarter around +x: a camera that looks down sees green. */
static void a_map_lies_as_the_header_says(void **state)
{
    (void)state;
    float map[3 * 16 * 8] = { 0 };
    for (size_t y = 0; y < 8; ++y)
        for (size_t x = 0; x < 16; ++x) {
            map[3 * (16 * y + x) + (y < 4 ? 0 : 1)] = 1.0F;
            map[3 * (16 * y + x) + 2] = x >= 6 && x < 10 ? 1.0F : 0.0F;
        }
    glint_preview_scene_options empty = GLINT_PREVIEW_SCENE_OPTIONS_INIT;
    empty.world.map = map;
    empty.world.map_width = 16;
    empty.world.map_height = 8;
    glint_preview_scene *const s = create(&empty);
    /* z of the camera against the view: it looks along -y, +x and -x. */
    const float views[3][16] = { { 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1 },
                                 { 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1 },
                                 { 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1 } };
    const float expected[3][3] = { { 0, 1, -1 }, { -1, -1, 1 }, { -1, -1, 0 } }; /* -1: either */
    for (int v = 0; v < 3; ++v) {
        glint_preview_camera camera = GLINT_PREVIEW_CAMERA_INIT;
        memcpy(camera.to_world, views[v], sizeof views[v]);
        camera.left = camera.bottom = -0.01F;
        camera.right = camera.top = 0.01F;
        const glint_preview_picture_options o = small(&camera);
        glint_preview_picture *const p = begin(s, &o);
        refine(p, 1);
        float rgba[256];
        get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
        for (size_t c = 0; c < 3; ++c)
            if (expected[v][c] >= 0.0F)
                assert_true(fabsf(rgba[c] - expected[v][c]) < 1e-3F);
        glint_preview_picture_destroy(p);
    }
    glint_preview_scene_destroy(s);
}

/* Half red, half green by texels; each triangle of the other square has a material of its own. */
static void textures_and_materials_of_triangles_are_where_they_belong(void **state)
{
    (void)state;
    const float pixels[8] = { 1, 0, 0, 1, 0, 1, 0, 1 };
    glint_preview_image image = GLINT_PREVIEW_IMAGE_INIT;
    image.pixels = pixels;
    image.width = 2;
    image.height = 1;
    const int32_t materials[2] = { 0, 1 };
    square_scene q;
    make_square(&q);
    q.options.images = &image;
    q.options.image_count = 1;
    q.options.materials =
        "{\"samplers\": [{\"magFilter\": 9728}], \"textures\": [{\"source\": 0, \"sampler\": 0}], \"materials\": "
        "[" MATTE("1, 1, 1", ", \"baseColorTexture\": {\"index\": 0}") ", " MATTE("0, 0, 1", "") "]}";
    const glint_preview_camera camera = from_above(1.0F);
    const glint_preview_picture_options o = small(&camera);
    for (int two = 0; two < 2; ++two) {
        q.mesh.materials = two ? materials : NULL;
        glint_preview_scene *const s = create(&q.options);
        glint_preview_picture *const p = begin(s, &o);
        refine(p, 4);
        float rgba[256];
        get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
        const float *const lower_left = rgba, *const upper_right = &rgba[4 * 63]; /* the lowest row comes first */
        assert_true(lower_left[0] > 0.9F && lower_left[1] == 0.0F && lower_left[2] == 0.0F);
        assert_true(upper_right[0] == 0.0F && upper_right[two ? 2 : 1] > 0.9F && upper_right[two ? 1 : 2] == 0.0F);
        glint_preview_picture_destroy(p);
        glint_preview_scene_destroy(s);
    }
}

static void a_shifted_window_sees_the_next_part_of_the_plane(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    glint_preview_scene *const s = create(&q.options);
    glint_preview_camera camera = from_above(1.0F);
    camera.left = 0.0F; /* half of it beyond the edge at x = 1 */
    camera.right = 2.0F;
    const glint_preview_picture_options o = small(&camera);
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 4);
    float depth[64];
    get(p, GLINT_PREVIEW_DEPTH, depth, 64);
    for (size_t i = 0; i < 64; ++i)
        assert_true((depth[i] > 0.0F) == (i % 8 < 4));
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
}

/* ---- glints, passes and threads ---- */

static const char GLITTER[] =
    "{\"materials\": [{\"pbrMetallicRoughness\": {\"roughnessFactor\": 0.5}, \"extensions\": "
    "{\"GLINT_materials_glint\": {\"glintFactor\": 1, \"glintDensity\": 2500, \"glintFacetRoughness\": 0.05}}}]}";

static void flakes_are_counted_in_the_pass_for_it(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    q.options.materials = GLITTER; /* one unit of (s, t) is a metre, and half a metre of the square */
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(0.8F);
    const glint_preview_picture_options o = small(&camera);
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 4);
    float count[64], probability[64], smooth[192], rgba[256];
    get(p, GLINT_PREVIEW_GLINT_COUNT, count, 64);
    get(p, GLINT_PREVIEW_GLINT_PROBABILITY, probability, 64);
    get(p, GLINT_PREVIEW_SMOOTH, smooth, 192);
    get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
    double differs = 0.0;
    for (size_t i = 0; i < 64; ++i) {
        assert_relative(count[i], 2500.0 * 0.1 * 0.1, 0.05); /* a pixel is .2 m of the square: .1 of (s, t) */
        assert_true(probability[i] >= 0.0F && probability[i] <= 1.0F);
        differs += fabs((double)(rgba[4 * i] - smooth[3 * i]));
    }
    assert_true(differs > 0.0);
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
}

static void steps_of_any_size_give_the_same_bits(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    q.options.materials = GLITTER;
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(0.8F);
    glint_preview_picture_options o = small(&camera);
    o.samples = 13;
    glint_preview_picture *const once = begin(s, &o), *const steps = begin(s, &o);
    refine(once, 13);
    for (int samples = 1; samples <= 13; samples += 3)
        refine(steps, samples);
    float a[256], b[256];
    get(once, GLINT_PREVIEW_COMBINED, a, 256);
    get(steps, GLINT_PREVIEW_COMBINED, b, 256);
    assert_memory_equal(a, b, sizeof a);
    assert_true(glint_preview_picture_progress(steps) == 1.0);
    glint_preview_picture_destroy(once);
    glint_preview_picture_destroy(steps);
    glint_preview_scene_destroy(s);
}

typedef struct long_work {
    glint_preview_picture *picture;
    glint_preview_result result;
} long_work;

static void *refine_for_long(void *argument)
{
    long_work *const work = argument;
    work->result = glint_preview_picture_refine(work->picture, 65536, NULL, 0);
    return NULL;
}

static void cancelling_from_another_thread_ends_soon_and_can_be_taken_back(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    q.options.materials = GLITTER;
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(0.8F);
    glint_preview_picture_options o = small(&camera);
    o.width = o.height = 256;
    o.samples = 65536; /* minutes */
    glint_preview_picture *const p = begin(s, &o);
    pthread_t thread;
    long_work work = { p, GLINT_PREVIEW_OK };
    assert_int_equal(pthread_create(&thread, NULL, refine_for_long, &work), 0);
    glint_preview_picture_cancel(p, 1);
    pthread_join(thread, NULL);
    assert_int_equal(work.result, GLINT_PREVIEW_CANCELLED);
    assert_int_equal(glint_preview_picture_refine(p, 1, NULL, 0), GLINT_PREVIEW_CANCELLED);
    glint_preview_picture_destroy(p);
    o.width = o.height = 8;
    glint_preview_picture *const again = begin(s, &o);
    glint_preview_picture_cancel(again, 1);
    assert_int_equal(glint_preview_picture_refine(again, 2, NULL, 0), GLINT_PREVIEW_CANCELLED);
    glint_preview_picture_cancel(again, 0);
    refine(again, 2);
    glint_preview_picture_destroy(again);
    glint_preview_scene_destroy(s);
}

/* ---- failing input ---- */

static void refuse(const glint_preview_scene_options *o, const char *named)
{
    static char elsewhere;
    glint_preview_scene *s = (void *)&elsewhere;
    char message[512] = "";
    assert_int_equal(glint_preview_scene_create(o, &s, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_null(s);
    if (strstr(message, named) == NULL || strstr(message, "expected") == NULL)
        fail_msg("\"%s\" does not say \"%s\" and what was expected", message, named);
}

static void meshes_that_make_no_sense_are_named(void **state)
{
    (void)state;
    square_scene q;
    float bad[12];
    memcpy(bad, POSITIONS, sizeof bad);
    bad[7] = NAN;
    make_square(&q);
    q.mesh.positions = bad;
    q.mesh.name = "floor";
    refuse(&q.options, "floor: /position/2");
    bad[7] = INFINITY;
    make_square(&q);
    q.mesh.normals = bad;
    refuse(&q.options, "meshes/0: /normal/2");
    uint32_t far[6] = { 0, 1, 2, 0, 2, 4 };
    make_square(&q);
    q.mesh.indices = far;
    refuse(&q.options, "/index/5: found 4");
    const int32_t materials[2] = { 0, 1 };
    make_square(&q);
    q.mesh.materials = materials;
    refuse(&q.options, "/material/1: found 1");
    make_square(&q);
    q.mesh.positions = NULL;
    refuse(&q.options, "/position: found none");
    make_square(&q);
    q.mesh.size = 8;
    refuse(&q.options, "meshes/0: its size is 8");
    make_square(&q);
    q.options.materials = NULL;
    refuse(&q.options, "no material");
}

static void instances_lights_and_worlds_that_make_no_sense_are_named(void **state)
{
    (void)state;
    square_scene q;
    float matrix[16];
    memcpy(matrix, IDENTITY, sizeof matrix);
    matrix[12] = NAN;
    make_square(&q);
    q.options.instance_to_world = matrix;
    refuse(&q.options, "instances/0: to_world");
    const int32_t other[1] = { 1 };
    make_square(&q);
    q.options.instance_mesh = other;
    refuse(&q.options, "instances/0: found mesh 1");
    make_square(&q);
    q.options.instance_mesh = NULL;
    refuse(&q.options, "instance_mesh: found NULL");
    make_square(&q);
    q.sun.kind = 9;
    refuse(&q.options, "lights/0: kind is 9");
    make_square(&q);
    q.sun.intensity = -1.0F;
    refuse(&q.options, "lights/0: found -1");
    make_square(&q);
    q.sun.kind = GLINT_PREVIEW_LIGHT_SPOT;
    q.sun.inner_cone_rad = 1.0F;
    refuse(&q.options, "inner_cone_rad is 1");
    make_square(&q);
    float map[9] = { 0 };
    q.options.world.map = map;
    q.options.world.map_width = q.options.world.map_height = 3;
    refuse(&q.options, "world: its map is 3 x 3");
    make_square(&q);
    q.options.model = 1000;
    refuse(&q.options, "model is 1000");
    make_square(&q);
    q.options.size = 1;
    refuse(&q.options, "options: its size is 1");
}

static void materials_and_images_that_make_no_sense_are_named(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    q.options.materials = "{\"materials\": [";
    glint_preview_scene *s;
    char message[512];
    assert_int_equal(glint_preview_scene_create(&q.options, &s, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_non_null(strstr(message, "materials: line 1, column 16: found text that is not JSON"));
    q.options.materials = "[]";
    refuse(&q.options, "expected an object");
    q.options.materials = "{\"materials\": [{\"pbrMetallicRoughness\": {\"roughnessFactor\": 2}}]}";
    refuse(&q.options, "/materials/0/pbrMetallicRoughness/roughnessFactor");
    q.options.materials = "{\"materials\": [{}], \"textures\": [{\"source\": 0}]}";
    refuse(&q.options, "/textures/0/source");
    glint_preview_image image = GLINT_PREVIEW_IMAGE_INIT;
    q.options.images = &image;
    q.options.image_count = 1;
    refuse(&q.options, "images/0: found none");
    image.path = "/no/such/file.png";
    q.options.materials = "{\"materials\": [{\"normalTexture\": {\"index\": 0}}], \"textures\": [{\"source\": 0}]}";
    assert_int_equal(glint_preview_scene_create(&q.options, &s, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_non_null(strstr(message, "images/0"));
}

static void refuse_picture(const glint_preview_scene *s, const glint_preview_picture_options *o, const char *named)
{
    static char elsewhere;
    glint_preview_picture *p = (void *)&elsewhere;
    char message[512] = "";
    assert_int_equal(glint_preview_picture_create(s, o, &p, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_null(p);
    if (strstr(message, named) == NULL)
        fail_msg("\"%s\" does not say \"%s\"", message, named);
}

static void pictures_that_make_no_sense_are_named(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    glint_preview_scene *const s = create(&q.options);
    glint_preview_camera camera = from_above(1.0F);
    glint_preview_picture_options o = small(NULL);
    refuse_picture(s, &o, "camera: found none");
    o = small(&camera);
    o.width = 0;
    refuse_picture(s, &o, "width is 0");
    o = small(&camera);
    o.samples = 100000;
    refuse_picture(s, &o, "spp is 100000");
    o = small(&camera);
    o.part_width = 9;
    o.part_height = 1;
    refuse_picture(s, &o, "tile_width is 9");
    o = small(&camera);
    o.size = 3;
    refuse_picture(s, &o, "its size is 3");
    camera.right = camera.left;
    o = small(&camera);
    refuse_picture(s, &o, "expected left below right");
    camera = from_above(1.0F);
    camera.to_world[3] = NAN;
    refuse_picture(s, &o, "camera: to_world");
    camera = from_above(1.0F);
    camera.far_m = camera.near_m = 1.0F;
    refuse_picture(s, &o, "far_m");
    camera = from_above(1.0F);
    o.passes = 0;
    glint_preview_picture *const p = begin(s, &o);
    char message[512];
    float values[256];
    assert_int_equal(glint_preview_picture_read(p, GLINT_PREVIEW_DEPTH, 1, values, 64, message, sizeof message),
                     GLINT_PREVIEW_BAD_INPUT);
    assert_non_null(strstr(message, "passes was 0"));
    assert_int_equal(glint_preview_picture_read(p, GLINT_PREVIEW_COMBINED, 1, values, 64, message, sizeof message),
                     GLINT_PREVIEW_BAD_INPUT);
    assert_non_null(strstr(message, "expected 256"));
    assert_int_equal(glint_preview_picture_read(p, 7, 1, values, 64, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_int_equal(glint_preview_picture_refine(p, 5, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
}

static void nothing_at_all_is_an_answer_and_no_crash(void **state)
{
    (void)state;
    glint_preview_scene *s;
    glint_preview_picture *p;
    char message[8];
    assert_int_equal(glint_preview_scene_create(NULL, &s, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_int_equal(strlen(message), 7); /* cut to its size */
    assert_int_equal(glint_preview_scene_create(NULL, NULL, NULL, 0), GLINT_PREVIEW_BAD_INPUT);
    assert_int_equal(glint_preview_picture_create(NULL, NULL, &p, NULL, 0), GLINT_PREVIEW_BAD_INPUT);
    assert_int_equal(glint_preview_picture_refine(NULL, 1, NULL, 0), GLINT_PREVIEW_BAD_INPUT);
    assert_int_equal(glint_preview_picture_read(NULL, 0, 0, NULL, 0, NULL, 0), GLINT_PREVIEW_BAD_INPUT);
    glint_preview_picture_cancel(NULL, 1);
    assert_true(glint_preview_picture_progress(NULL) == 0.0);
    glint_preview_picture_destroy(NULL);
    glint_preview_scene_destroy(NULL);
    assert_string_equal(glint_preview_scene_warnings(NULL), "");
}

static void a_caller_can_check_that_it_speaks_the_same_language(void **state)
{
    (void)state;
    assert_int_equal(glint_preview_abi(), GLINT_PREVIEW_ABI);
    assert_int_equal(glint_preview_size_of("glint_preview_mesh"), sizeof(glint_preview_mesh));
    assert_int_equal(glint_preview_size_of("glint_preview_camera"), sizeof(glint_preview_camera));
    assert_int_equal(glint_preview_size_of("glint_preview_horse"), 0);
    assert_int_equal(glint_preview_size_of(NULL), 0);
}

/* ---- memory ---- */

#define GRID 200 /* 200 x 200 squares: half a megabyte of positions, and more of anything else */

typedef struct grid {
    float positions[3 * (GRID + 1) * (GRID + 1)], texcoords[2 * (GRID + 1) * (GRID + 1)];
    uint32_t indices[6 * GRID * GRID];
} grid;

static void make_grid(grid *g)
{
    for (uint32_t y = 0; y <= GRID; ++y)
        for (uint32_t x = 0; x <= GRID; ++x) {
            const size_t at = y * (GRID + 1) + x;
            const float u = (float)x / GRID, v = (float)y / GRID;
            const float position[3] = { 2.0F * u - 1.0F, 0.0F, 2.0F * v - 1.0F };
            memcpy(&g->positions[3 * at], position, sizeof position);
            g->texcoords[2 * at] = u;
            g->texcoords[2 * at + 1] = v;
        }
    for (uint32_t i = 0; i < GRID * GRID; ++i) {
        const uint32_t corner = i / GRID * (GRID + 1) + i % GRID;
        const uint32_t six[6] = { corner, corner + GRID + 1, corner + GRID + 2, corner, corner + GRID + 2, corner + 1 };
        memcpy(&g->indices[6 * (size_t)i], six, sizeof six);
    }
}

static double resident_mb(void)
{
    unsigned long long pages = 0, resident = 0;
    FILE *const file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%llu %llu", &pages, &resident), 2);
    fclose(file);
    return (double)resident * (double)sysconf(_SC_PAGESIZE) / 1048576.0;
}

/* A scene, a picture and a failure. */
static void use_the_library(const grid *g)
{
    square_scene q;
    make_square(&q);
    q.options.materials = GLITTER;
    q.mesh.vertex_count = (GRID + 1) * (GRID + 1);
    q.mesh.triangle_count = 2 * GRID * GRID;
    q.mesh.positions = g->positions;
    q.mesh.normals = NULL;
    q.mesh.texcoords[0] = g->texcoords;
    q.mesh.indices = g->indices;
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(1.0F);
    const glint_preview_picture_options o = small(&camera);
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 1);
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
    q.options.model = 1000; /* found after everything else was copied */
    refuse(&q.options, "model is 1000");
}

/* Had a round lost one of its arrays (.5 MB and more), 32 rounds would show 15 MB; less than that is allowed for the
 * allocator's own pieces. The sanitizers' own bookkeeping grows: there, their search for leaks is the test. */
static void scenes_and_pictures_leave_no_memory_behind(void **state)
{
    (void)state;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip();
#endif
    static grid g;
    make_grid(&g);
    for (int i = 0; i < 4; ++i)
        use_the_library(&g);
    const double before = resident_mb();
    for (int i = 0; i < 32; ++i)
        use_the_library(&g);
    const double after = resident_mb();
    if (!(after - before < 12.0))
        fail_msg("32 scenes took %.1f MB and did not give them back", after - before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matte_square_under_the_sun_has_the_radiance_of_lambert),
        cmocka_unit_test(what_surrounds_the_scene_is_seen_unless_it_is_transparent),
        cmocka_unit_test(a_map_lies_as_the_header_says),
        cmocka_unit_test(textures_and_materials_of_triangles_are_where_they_belong),
        cmocka_unit_test(a_shifted_window_sees_the_next_part_of_the_plane),
        cmocka_unit_test(flakes_are_counted_in_the_pass_for_it),
        cmocka_unit_test(steps_of_any_size_give_the_same_bits),
        cmocka_unit_test(cancelling_from_another_thread_ends_soon_and_can_be_taken_back),
        cmocka_unit_test(meshes_that_make_no_sense_are_named),
        cmocka_unit_test(instances_lights_and_worlds_that_make_no_sense_are_named),
        cmocka_unit_test(materials_and_images_that_make_no_sense_are_named),
        cmocka_unit_test(pictures_that_make_no_sense_are_named),
        cmocka_unit_test(nothing_at_all_is_an_answer_and_no_crash),
        cmocka_unit_test(a_caller_can_check_that_it_speaks_the_same_language),
        cmocka_unit_test(scenes_and_pictures_leave_no_memory_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
