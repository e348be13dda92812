/* Scenes that move: keyframes against closed forms, and what is refused. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_case.h"
#include "io/scene_motion.h"

#define PI 3.14159265358979323846

/* A file whose node 0 moves by one sampler; a camera and a light hang on its child. */
typedef struct moving {
    const char *path, *interpolation, *type; /* type: VEC3, VEC4 */
    int component_type;                      /* 5126 float, 5122 short */
    const float *times;
    size_t key_count;
    const void *values;
    size_t value_count, value_size; /* elements, bytes of all */
    const char *node, *more;        /* further members of node 0, of the file */
} moving;

#define COUNT(array) (sizeof(array) / sizeof *(array))

static void write_moving(gltf_case *c, const moving *m)
{
    static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    char bytes[4096];
    const size_t times_size = m->key_count * sizeof(float), total = sizeof triangle + times_size + m->value_size;
    assert_true(total <= sizeof bytes);
    memcpy(bytes, triangle, sizeof triangle);
    memcpy(bytes + sizeof triangle, m->times, times_size);
    memcpy(bytes + sizeof triangle + times_size, m->values, m->value_size);
    gltf_case_json_with_buffer(
        c, bytes, total,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }, { 'buffer': 0, 'byteOffset': 36, 'byteLength': %zu },"
        "  { 'buffer': 0, 'byteOffset': %zu, 'byteLength': %zu }],"
        "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
        "  { 'bufferView': 1, 'componentType': 5126, 'count': %zu, 'type': 'SCALAR' },"
        "  { 'bufferView': 2, 'componentType': %d, 'normalized': %s, 'count': %zu, 'type': '%s' }],"
        "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0 } }] }],"
        "'cameras': [{ 'type': 'perspective', 'perspective': { 'yfov': 1, 'znear': 0.1 } }],"
        "'extensions': { 'KHR_lights_punctual': { 'lights': [{ 'type': 'point' }] } },"
        "'nodes': [{ 'mesh': 0, 'children': [1] %s }, { 'camera': 0, 'translation': [0, 0, 5],"
        "  'extensions': { 'KHR_lights_punctual': { 'light': 0 } } }],"
        "'animations': [{ 'name': 'Move', 'samplers': [{ 'input': 1, 'output': 2, 'interpolation': '%s' }],"
        "  'channels': [{ 'sampler': 0, 'target': { 'node': 0, 'path': '%s' } }] }] %s",
        times_size, sizeof triangle + times_size, m->value_size, m->key_count, m->component_type,
        m->component_type == 5126 ? "false" : "true", m->value_count, m->type, m->node ? m->node : "", m->interpolation,
        m->path, m->more ? m->more : "");
}

static bool open_motion(gltf_case *c, const char *animation, scene_motion **motion)
{
    gltf_case_read(c); /* a fresh report; a file whose animations are broken may well be read at rest */
    scene_free(&c->scene);
    c->said.error[0] = c->warnings[0] = '\0';
    return scene_motion_open(c->path, NULL, animation, &c->scene, motion, &c->said);
}

static scene_motion *opened(gltf_case *c, const char *animation)
{
    scene_motion *motion;
    if (!open_motion(c, animation, &motion))
        fail_msg("refused: %s", c->said.error);
    return motion;
}

static void pose(gltf_case *c, scene_motion *motion, double time_s)
{
    if (!scene_motion_pose(motion, time_s, &c->scene, &c->said))
        fail_msg("no pose: %s", c->said.error);
}

/* Single precision of the files and of the scene: some roundings of numbers below 16. */
#define NEAR 4e-6

static void assert_near(double found, double expected, const char *what, double at)
{
    if (!(fabs(found - expected) <= NEAR))
        fail_msg("%s at %g s is %.9g, expected %.9g", what, at, found, expected);
}

static void assert_moved(const float to_world[16], double x, double y, double z, double at)
{
    assert_near((double)to_world[12], x, "x", at);
    assert_near((double)to_world[13], y, "y", at);
    assert_near((double)to_world[14], z, "z", at);
}

