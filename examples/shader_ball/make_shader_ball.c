/* Makes the lookdev scene of the examples: a shader ball on its stand before a curved backdrop, in metres.
 *
 *     make_shader_ball SCENE.json OUT.glb
 *
 * SCENE.json is the glTF object without its geometry: nodes, materials, camera, lights. The meshes that its nodes name
 * by number are made here, in the order of `enum mesh_number`. The same input gives the same bytes.
 */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glb.h"
#include "profile.h"
#include "solid.h"

enum mesh_number { MESH_SHELL, MESH_CORE, MESH_STAND, MESH_BACKDROP, MESH_PANEL, MESH_COUNT };
enum material_number { MATERIAL_BALL, MATERIAL_STAND, MATERIAL_FLOOR, MATERIAL_PANEL };
enum { TURNS = 256 };

static const double pi = 3.14159265358979323846;

/* Metres. A ball of 12 cm is what a hand holds and what a paint maker sprays for a sample. */
static const double shell_radius = 0.060, core_radius = 0.052, groove_bottom = 0.051, edge_radius = 0.0015;
/* Radians from the top of the ball: where the groove in the shell begins and ends. */
static const double groove_from = 1.05, groove_to = 1.25;

/* 1.5 degrees: the outline of a ball that fills a picture of 1000 pixels is then off by less than a tenth of a pixel.
 */
static const double arc_step = 0.02617994;
/* Around a pole the rows are a quarter as far apart, so that from 2 mm on neighbouring rows differ by a quarter in
 * radius at most: what a chart of solid_turn allows. */
static const double pole_cap = 0.12, pole_step = 0.00654498;

/* The part of a sphere around the origin between two angles from its top. */
static void sphere_profile(profile *p, double radius, double from, double to)
{
    const double first = fmax(from, pole_cap), last = fmin(to, pi - pole_cap);
    if (from < first)
        profile_arc(p, 0.0, 0.0, radius, from, first, pole_step);
    profile_arc(p, 0.0, 0.0, radius, first, last, arc_step);
    if (last < to)
        profile_arc(p, 0.0, 0.0, radius, last, to, pole_step);
}

/* The wall of the groove points at the centre of the ball. The rounded edge between sphere and wall is an arc whose
 * centre lies edge_radius below the sphere and as far from the wall. */
static void shell_profile(profile *p)
{
    const double center = shell_radius - edge_radius;
    const double inset = asin(edge_radius / center);
    const double wall_top = sqrt(center * center - edge_radius * edge_radius);
    const double upper = groove_from - inset, lower = groove_to + inset;

    sphere_profile(p, shell_radius, 0.0, upper);
    profile_arc(p, center * sin(upper), center * cos(upper), edge_radius, upper, groove_from + pi / 2.0, arc_step);
    profile_line(p, wall_top * sin(groove_from), wall_top * cos(groove_from), groove_bottom * sin(groove_from),
                 groove_bottom * cos(groove_from), 0.002);
    profile_line(p, groove_bottom * sin(groove_to), groove_bottom * cos(groove_to), wall_top * sin(groove_to),
                 wall_top * cos(groove_to), 0.002);
    profile_arc(p, center * sin(lower), center * cos(lower), edge_radius, groove_to - pi / 2.0, lower, arc_step);
    sphere_profile(p, shell_radius, lower, pi);
}

static void core_profile(profile *p)
{
    sphere_profile(p, core_radius, 0.0, pi);
}

/* A rim that carries the ball at 8.8 cm, a hollow neck and a foot. */
static void stand_profile(profile *p)
{
    profile_line(p, 0.0200, 0.0345, 0.0285, 0.0345, 0.002);
    profile_arc(p, 0.0285, 0.0330, 0.0015, 0.0, pi / 2.0, arc_step);
    profile_arc(p, 0.0520, 0.0330, 0.0220, -pi / 2.0, -pi, arc_step);
    profile_line(p, 0.0520, 0.0110, 0.0560, 0.0110, 0.002);
    profile_arc(p, 0.0560, 0.0090, 0.0020, 0.0, pi / 2.0, arc_step);
    profile_line(p, 0.0580, 0.0090, 0.0580, 0.0000, 0.002);
}

/* From the top of the wall down, around a bend of 40 cm, and along the floor to the front. */
static void backdrop_profile(profile *p)
{
    profile_line(p, -0.90, 1.40, -0.90, 0.40, 0.1);
    profile_arc(p, -0.50, 0.40, 0.40, -pi / 2.0, -pi, arc_step);
    profile_line(p, -0.50, 0.00, 1.50, 0.00, 0.1);
}

/* 40 cm high; it faces +z. */
static void panel_profile(profile *p)
{
    profile_line(p, 0.0, 0.20, 0.0, -0.20, 0.4);
}

static void turn(glb_mesh *mesh, void (*make_profile)(profile *p))
{
    profile p = { 0 };
    make_profile(&p);
    solid_turn(mesh, &p, TURNS);
    profile_free(&p);
}

static void draw_out(glb_mesh *mesh, void (*make_profile)(profile *p), double half_width, int segments)
{
    profile p = { 0 };
    make_profile(&p);
    solid_draw_out(mesh, &p, half_width, segments);
    profile_free(&p);
}

/* The text between the outer braces of a JSON file; NULL after a message. The caller frees it. */
static char *read_members(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        fprintf(stderr, "make_shader_ball: %s: %s\n", path, strerror(errno));
        return NULL;
    }
    enum { LIMIT = 1 << 20 };
    char *text = calloc(LIMIT + 1, 1);
    const size_t length = text ? fread(text, 1, LIMIT, file) : 0;
    fclose(file);
    char *const first = text ? memchr(text, '{', length) : NULL;
    char *const last = first ? strrchr(text, '}') : NULL;
    if (!last) {
        fprintf(stderr, "make_shader_ball: %s: found no JSON object in its first %d bytes\n", path, LIMIT);
        free(text);
        return NULL;
    }
    memmove(text, first + 1, (size_t)(last - first - 1));
    text[last - first - 1] = '\0';
    return text;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: make_shader_ball SCENE.json OUT.glb\n");
        return 2;
    }
    char *members = read_members(argv[1]);
    if (!members)
        return 1;

    glb_mesh meshes[MESH_COUNT] = {
        [MESH_SHELL] = { .name = "shell", .material = MATERIAL_BALL },
        [MESH_CORE] = { .name = "core", .material = MATERIAL_STAND },
        [MESH_STAND] = { .name = "stand", .material = MATERIAL_STAND },
        [MESH_BACKDROP] = { .name = "backdrop", .material = MATERIAL_FLOOR },
        [MESH_PANEL] = { .name = "panel", .material = MATERIAL_PANEL },
    };
    turn(&meshes[MESH_SHELL], shell_profile);
    turn(&meshes[MESH_CORE], core_profile);
    turn(&meshes[MESH_STAND], stand_profile);
    draw_out(&meshes[MESH_BACKDROP], backdrop_profile, 1.5, 30);
    draw_out(&meshes[MESH_PANEL], panel_profile, 0.3, 1);

    const bool written = glb_write(argv[2], members, meshes, MESH_COUNT);
    for (size_t i = 0; i < MESH_COUNT; i++)
        glb_mesh_free(&meshes[i]);
    free(members);
    return written ? 0 : 1;
}
