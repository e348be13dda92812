/* The scene of the examples, as the reader of scenes gives it back: its meshes are sound and a metre of texture is a
 * metre of surface. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "io/scene_file.h"
#include "scene/scene.h"

static scene ball;

static int read_scene(void **state)
{
    (void)state;
    report r = { 0 };
    if (!scene_file_read(SHADER_BALL, NULL, &ball, &r)) {
        fprintf(stderr, "%s\n", r.error);
        return -1;
    }
    return 0;
}

static int free_scene(void **state)
{
    (void)state;
    scene_free(&ball);
    return 0;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void load(const float *from, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)from[i];
}

typedef struct triangle {
    uint32_t corner[3];
    double position[3][3], normal[3][3], edge[2][3], cross[3], area; /* the edges start at corner 0 */
} triangle;

static triangle triangle_of(const scene_mesh *mesh, uint32_t index)
{
    triangle t;
    for (int c = 0; c < 3; c++) {
        t.corner[c] = mesh->index[3 * (size_t)index + (size_t)c];
        load(&mesh->position[3 * (size_t)t.corner[c]], t.position[c]);
        load(&mesh->normal[3 * (size_t)t.corner[c]], t.normal[c]);
    }
    for (int e = 0; e < 2; e++)
        for (int i = 0; i < 3; i++)
            t.edge[e][i] = t.position[e + 1][i] - t.position[0][i];
    cross(t.edge[0], t.edge[1], t.cross);
    t.area = 0.5 * sqrt(dot(t.cross, t.cross));
    return t;
}

/* Steps of 1.5 degrees tilt a flat triangle against the normals at its corners by at most the turn along both of its
 * sides, 1.5 degrees along the profile and 360/256 around; on the rounded edges of 1.5 mm it is the same turn. */
static void triangles_face_along_their_normals(void **state)
{
    (void)state;
    const double widest_turn = cos((1.5 + 360.0 / 256.0) * 3.14159265358979323846 / 180.0);
    for (int m = 0; m < ball.mesh_count; m++) {
        for (uint32_t i = 0; i < ball.meshes[m].triangle_count; i++) {
            const triangle t = triangle_of(&ball.meshes[m], i);
            assert_true(t.area > 0.0);
            for (int c = 0; c < 3; c++) {
                const double cosine = dot(t.cross, t.normal[c]) / (2.0 * t.area);
                if (!(cosine > widest_turn))
                    fail_msg("%s triangle %u corner %d: cosine %.6f, expected above %.6f", ball.meshes[m].name, i, c,
                             cosine, widest_turn);
            }
        }
    }
}

/* Singular values of the map from the surface to texture coordinates, by the first fundamental form: with edges e1, e2
 * and their texture differences t1, t2 the Gram matrix of the map is G = E^-T (T^T T) E^-1; its trace and determinant
 * give both values. */
static void stretch(const triangle *t, const float *uv, double *low, double *high)
{
    const float *a = &uv[2 * (size_t)t->corner[0]], *b = &uv[2 * (size_t)t->corner[1]],
                *c = &uv[2 * (size_t)t->corner[2]];
    const double length = sqrt(dot(t->edge[0], t->edge[0]));
    const double x2 = dot(t->edge[0], t->edge[1]) / length, y2 = 2.0 * t->area / length;
    double rows[2][2]; /* d(u, v) / d(x, y), x along the first edge */
    for (int k = 0; k < 2; k++) {
        rows[k][0] = ((double)b[k] - (double)a[k]) / length;
        rows[k][1] = ((double)c[k] - (double)a[k] - rows[k][0] * x2) / y2;
    }
    const double trace =
        rows[0][0] * rows[0][0] + rows[0][1] * rows[0][1] + rows[1][0] * rows[1][0] + rows[1][1] * rows[1][1];
    const double determinant = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    const double root = sqrt(fmax(0.0, trace * trace / 4.0 - determinant * determinant));
    *high = sqrt(trace / 2.0 + root);
    *low = fabs(determinant) / *high;
}

/* A chart lets the radius vary by 1.25, so u is off by sqrt(1.25) at most; the chord of an arc is shorter than the arc
 * by less than 1e-4 at these steps; a triangle that spans two radii shears u by the turn of one segment, 2 pi / 256,
 * times the change of radius along it, at most 2 pi / 256. The last 2 mm around a pole are left out: no chart of rings
 * is even there. */
static void a_metre_of_texture_is_a_metre_of_surface(void **state)
{
    (void)state;
    const double bound = sqrt(1.25) * 1.0001 + 2.0 * 3.14159265358979323846 / 256.0;
    const double pole_radius = 0.002;
    uint32_t measured = 0;
    for (int m = 0; m < ball.mesh_count; m++) {
        const scene_mesh *mesh = &ball.meshes[m];
        for (uint32_t i = 0; i < mesh->triangle_count; i++) {
            const triangle t = triangle_of(mesh, i);
            double nearest = (double)INFINITY;
            for (int c = 0; c < 3; c++)
                nearest = fmin(nearest, hypot(t.position[c][0], t.position[c][2]));
            if (nearest < pole_radius * 1.25)
                continue;
            double low, high;
            stretch(&t, mesh->texcoord[0], &low, &high);
            if (!(low > 1.0 / bound && high < bound))
                fail_msg("%s triangle %u: a metre of surface is %.4f to %.4f of texture, expected %.4f to %.4f",
                         mesh->name, i, low, high, 1.0 / bound, bound);
            measured++;
        }
    }
    assert_true(measured > 100000);
}

static void tangents_are_unit_and_lie_in_the_surface(void **state)
{
    (void)state;
    for (int m = 0; m < ball.mesh_count; m++) {
        const scene_mesh *mesh = &ball.meshes[m];
        for (uint32_t i = 0; i < mesh->vertex_count; i++) {
            double normal[3], tangent[3];
            load(&mesh->normal[3 * (size_t)i], normal);
            load(&mesh->tangent[4 * (size_t)i], tangent);
            /* Each component is rounded to float: 2^-25 relative each, so a few 2^-25 in a dot product of three. */
            assert_true(fabs(dot(tangent, tangent) - 1.0) < 3e-7);
            assert_true(fabs(dot(normal, tangent)) < 3e-7);
            assert_true(mesh->tangent[4 * (size_t)i + 3] == 1.0F);
        }
    }
}

/* What the README and `./dev preview` say of the scene. */
static void the_ball_is_the_only_material_with_glints(void **state)
{
    (void)state;
    assert_int_equal(ball.camera_count, 1);
    assert_int_equal(ball.light_count, 3);
    for (int i = 0; i < ball.light_count; i++)
        assert_true(ball.lights[i].radius_m >= 0.01F && ball.lights[i].radius_m <= 0.04F);
    for (int i = 0; i < ball.material_count; i++) {
        const bool is_ball = i == 0;
        assert_true(ball.materials[i].glint.present == is_ball);
        if (is_ball)
            assert_string_equal(ball.materials[i].name, "ball");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_face_along_their_normals),
        cmocka_unit_test(a_metre_of_texture_is_a_metre_of_surface),
        cmocka_unit_test(tangents_are_unit_and_lie_in_the_surface),
        cmocka_unit_test(the_ball_is_the_only_material_with_glints),
    };
    return cmocka_run_group_tests(tests, read_scene, free_scene);
}