/* A turn about z. */
static void assert_turned(const float to_world[16], double angle, double at)
{
    assert_near((double)to_world[0], cos(angle), "cosine", at);
    assert_near((double)to_world[1], sin(angle), "sine", at);
    assert_near((double)to_world[10], 1.0, "z of z", at);
}

static const float two_times[] = { 0.5F, 2.5F };

static void linear_keys_are_met_by_straight_lines_and_held_outside(void **state)
{
    gltf_case *c = *state;
    static const float values[] = { 1, 2, 3, 5, -2, 3 };
    write_moving(c, &(moving){ "translation", "LINEAR", "VEC3", 5126, two_times, 2, values, 2, sizeof values, 0, 0 });
    scene_motion *const motion = opened(c, NULL);
    assert_near(scene_motion_end_s(motion), 2.5, "end", 0.0);
    assert_moved(c->scene.instances[0].to_world, 0, 0, 0, -1); /* at rest */
    static const double times[] = { 0.0, 0.5, 1.0, 2.25, 2.5, 1e9 };
    for (size_t i = 0; i < COUNT(times); i++) {
        const double t = fmin(fmax((times[i] - 0.5) / 2.0, 0.0), 1.0);
        pose(c, motion, times[i]);
        assert_moved(c->scene.instances[0].to_world, 1 + 4 * t, 2 - 4 * t, 3, times[i]);
        /* What hangs on the node goes along, and the bounds follow. */
        assert_moved(c->scene.cameras[0].to_world, 1 + 4 * t, 2 - 4 * t, 8, times[i]);
        assert_moved(c->scene.lights[0].to_world, 1 + 4 * t, 2 - 4 * t, 8, times[i]);
        assert_near((double)c->scene.bounds_min[0], 1 + 4 * t, "least x", times[i]);
        assert_near((double)c->scene.bounds_max[1], 3 - 4 * t, "greatest y", times[i]);
        assert_int_equal(c->scene.instance_count, 1);
    }
    scene_motion_close(motion);
}

static void steps_jump_at_their_keys(void **state)
{
    gltf_case *c = *state;
    static const float values[] = { 1, 0, 0, 2, 0, 0 };
    write_moving(c, &(moving){ "translation", "STEP", "VEC3", 5126, two_times, 2, values, 2, sizeof values, 0, 0 });
    scene_motion *const motion = opened(c, NULL);
    static const double at[][2] = { { 0, 1 }, { 0.5, 1 }, { 2.4999, 1 }, { 2.5, 2 }, { 3, 2 } };
    for (size_t i = 0; i < COUNT(at); i++) {
        pose(c, motion, at[i][0]);
        assert_moved(c->scene.instances[0].to_world, at[i][1], 0, 0, at[i][0]);
    }
    scene_motion_close(motion);
}

/* Between turns about one axis the angle runs evenly, the shorter way round, whatever the sign of a quaternion. */
static void linear_rotations_run_evenly_the_shorter_way(void **state)
{
    gltf_case *c = *state;
    static const double angles[][2] = { { 0.0, 0.5 * PI }, { 0.2, 3.0 }, { 0.0, 1.5 * PI }, { 1.0, 1.0 + 1e-4 } };
    for (size_t i = 0; i < COUNT(angles); i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double from = angles[i][0], to = angles[i][1];
            const double way = to - from > PI ? to - from - 2.0 * PI : to - from;
            const float values[] = { 0, 0, (float)sin(from / 2),        (float)cos(from / 2),
                                     0, 0, (float)(sign * sin(to / 2)), (float)(sign * cos(to / 2)) };
            write_moving(c,
                         &(moving){ "rotation", "LINEAR", "VEC4", 5126, two_times, 2, values, 2, sizeof values, 0, 0 });
            scene_motion *const motion = opened(c, NULL);
            for (int k = 0; k <= 6; k++) {
                pose(c, motion, 0.5 + k / 3.0);
                assert_turned(c->scene.instances[0].to_world, from + way * k / 6.0, 0.5 + k / 3.0);
            }
            scene_motion_close(motion);
        }
}

