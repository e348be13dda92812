/* Glowing surfaces by brute force: paths that scatter evenly over the hemisphere and only ever bump into light, in
 * double and with textbook formulas, against the renderer, which draws its directions from lobes and from the light and
 * weighs both by the balance heuristic.
 *
 * A rough metal floor under a panel, a matte board that hides part of it, a matte wall that sends some of it back. The
 * camera sees the floor alone: on later surfaces the renderer widens lobes on purpose, which matte ones have not.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lobe_truth.h"
#include "preview/preview.h"
#include "scenes.h"
#include "statistics.h"
#include "study.h"

#define PI 3.14159265358979323846

enum { WIDTH = 16, HEIGHT = 12, PIXELS = WIDTH * HEIGHT, BOUNCES = 2, QUADS = 4 };

typedef struct quad {
    double corner[3], x[3], y[3]; /* corner + s x + t y; x cross y points to its front */
    double albedo;                /* matte; 0 for the floor, whose lobe reflects */
    double emission;              /* of the front */
    int is_metal;
} quad;

static const double ROUGHNESS = 0.6, METAL = 0.7; /* f0 */
static const double EYE[3] = { -1.0, 1.6, 1.8 }, TARGET[3] = { 0.0, 0.0, 0.0 }, OPENING = 0.5;

static const quad QUAD[QUADS] = {
    { { -2.0, 0.0, 2.0 }, { 4.0, 0.0, 0.0 }, { 0.0, 0.0, -4.0 }, 0.0, 0.0, 1 }, /* floor, front up */
    { { -0.5, 1.2, -0.9 }, { 0.8, 0.0, 0.0 }, { 0.0, 0.0, 0.8 }, 0.0, 4.0, 0 }, /* panel, front down */
    { { -0.2, 0.6, -0.5 }, { 0.4, 0.0, 0.0 }, { 0.0, 0.1, 0.5 }, 0.5, 0.0, 0 }, /* board */
    { { 0.9, 0.0, -1.5 }, { 0.0, 0.0, 2.0 }, { 0.0, 1.5, 0.0 }, 0.8, 0.0, 0 },  /* wall */
};

