/* libglint_preview.so names what it refuses: the thing, the place in it, what was found and what was expected. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "caller.h"

/* One member of a struct that gets another value. */
typedef struct change {
    size_t offset, size;
    const void *value;
} change;

#define SET(type, member, kind, ...)                                                                                   \
    {                                                                                                                  \
        offsetof(type, member), sizeof(kind), &(kind)                                                                  \
        {                                                                                                              \
            __VA_ARGS__                                                                                                \
        }                                                                                                              \
    }
#define SQUARE(member, kind, ...) SET(square_scene, member, kind, __VA_ARGS__)
#define CAMERA(member, kind, ...) SET(glint_preview_camera, member, kind, __VA_ARGS__)
#define PICTURE(member, kind, ...) SET(glint_preview_picture_options, member, kind, __VA_ARGS__)

/* What makes no sense of something that does, and what the message says. */
typedef struct bad_input {
    const char *says;
    change changes[3];
} bad_input;

static void spoil(void *good, const bad_input *by)
{
    for (int i = 0; i < 3; ++i) {
        if (by->changes[i].value != NULL)
            memcpy((char *)good + by->changes[i].offset, by->changes[i].value, by->changes[i].size);
    }
}

static void refuse_all(const bad_input *rows, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        square_scene q;
        make_square(&q);
        spoil(&q, &rows[i]);
        refuse(&q.options, rows[i].says);
    }
}

#define COUNT(rows) (sizeof(rows) / sizeof *(rows))

static void meshes_that_make_no_sense_are_named(void **state)
{
    (void)state;
    float not_a_number[12], endless[12];
    memcpy(not_a_number, SQUARE_POSITIONS, sizeof not_a_number);
    memcpy(endless, SQUARE_POSITIONS, sizeof endless);
    not_a_number[7] = NAN;
    endless[7] = INFINITY;
    const uint32_t far[6] = { 0, 1, 2, 0, 2, 4 };
    const int32_t materials[2] = { 0, 1 };
    const bad_input rows[] = {
        { "floor: /position/2",
          { SQUARE(mesh.positions, const float *, not_a_number), SQUARE(mesh.name, const char *, "floor") } },
        { "meshes/0: /normal/2", { SQUARE(mesh.normals, const float *, endless) } },
        { "/index/5: found 4", { SQUARE(mesh.indices, const uint32_t *, far) } },
        { "/material/1: found 1", { SQUARE(mesh.materials, const int32_t *, materials) } },
        { "/position: found none", { SQUARE(mesh.positions, const float *, NULL) } },
        { "meshes/0: its size is 8", { SQUARE(mesh.size, size_t, 8) } },
        { "no material", { SQUARE(options.materials, const char *, NULL) } },
    };
    refuse_all(rows, COUNT(rows));
}

static void instances_lights_and_worlds_that_make_no_sense_are_named(void **state)
{
    (void)state;
    float matrix[16];
    memcpy(matrix, IDENTITY, sizeof matrix);
    matrix[12] = NAN;
    const float map[9] = { 0 };
    const int32_t other[1] = { 1 };
    const bad_input rows[] = {
        { "instances/0: to_world", { SQUARE(options.instance_to_world, const float *, matrix) } },
        { "instances/0: found mesh 1", { SQUARE(options.instance_mesh, const int32_t *, other) } },
        { "instance_mesh: found NULL", { SQUARE(options.instance_mesh, const int32_t *, NULL) } },
        { "lights/0: kind is 9", { SQUARE(sun.kind, int32_t, 9) } },
        { "lights/0: found -1", { SQUARE(sun.intensity, float, -1.0F) } },
        { "inner_cone_rad is 1",
          { SQUARE(sun.kind, int32_t, GLINT_PREVIEW_LIGHT_SPOT), SQUARE(sun.inner_cone_rad, float, 1.0F) } },
        { "world: its map is 3 x 3",
          { SQUARE(options.world.map, const float *, map), SQUARE(options.world.map_width, int32_t, 3),
            SQUARE(options.world.map_height, int32_t, 3) } },
        { "model is 1000", { SQUARE(options.model, int32_t, 1000) } },
        { "options: its size is 1", { SQUARE(options.size, size_t, 1) } },
    };
    refuse_all(rows, COUNT(rows));
}