/* sin and cos of 45 degrees in 15 bits: off by 2e-5, but equal. */
static void rotations_may_be_normalized_integers(void **state)
{
    gltf_case *c = *state;
    static const int16_t values[] = { 0, 0, 0, 32767, 0, 0, 23170, 23170 };
    write_moving(c, &(moving){ "rotation", "LINEAR", "VEC4", 5122, two_times, 2, values, 2, sizeof values, 0, 0 });
    scene_motion *const motion = opened(c, NULL);
    pose(c, motion, 0.5 + 2.0 / 3.0);
    assert_turned(c->scene.instances[0].to_world, PI / 6.0, 0.5 + 2.0 / 3.0);
    scene_motion_close(motion);
}

static double cubic(double t)
{
    return 0.5 * t * t * t - 2.0 * t * t + t + 1.0;
}

static double cubic_slope(double t)
{
    return 1.5 * t * t - 4.0 * t + 1.0;
}

/* A spline with a cubic's values and slopes at its keys is that cubic. The steps differ: slopes are per second. */
static void splines_reproduce_cubics(void **state)
{
    gltf_case *c = *state;
    static const float times[] = { 0.0F, 0.5F, 3.0F };
    float values[27] = { 0 };
    for (size_t k = 0; k < 3; k++) {
        const double t = (double)times[k];
        values[9 * k] = values[9 * k + 6] = (float)cubic_slope(t); /* in and out */
        values[9 * k + 3] = (float)cubic(t);
    }
    write_moving(c, &(moving){ "scale", "CUBICSPLINE", "VEC3", 5126, times, 3, values, 9, sizeof values, 0, 0 });
    /* A scale of (p, 0, 0) flattens the mesh; the camera below it keeps the matrix. */
    scene_motion *const motion = opened(c, NULL);
    for (int i = 0; i <= 12; i++) {
        pose(c, motion, 0.25 * i);
        assert_near((double)c->scene.cameras[0].to_world[0], cubic(0.25 * i), "the cubic", 0.25 * i);
    }
    scene_motion_close(motion);
}

/* With tangents of zero the parts go from a to b by s = 3 t^2 - 2 t^3, and the angle is that of the mixed quaternion.
 */
static void rotations_by_splines_are_of_unit_length(void **state)
{
    gltf_case *c = *state;
    float values[24] = { 0 };
    const double to = 2.0;
    values[7] = 1.0F;
    values[18] = (float)sin(to / 2);
    values[19] = (float)cos(to / 2);
    write_moving(c, &(moving){ "rotation", "CUBICSPLINE", "VEC4", 5126, two_times, 2, values, 6, sizeof values, 0, 0 });
    scene_motion *const motion = opened(c, NULL);
    for (int i = 0; i <= 8; i++) {
        const double t = i / 8.0, s = t * t * (3.0 - 2.0 * t);
        pose(c, motion, 0.5 + 2.0 * t);
        assert_turned(c->scene.instances[0].to_world, 2.0 * atan2(s * sin(to / 2), 1.0 - s + s * cos(to / 2)),
                      0.5 + 2.0 * t);
    }
    scene_motion_close(motion);
}

/* From a quaternion to its opposite a spline passes through zero, which is no turn at all. */
static void spline_through_zero_still_gives_a_pose(void **state)
{
    gltf_case *c = *state;
    float values[24] = { 0 };
    values[7] = 1.0F;
    values[19] = -1.0F;
    write_moving(c, &(moving){ "rotation", "CUBICSPLINE", "VEC4", 5126, two_times, 2, values, 6, sizeof values, 0, 0 });
    scene_motion *const motion = opened(c, NULL);
    pose(c, motion, 1.5);
    assert_turned(c->scene.instances[0].to_world, 0.0, 1.5);
    scene_motion_close(motion);
}