static void cross3(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit3(double a[3])
{
    const double length = sqrt(dot3(a, a));
    for (int k = 0; k < 3; k++)
        a[k] /= length;
}

/* ---- by the renderer ---- */

static scene make_scene(void)
{
    scene s = scenes_empty();
    for (int i = 0; i < QUADS; i++) {
        const quad *const q = &QUAD[i];
        scene_material m = scenes_matte((float)q->albedo);
        if (q->is_metal) {
            m = scene_material_default();
            m.metallic = 1.0F;
            m.roughness = (float)ROUGHNESS;
            m.base_color[0] = m.base_color[1] = m.base_color[2] = (float)METAL;
        }
        m.emissive[0] = m.emissive[1] = m.emissive[2] = (float)q->emission;
        m.double_sided = !(q->emission > 0.0);
        static const double at[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };
        float corner[18];
        for (int v = 0; v < 6; v++)
            for (int k = 0; k < 3; k++)
                corner[3 * v + k] = (float)(q->corner[k] + at[v][0] * q->x[k] + at[v][1] * q->y[k]);
        scenes_add_instance(&s, scenes_add_triangles(&s, scenes_add_material(&s, &m), corner, 2), NULL, i);
    }
    return s;
}

static void render(int spp, uint32_t seed, double pixel[PIXELS])
{
    static const preview_sky black = { { 0 }, { 0 }, { 0 } };
    const float eye[3] = { (float)EYE[0], (float)EYE[1], (float)EYE[2] };
    const float target[3] = { (float)TARGET[0], (float)TARGET[1], (float)TARGET[2] };
    const scene_camera camera = scenes_camera(SCENE_PERSPECTIVE, eye, target, (float)OPENING);
    preview_options o = PREVIEW_OPTIONS_INIT;
    scene s = make_scene();
    image picture;
    report r = { 0 };
    o.width = WIDTH;
    o.height = HEIGHT;
    o.spp = spp;
    o.seed = seed;
    o.bounces = BOUNCES;
    o.camera = &camera;
    o.sky = &black;
    if (!preview_render(&s, &o, &picture, NULL, &r)) {
        fprintf(stderr, "paths: %s\n", r.error);
        exit(1);
    }
    for (int i = 0; i < PIXELS; i++)
        pixel[i] = (double)picture.pixels[i * picture.channel_count];
    image_free(&picture);
    scene_free(&s);
}

/* ---- by brute force ---- */

typedef struct place {
    const quad *on;
    double at[3], normal[3]; /* towards where the ray comes from */
    int is_front;
} place;

static int find(const double from[3], const double to[3], place *out)
{
    double nearest = (double)INFINITY;
    for (int i = 0; i < QUADS; i++) {
        const quad *const q = &QUAD[i];
        double normal[3], d[3], off[3];
        cross3(q->x, q->y, normal);
        for (int k = 0; k < 3; k++)
            d[k] = q->corner[k] - from[k];
        const double facing = dot3(normal, to), t = dot3(normal, d) / facing;
        if (!(fabs(facing) > 0.0) || !(t > 1e-9) || !(t < nearest))
            continue;
        for (int k = 0; k < 3; k++)
            off[k] = from[k] + t * to[k] - q->corner[k];
        const double s = dot3(off, q->x) / dot3(q->x, q->x), u = dot3(off, q->y) / dot3(q->y, q->y);
        /* The back of a single-sided surface is not there. */
        if (s < 0.0 || s > 1.0 || u < 0.0 || u > 1.0 || (q->emission > 0.0 && facing > 0.0))
            continue;
        nearest = t;
        out->on = q;
        out->is_front = facing < 0.0;
        for (int k = 0; k < 3; k++) {
            out->at[k] = from[k] + t * to[k];
            out->normal[k] = facing < 0.0 ? normal[k] : -normal[k];
        }
        unit3(out->normal);
    }
    return isfinite(nearest);
}

/* f cos, directions away from the surface. */
static double scattered(const place *p, const double wo[3], const double wi[3])
{
    const double cos_o = dot3(wo, p->normal), cos_i = dot3(wi, p->normal);
    if (!p->on->is_metal)
        return p->on->albedo / PI * cos_i;
    /* Round roughness: any frame will do. */
    double half[3], across[3];
    for (int k = 0; k < 3; k++)
        half[k] = wo[k] + wi[k];
    unit3(half);
    const wide_lobe l = { 1, (wide)(ROUGHNESS * ROUGHNESS), (wide)(ROUGHNESS * ROUGHNESS) };
    cross3(half, p->normal, across);
    const wide h[3] = { (wide)sqrt(dot3(across, across)), 0.0L, (wide)dot3(half, p->normal) };
    const wide o[3] = { (wide)sqrt(fmax(1.0 - cos_o * cos_o, 0.0)), 0.0L, (wide)cos_o };
    const wide i[3] = { (wide)sqrt(fmax(1.0 - cos_i * cos_i, 0.0)), 0.0L, (wide)cos_i };
    const double masked_o = (double)wide_masked(&l, o), masked_i = (double)wide_masked(&l, i);
    const double fresnel = METAL + (1.0 - METAL) * pow(1.0 - dot3(half, wi), 5.0);
    return fresnel * 0.25 * (double)wide_density(&l, h) * cos_i / (cos_o * cos_i + masked_o * cos_i + masked_i * cos_o);
}

/* Even over the hemisphere around the normal. */
static void any_direction(const double normal[3], uint64_t *random, double out[3])
{
    const double z = random_between(random, -1.0, 1.0), phi = random_between(random, 0.0, 2.0 * PI);
    out[0] = sqrt(1.0 - z * z) * cos(phi);
    out[1] = sqrt(1.0 - z * z) * sin(phi);
    out[2] = z;
    if (dot3(out, normal) < 0.0)
        for (int k = 0; k < 3; k++)
            out[k] = -out[k];
}

static double path(const double from[3], const double to[3], uint64_t *random)
{
    double origin[3], direction[3], throughput = 1.0, sum = 0.0;
    memcpy(origin, from, sizeof(origin));
    memcpy(direction, to, sizeof(direction));
    for (int bounce = 0;; bounce++) {
        place p = { .on = NULL };
        if (!find(origin, direction, &p))
            return sum;
        sum += throughput * (p.is_front ? p.on->emission : 0.0);
        if (bounce == BOUNCES || p.on->emission > 0.0)
            return sum;
        const double wo[3] = { -direction[0], -direction[1], -direction[2] };
        any_direction(p.normal, random, direction);
        throughput *= scattered(&p, wo, direction) * 2.0 * PI;
        memcpy(origin, p.at, sizeof(origin));
    }
}

/* A ray through any point of a pixel; row 0 is on top. */
static double look(int pixel, uint64_t *random)
{
    static const double up[3] = { 0.0, 1.0, 0.0 };
    double forward[3], right[3], above[3], to[3];
    for (int k = 0; k < 3; k++)
        forward[k] = TARGET[k] - EYE[k];
    unit3(forward);
    cross3(forward, up, right);
    unit3(right);
    cross3(right, forward, above);
    const double half_height = tan(0.5 * OPENING), half_width = half_height * WIDTH / HEIGHT;
    const double x = (2.0 * (pixel % WIDTH + random_uniform(random)) / WIDTH - 1.0) * half_width;
    const double y = (1.0 - 2.0 * (pixel / WIDTH + random_uniform(random)) / HEIGHT) * half_height;
    for (int k = 0; k < 3; k++)
        to[k] = forward[k] + x * right[k] + y * above[k];
    unit3(to);
    return path(EYE, to, random);
}

/* The renderer's own noise from two pictures: a half of each. */
int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    const int paths = s.is_short ? 20000 : 1000000, spp = s.is_short ? 1024 : 16384;
    static double picture[2][PIXELS];
    render(spp, 1U, picture[0]);
    render(spp, 2U, picture[1]);
    FILE *const csv = study_open(&s, "paths.csv");
    fprintf(csv, "column,row,rendered,brute_force,sigma\n");
    double square = 0.0, sum[2] = { 0.0, 0.0 }, variance = 0.0;
    uint64_t random = 81;
    for (int i = 0; i < PIXELS; i++) {
        moments m = { 0 };
        for (int k = 0; k < paths; k++)
            moments_add(&m, look(i, &random));
        const double rendered = 0.5 * (picture[0][i] + picture[1][i]), noise = 0.5 * (picture[0][i] - picture[1][i]);
        const double own = moments_standard_error(&m);
        /* One difference says little of one pixel's noise; of all it says the mean. */
        variance += own * own + noise * noise;
        square += (rendered - m.mean) * (rendered - m.mean);
        sum[0] += rendered;
        sum[1] += m.mean;
        fprintf(csv, "%d,%d,%.6g,%.6g,%.2g\n", i % WIDTH, i / WIDTH, rendered, m.mean, hypot(own, noise));
    }
    study_close(csv);
    printf("mean %.6f, by brute force %.6f +- %.6f (%+.1f sigmas); pixels differ by %.3f of what chance gives\n",
           sum[0] / PIXELS, sum[1] / PIXELS, sqrt(variance) / PIXELS, (sum[0] - sum[1]) / sqrt(variance),
           sqrt(square / variance));
    study_check(&s, fabs(sum[0] - sum[1]) < 4.0 * sqrt(variance), "mean %.6f, by brute force %.6f +- %.6f",
                sum[0] / PIXELS, sum[1] / PIXELS, sqrt(variance) / PIXELS);
    /* A sum of as many squares as there are pixels has a spread of sqrt(2 / PIXELS), that of the brightest ones some
     * times as much: the panel's share of the sky is alike all over the floor. */
    study_check(&s, square < variance * (1.0 + 5.0 * sqrt(4.0 / PIXELS)), "pixels differ by %.3f of what chance gives",
                sqrt(square / variance));
    return study_end(&s);
}