static void materials_and_images_that_make_no_sense_are_named(void **state)
{
    (void)state;
    const glint_preview_image empty = GLINT_PREVIEW_IMAGE_INIT;
    const bad_input rows[] = {
        { "expected an object", { SQUARE(options.materials, const char *, "[]") } },
        { "/materials/0/pbrMetallicRoughness/roughnessFactor",
          { SQUARE(options.materials, const char *,
                   "{\"materials\": [{\"pbrMetallicRoughness\": {\"roughnessFactor\": 2}}]}") } },
        { "/textures/0/source",
          { SQUARE(options.materials, const char *, "{\"materials\": [{}], \"textures\": [{\"source\": 0}]}") } },
        { "images/0: found none",
          { SQUARE(options.images, const glint_preview_image *, &empty), SQUARE(options.image_count, size_t, 1) } },
    };
    refuse_all(rows, COUNT(rows));
}

/* Not everything has something that was expected. */
static void broken_text_and_missing_files_are_named(void **state)
{
    (void)state;
    square_scene q;
    glint_preview_scene *s;
    char message[512];
    make_square(&q);
    q.options.materials = "{\"materials\": [";
    assert_int_equal(glint_preview_scene_create(&q.options, &s, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_non_null(strstr(message, "materials: line 1, column 16: found text that is not JSON"));
    glint_preview_image image = GLINT_PREVIEW_IMAGE_INIT;
    image.path = "/no/such/file.png";
    q.options.images = &image;
    q.options.image_count = 1;
    q.options.materials = "{\"materials\": [{\"normalTexture\": {\"index\": 0}}], \"textures\": [{\"source\": 0}]}";
    assert_int_equal(glint_preview_scene_create(&q.options, &s, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_non_null(strstr(message, "images/0: cannot be read"));
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

static void pictures_and_cameras_that_make_no_sense_are_named(void **state)
{
    (void)state;
    const bad_input pictures[] = {
        { "camera: found none", { PICTURE(camera, const glint_preview_camera *, NULL) } },
        { "width is 0", { PICTURE(width, int32_t, 0) } },
        { "spp is 100000", { PICTURE(samples, int32_t, 100000) } },
        { "tile_width is 9", { PICTURE(part_width, int32_t, 9), PICTURE(part_height, int32_t, 1) } },
        { "its size is 3", { PICTURE(size, size_t, 3) } },
        { "accuracy is 2", { PICTURE(accuracy, float, 2.0F) } },
    };
    const bad_input cameras[] = {
        { "expected left below right", { CAMERA(right, float, -1.0F) } },
        { "camera: to_world", { CAMERA(to_world, float, NAN) } },
        { "far_m", { CAMERA(far_m, float, 1.0F), CAMERA(near_m, float, 1.0F) } },
        { "projection is 2", { CAMERA(projection, int32_t, 2) } },
    };
    square_scene q;
    make_square(&q);
    glint_preview_scene *const s = create(&q.options);
    for (size_t i = 0; i < COUNT(pictures); ++i) {
        const glint_preview_camera camera = from_above(1.0F);
        glint_preview_picture_options o = small(&camera);
        spoil(&o, &pictures[i]);
        refuse_picture(s, &o, pictures[i].says);
    }
    for (size_t i = 0; i < COUNT(cameras); ++i) {
        glint_preview_camera camera = from_above(1.0F);
        spoil(&camera, &cameras[i]);
        const glint_preview_picture_options o = small(&camera);
        refuse_picture(s, &o, cameras[i].says);
    }
    glint_preview_scene_destroy(s);
}

static void what_a_picture_cannot_give_is_named(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(1.0F);
    glint_preview_picture_options o = small(&camera);
    o.passes = 0;
    glint_preview_picture *const p = begin(s, &o);
    const struct {
        int32_t pass;
        size_t count;
        const char *says;
    } rows[] = { { GLINT_PREVIEW_DEPTH, 64, "passes was 0" },
                 { GLINT_PREVIEW_COMBINED, 64, "expected 256" },
                 { 7, 64, "pass is 7" } };
    float values[256];
    char message[512];
    for (size_t i = 0; i < COUNT(rows); ++i) {
        assert_int_equal(glint_preview_picture_read(p, rows[i].pass, 1, values, rows[i].count, message, sizeof message),
                         GLINT_PREVIEW_BAD_INPUT);
        assert_non_null(strstr(message, rows[i].says));
    }
    assert_int_equal(glint_preview_picture_refine(p, 5, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_non_null(strstr(message, "samples is 5"));
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_that_make_no_sense_are_named),
        cmocka_unit_test(instances_lights_and_worlds_that_make_no_sense_are_named),
        cmocka_unit_test(materials_and_images_that_make_no_sense_are_named),
        cmocka_unit_test(broken_text_and_missing_files_are_named),
        cmocka_unit_test(pictures_and_cameras_that_make_no_sense_are_named),
        cmocka_unit_test(what_a_picture_cannot_give_is_named),
        cmocka_unit_test(nothing_at_all_is_an_answer_and_no_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