/* How exporters hide things for a while. */
static void mesh_that_is_scaled_to_nothing_comes_back(void **state)
{
    gltf_case *c = *state;
    static const float times[] = { 0, 1, 2 }, values[] = { 1, 1, 1, 0, 0, 0, 2, 2, 2 };
    write_moving(c, &(moving){ "scale", "STEP", "VEC3", 5126, times, 3, values, 3, sizeof values, 0, 0 });
    scene_motion *const motion = opened(c, NULL);
    static const int counts[] = { 1, 0, 1 };
    for (int i = 0; i < 3; i++) {
        pose(c, motion, i);
        assert_int_equal(c->scene.instance_count, counts[i]);
    }
    assert_near((double)c->scene.bounds_max[0], 2.0, "width", 2.0);
    gltf_case_warned(c, "/nodes/0: is scaled to nothing");
    scene_motion_close(motion);
}

static void pose_depends_on_its_time_alone(void **state)
{
    gltf_case *c = *state;
    static const float values[] = { 0, 0, 0, 1, 0.6F, 0, 0, 0.8F };
    write_moving(c, &(moving){ "rotation", "LINEAR", "VEC4", 5126, two_times, 2, values, 2, sizeof values, 0, 0 });
    scene_motion *const motion = opened(c, NULL);
    float first[16];
    pose(c, motion, 1.3);
    memcpy(first, c->scene.cameras[0].to_world, sizeof first);
    for (int i = 0; i < 1000; i++) /* far more often than the file's bytes account for, were they counted each time */
        pose(c, motion, 0.01 * i);
    pose(c, motion, 1.3);
    assert_memory_equal(first, c->scene.cameras[0].to_world, sizeof first);
    scene_motion_close(motion);
}

static void sparse_keys_are_put_in_place(void **state)
{
    gltf_case *c = *state;
    /* Times, then all zero but the second key. */
    static const struct {
        float times[3], value[3];
        uint8_t index, padding[3];
    } bytes = { { 0, 1, 2 }, { 4, 5, 6 }, 1, { 0 } };
    gltf_case_json_with_buffer(
        c, &bytes, sizeof bytes,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 12 }, { 'buffer': 0, 'byteOffset': 12, 'byteLength': 12 },"
        "  { 'buffer': 0, 'byteOffset': 24, 'byteLength': 1 }],"
        "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'SCALAR' },"
        "  { 'componentType': 5126, 'count': 3, 'type': 'VEC3', 'sparse': { 'count': 1,"
        "    'indices': { 'bufferView': 2, 'componentType': 5121 }, 'values': { 'bufferView': 1 } } }],"
        "'cameras': [{ 'type': 'perspective', 'perspective': { 'yfov': 1, 'znear': 0.1 } }],"
        "'nodes': [{ 'camera': 0 }],"
        "'animations': [{ 'samplers': [{ 'input': 0, 'output': 1 }],"
        "  'channels': [{ 'sampler': 0, 'target': { 'node': 0, 'path': 'translation' } }] }]");
    scene_motion *const motion = opened(c, NULL);
    pose(c, motion, 1.5);
    assert_moved(c->scene.cameras[0].to_world, 2, 2.5, 3, 1.5);
    scene_motion_close(motion);
}

/* ---- what is played ---- */

static const float line[] = { 0, 0, 0, 1, 0, 0 };

/* Writes several animations in place of the one; nodes 2 and 3 are a mesh that may have weights, and a joint. */
static void write_animations(gltf_case *c, const char *animations)
{
    static const struct {
        float triangle[9], times[2], values[6];
    } bytes = { { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 1 }, { 0, 0, 0, 1, 0, 0 } };
    gltf_case_json_with_buffer(
        c, &bytes, sizeof bytes,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }, { 'buffer': 0, 'byteOffset': 36, 'byteLength': 8 },"
        "  { 'buffer': 0, 'byteOffset': 44, 'byteLength': 24 }],"
        "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
        "  { 'bufferView': 1, 'componentType': 5126, 'count': 2, 'type': 'SCALAR' },"
        "  { 'bufferView': 2, 'componentType': 5126, 'count': 2, 'type': 'VEC3' }],"
        "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0 } }] }],"
        "'nodes': [{ 'mesh': 0 }, { 'mesh': 0 }, { 'mesh': 0, 'skin': 0 }, {}], 'skins': [{ 'joints': [3] }],"
        "'extensionsUsed': ['KHR_animation_pointer'], 'animations': [%s]",
        animations);
}

#define MOVES(name, node)                                                                                              \
    "{ 'name': '" name "', 'samplers': [{ 'input': 1, 'output': 2 }],"                                                 \
    "  'channels': [{ 'sampler': 0, 'target': { 'node': " node ", 'path': 'translation' } }] }"

static double x_of(const gltf_case *c, int instance)
{
    return (double)c->scene.instances[instance].to_world[12];
}

static void animations_play_together_or_one_that_is_chosen(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *chosen;
        double x0, x1;
    } cases[] = { { NULL, 1, 1 }, { "Ball", 1, 0 }, { "0", 1, 0 }, { "1", 0, 1 }, { "Box", 0, 1 } };
    for (size_t i = 0; i < COUNT(cases); i++) {
        write_animations(c, MOVES("Ball", "0") "," MOVES("Box", "1"));
        scene_motion *const motion = opened(c, cases[i].chosen);
        pose(c, motion, 1.0);
        assert_near(x_of(c, 0), cases[i].x0, "the ball", 1.0);
        assert_near(x_of(c, 1), cases[i].x1, "the box", 1.0);
        scene_motion_close(motion);
    }
}

static void assert_refused_motion(gltf_case *c, const char *animation, const char *says)
{
    scene_motion *motion;
    if (open_motion(c, animation, &motion))
        fail_msg("accepted, expected \"%s\"", says);
    assert_null(motion);
    assert_null(c->scene.meshes);
    if (strncmp(c->said.error, c->path, strlen(c->path)) != 0 || !strstr(c->said.error, says))
        fail_msg("\"%s\" does not say \"%s\"", c->said.error, says);
}

static void animations_that_move_the_same_do_not_play_together(void **state)
{
    gltf_case *c = *state;
    write_animations(c, MOVES("Walk", "0") "," MOVES("Run", "0"));
    assert_refused_motion(c, NULL,
                          "/animations/1/channels/0: found the translation of node 0, which animation 0 \"Walk\" moves "
                          "as well, expected one of them to be chosen (--animation): 0 \"Walk\", 1 \"Run\"");
    assert_refused_motion(c, "Jump", "found no animation called \"Jump\", expected one of: 0 \"Walk\", 1 \"Run\"");
    assert_refused_motion(c, "2", "found no animation called \"2\"");
    assert_refused_motion(c, "-1", "found no animation called \"-1\"");
    scene_motion_close(opened(c, "Run"));
    write_animations(c, "{ 'samplers': [{ 'input': 1, 'output': 2 }], 'channels': ["
                        "{ 'sampler': 0, 'target': { 'node': 0, 'path': 'translation' } },"
                        "{ 'sampler': 0, 'target': { 'node': 0, 'path': 'translation' } }] }");
    assert_refused_motion(c, NULL, "/animations/0/channels/1: found the translation of node 0, which channel 0");
}

static int lines_in(const char *text)
{
    int count = 0;
    for (; *text; text++)
        count += *text == '\n';
    return count;
}

static void what_stands_still_is_said_once_for_each_reason(void **state)
{
    gltf_case *c = *state;
    write_animations(c, "{ 'samplers': [{ 'input': 1, 'output': 2 }], 'channels': ["
                        "{ 'sampler': 0, 'target': { 'node': 0, 'path': 'weights' } },"
                        "{ 'sampler': 0, 'target': { 'node': 1, 'path': 'weights' } },"
                        "{ 'sampler': 0, 'target': { 'node': 3, 'path': 'translation' } },"
                        "{ 'sampler': 0, 'target': { 'path': 'pointer', 'extensions': { 'KHR_animation_pointer':"
                        "  { 'pointer': '/materials/0/pbrMetallicRoughness/roughnessFactor' } } } },"
                        "{ 'sampler': 0, 'target': { 'path': 'pointer' } },"
                        "{ 'sampler': 0, 'target': { 'path': 'translation' } }] }");
    scene_motion *const motion = opened(c, NULL);
    gltf_case_warned(c, "/animations: 2 channels are left out: the weights of morph targets stand still");
    gltf_case_warned(c, "/animations: 1 channel is left out: skins and what hangs on their joints stand still");
    gltf_case_warned(c, "/animations: 3 channels are left out: what is no node stands still (KHR_animation_pointer)");
    gltf_case_warned(c, "/animations: no node moves; every frame shows the same picture");
    for (int i = 0; i < 8; i++)
        pose(c, motion, i);
    assert_int_equal(lines_in(c->warnings), 5); /* and the skin's own */
    scene_motion_close(motion);
}

static void keys_that_are_none_are_refused(void **state)
{
    gltf_case *c = *state;
    static const float back[] = { 1, 0.5F }, same[] = { 1, 1 }, negative[] = { -1, 1 }, not_a_time[] = { 0, NAN },
                       not_a_place[] = { 0, 0, 0, 1, INFINITY, 0 }, no_turn[] = { 0, 0, 0, 1, 0, 0, 0, 0 };
#define MOVING(...)                                                                                                    \
    (moving)                                                                                                           \
    {                                                                                                                  \
        __VA_ARGS__, NULL, NULL                                                                                        \
    }
    const struct {
        moving m;
        const char *says;
    } wrong[] = {
        { MOVING("translation", "LINEAR", "VEC3", 5126, back, 2, line, 2, sizeof line),
          "/accessors/1: found the time 0.5 in element 1 behind 1.0, expected times that increase" },
        { MOVING("translation", "LINEAR", "VEC3", 5126, same, 2, line, 2, sizeof line),
          "expected times that increase" },
        { MOVING("translation", "LINEAR", "VEC3", 5126, negative, 2, line, 2, sizeof line),
          "/accessors/1: found the negative time -1.0 in element 0" },
        { MOVING("translation", "LINEAR", "VEC3", 5126, not_a_time, 2, line, 2, sizeof line),
          "/accessors/1: found NaN in element 1, expected finite numbers" },
        { MOVING("translation", "LINEAR", "VEC3", 5126, two_times, 2, not_a_place, 2, sizeof not_a_place),
          "/accessors/2: found infinity in element 1" },
        { MOVING("rotation", "LINEAR", "VEC4", 5126, two_times, 2, no_turn, 2, sizeof no_turn),
          "/accessors/2: found a quaternion of length 0 in element 1" },
        { MOVING("rotation", "LINEAR", "VEC3", 5126, two_times, 2, line, 2, sizeof line),
          "/accessors/2: found elements of 3 components, expected 4 for an animation" },
        { MOVING("scale", "CUBICSPLINE", "VEC3", 5126, two_times, 2, line, 2, sizeof line),
          "/animations/0/samplers/0/output: found 2 elements, expected 6 for 2 keys of a cubic spline" },
        { MOVING("scale", "STEP", "VEC3", 5126, two_times, 1, line, 2, sizeof line), "found 2 elements, expected 1" },
        { MOVING("turn", "STEP", "VEC3", 5126, two_times, 2, line, 2, sizeof line),
          "/animations/0/channels/0/target/path: found \"turn\", expected one of translation|rotation" },
        { MOVING("scale", "SMOOTH", "VEC3", 5126, two_times, 2, line, 2, sizeof line),
          "/animations/0/samplers/0/interpolation: found \"SMOOTH\"" },
    };
    for (size_t i = 0; i < COUNT(wrong); i++) {
        write_moving(c, &wrong[i].m);
        assert_refused_motion(c, NULL, wrong[i].says);
        gltf_case_accepted(c); /* at rest nobody looks */
    }
}

static void animations_of_nothing_are_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *animations, *says;
    } wrong[] = {
        { "", "found no animation, expected one for its frames to show" },
        { "{}", "/animations/0: found no \"channels\"" },
        { MOVES("Fly", "4"), "/animations/0/channels/0/target/node: found 4, expected an index into \"nodes\"" },
        { "{ 'samplers': [{ 'input': 1, 'output': 9 }],"
          "  'channels': [{ 'sampler': 0, 'target': { 'node': 0, 'path': 'translation' } }] }",
          "/animations/0/samplers/0/output: found 9, expected an index into \"accessors\"" },
        { "{ 'samplers': [{ 'input': 1, 'output': 2 }],"
          "  'channels': [{ 'sampler': 1, 'target': { 'node': 0, 'path': 'translation' } }] }",
          "/animations/0/channels/0/sampler: found 1, expected an index into the 1 samplers" },
    };
    for (size_t i = 0; i < COUNT(wrong); i++) {
        write_animations(c, wrong[i].animations);
        assert_refused_motion(c, NULL, wrong[i].says);
    }
    write_moving(c, &(moving){ "scale", "STEP", "VEC3", 5126, two_times, 2, line, 2, sizeof line,
                               ", 'matrix': [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]", NULL });
    assert_refused_motion(c, NULL, "/nodes/0/matrix: found a matrix on a node that /animations/0/channels/0 moves");
}

/* Accessors that are read anew for each channel would be more elements than the bytes of the file account for. */
static void one_list_of_times_serves_any_number_of_channels(void **state)
{
    gltf_case *c = *state;
    enum { KEYS = 10000, CHANNELS = 3000 };
    char *const text = calloc(CHANNELS, 96);
    char *end = text;
    float *const bytes = calloc(4 * KEYS, sizeof *bytes);
    assert_true(text && bytes);
    for (int i = 0; i < KEYS; i++)
        bytes[i] = (float)i;
    for (int i = 0; i < CHANNELS; i++)
        end += sprintf(end, "%s{'sampler':0,'target':{'node':%d,'path':'scale'}}", i > 0 ? "," : "", i);
    char *const nodes = calloc(CHANNELS, 3);
    assert_non_null(nodes);
    for (int i = 0; i < CHANNELS; i++)
        memcpy(nodes + 3 * i, i + 1 < CHANNELS ? "{}," : "{}", i + 1 < CHANNELS ? 3 : 2);
    gltf_case_json_with_buffer(
        c, bytes, 4 * KEYS * sizeof *bytes,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': %d }, { 'buffer': 0, 'byteOffset': %d, 'byteLength': %d }],"
        "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': %d, 'type': 'SCALAR' },"
        "  { 'bufferView': 1, 'componentType': 5126, 'count': %d, 'type': 'VEC3' }],"
        "'nodes': [%s], 'animations': [{ 'samplers': [{ 'input': 0, 'output': 1 }], 'channels': [%s] }]",
        4 * KEYS, 4 * KEYS, 12 * KEYS, KEYS, KEYS, nodes, text);
    scene_motion *const motion = opened(c, NULL);
    pose(c, motion, 5000.5);
    scene_motion_close(motion);
    free(nodes);
    free(bytes);
    free(text);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(linear_keys_are_met_by_straight_lines_and_held_outside),
        TEST(steps_jump_at_their_keys),
        TEST(linear_rotations_run_evenly_the_shorter_way),
        TEST(rotations_may_be_normalized_integers),
        TEST(splines_reproduce_cubics),
        TEST(rotations_by_splines_are_of_unit_length),
        TEST(spline_through_zero_still_gives_a_pose),
        TEST(mesh_that_is_scaled_to_nothing_comes_back),
        TEST(pose_depends_on_its_time_alone),
        TEST(sparse_keys_are_put_in_place),
        TEST(animations_play_together_or_one_that_is_chosen),
        TEST(animations_that_move_the_same_do_not_play_together),
        TEST(what_stands_still_is_said_once_for_each_reason),
        TEST(keys_that_are_none_are_refused),
        TEST(animations_of_nothing_are_refused),
        TEST(one_list_of_times_serves_any_number_of_channels),
    };
    return cmocka_run_group_tests_name("motion", tests, NULL, NULL);
}
