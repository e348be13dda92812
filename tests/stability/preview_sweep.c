#include "preview_sweep.h"

#include <stdlib.h>
#include <string.h>

#include "exact_inputs.h"
#include "io/mipmap.h"
#include "io/texture_transform.h"
#include "preview/camera.h"
#include "preview/environment.h"
#include "preview/sampler.h"
#include "scene/surface.h"

typedef struct sweep {
    uint64_t random;
    int count, any_bits;
    preview_sink *sink;
    void *user;
} sweep;

/* Between the two, or any bits. */
static float number(sweep *s, double low, double high)
{
    const float ordinary = (float)random_between(&s->random, low, high);
    if (s->any_bits == 0 || random_bits(&s->random) % (uint64_t)s->any_bits != 0)
        return ordinary;
    const uint32_t bits = (uint32_t)random_bits(&s->random);
    float any;
    memcpy(&any, &bits, sizeof any);
    return any;
}

/* Within a kilometre, or as near and as far as a float goes. */
static double place(sweep *s)
{
    const double x = random_between(&s->random, -1000.0, 1000.0);
    if (s->any_bits == 0 || random_bits(&s->random) % (uint64_t)s->any_bits != 0)
        return x;
    return ldexp(x, (int)(random_bits(&s->random) % 230) - 120);
}

/* One random number a statement: the order in which arguments are evaluated is the compiler's choice. */
static vec3 places(sweep *s)
{
    vec3 p;
    p.x = place(s);
    p.y = place(s);
    p.z = place(s);
    return p;
}

static float between(sweep *s, double low, double high)
{
    return (float)random_between(&s->random, low, high);
}

static void uniforms(sweep *s, double u[2])
{
    u[0] = random_uniform(&s->random);
    u[1] = random_uniform(&s->random);
}

static vec3 unit(sweep *s)
{
    float w[3];
    exact_direction(&s->random, w);
    /* Poles, seams and axes, and what is next to them. */
    for (int k = 0; k < 3 && s->any_bits; k++)
        if (random_bits(&s->random) % 5 == 0)
            w[k] = random_bits(&s->random) % 2 ? 0.0F : 1e-30F;
    const double sign = random_bits(&s->random) % 2 ? 1.0 : -1.0;
    const vec3 v = v3_normalize(v3(sign * (double)w[0], (double)w[2], (double)w[1]));
    return v3_length(v) > 0.5 ? v : v3(0.0, sign, 0.0);
}

static void give(const sweep *s, const char *what, const double *numbers, size_t count)
{
    s->sink(s->user, what, numbers, count);
}

static void give_vectors(const sweep *s, const char *what, const vec3 *v, size_t count)
{
    give(s, what, &v->x, 3 * count);
}

/* An upright frame that stands anywhere, column by column. */
static void pose(sweep *s, float m[16])
{
    const vec3 z = unit(s), x = v3_any_tangent(z);
    m4_from_axes(x, v3_cross(z, x), z, places(s), m);
}

/* ---- cameras and differentials ---- */

static void sweep_cameras(sweep *s)
{
    for (int i = 0; i < s->count; i++) {
        scene_camera from = { .projection = i % 3 ? SCENE_PERSPECTIVE : SCENE_ORTHOGRAPHIC,
                              .yfov_rad = between(s, 0.01, 3.0),
                              .xmag = 2.0F,
                              .ymag = 1.0F,
                              .znear = 0.01F };
        pose(s, from.to_world);
        camera c;
        report r = { 0 };
        if (!camera_make(&from, 640, 360, &c, &r))
            continue;
        trace_ray ray;
        differential d;
        double at[2];
        uniforms(s, at);
        camera_ray(&c, 640.0 * at[0], 360.0 * at[1], &ray, &d);
        const vec3 normal = unit(s);
        surface_step step = { .dx = v3_scale(unit(s), 1e-3) };
        surface_step turn = { .dx = unit(s) };
        step.dy = v3_scale(normal, 1e-3 * place(s));
        turn.dy = v3_scale(unit(s), 0.5);
        differential out = differential_reflect(&d, ray.direction, normal, &step, &turn);
        give_vectors(s, "ray", &ray.origin, 2);
        give_vectors(s, "reflected differential", &out.origin_dx, 4);
        const vec3 drawn = unit(s);
        differential_widen(&out, drawn, random_uniform(&s->random));
        give_vectors(s, "widened differential", &out.origin_dx, 4);
        const double variance = differential_half_vector_variance(&d, &turn);
        give(s, "variance of half vectors", &variance, 1);
    }
}

/* ---- lights ---- */

static void sweep_lights(sweep *s)
{
    for (int i = 0; i < s->count; i++) {
        scene_light from = { .kind = (scene_light_kind)(i % 5),
                             .color = { 1.0F, 0.5F, 0.25F },
                             .range = i % 4 ? 0.0F : 50.0F };
        from.intensity = between(s, 0.0, 10.0);
        from.outer_cone_rad = between(s, 0.01, 1.57);
        from.angular_diameter_rad = between(s, 0.0, 3.0);
        from.radius_m = between(s, 0.0, 2.0);
        from.width_m = between(s, 0.001, 5.0);
        from.height_m = between(s, 0.001, 5.0);
        from.inner_cone_rad = 0.7F * from.outer_cone_rad;
        pose(s, from.to_world);
        const light l = light_make(&from);
        /* Often right beside it, or within it. */
        vec3 at = unit(s);
        at = i % 3 ? places(s) : v3_mad(l.position, at, random_uniform(&s->random));
        double u[2];
        uniforms(s, u);
        light_view view;
        if (light_is_area(&l)) {
            const vec3 point = light_point(&l, u);
            give_vectors(s, "point of a light", &point, 1);
        }
        if (!light_see(&l, at, &view))
            continue;
        const double seen[] = { view.wi.x,
                                view.wi.y,
                                view.wi.z,
                                (double)view.irradiance[0],
                                (double)view.irradiance[1],
                                light_is_area(&l) ? 0.0 : (double)view.solid_angle_sr };
        give(s, "light", seen, sizeof seen / sizeof seen[0]);
        if (!light_is_area(&l) && light_is_soft(&l)) {
            vec3 direction;
            double distance;
            light_pick(&l, &view, at, u, &direction, &distance);
            give_vectors(s, "shadow ray", &direction, 1);
        }
    }
}

/* ---- surroundings ---- */

static void give_surroundings(const sweep *s, const char *what, const environment_light *l)
{
    const double found[] = {
        l->wi.x, l->wi.y, l->wi.z, (double)l->rgb[0], (double)l->rgb[1], (double)l->pdf, (double)l->solid_angle_sr
    };
    give(s, what, found, sizeof found / sizeof found[0]);
}

static void sweep_surroundings(sweep *s)
{
    enum { WIDTH = 64, HEIGHT = WIDTH / 2 };
    static float rgb[3 * WIDTH * HEIGHT];
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
        const int exponent = -(int)(random_bits(&s->random) % 8);
        rgb[i] = i / 3 % 97 == 5 ? 0.0F : ldexpf((float)random_uniform(&s->random), exponent);
    }
    for (int k = 0; k < 3; k++)
        rgb[3 * (10 * WIDTH + 20) + k] = 5000.0F; /* a sun */
    const environment_map map = { WIDTH, HEIGHT, rgb };
    const preview_environment from = { &map, { 0.0F, 0.6F, 0.0F, 0.8F }, 1.5F };
    environment e;
    report r = { 0 };
    if (!environment_make(&from, &e, &r))
        abort();
    for (int i = 0; i < s->count; i++) {
        const vec3 d = unit(s);
        const double edge = 1.0 - 0x1p-53;
        double u[2];
        uniforms(s, u);
        if (s->any_bits && i % 7 == 0)
            u[i % 2] = i % 3 ? 0.0 : edge;
        environment_light l;
        float sky[3];
        environment_from(&e, d, &l);
        give_surroundings(s, "surroundings", &l);
        environment_seen(&e, d, sky);
        const double seen = (double)sky[0];
        give(s, "sky", &seen, 1);
        if (environment_sample(&e, u, &l))
            give_surroundings(s, "sample of the surroundings", &l);
    }
    environment_free(&e);
}

/* ---- samples, textures, surfaces ---- */

static void sweep_samples(sweep *s)
{
    for (int i = 0; i < s->count; i++) {
        const sampler p = sampler_make(i % 640, i / 640, (uint32_t)i * 7U, (uint32_t)random_bits(&s->random));
        double u[2];
        sampler_pair(&p, (uint32_t)i % 40U, u);
        give(s, "sample", u, 2);
    }
}

static void sweep_texture_places(sweep *s)
{
    for (int i = 0; i < s->count; i++) {
        scene_texture which = { .wrap_s = (scene_wrap)(i % 3), .wrap_t = (scene_wrap)(i / 3 % 3) };
        which.rotation = number(s, -7.0, 7.0);
        for (int k = 0; k < 2; k++) {
            which.offset[k] = number(s, -2.0, 2.0);
            which.scale[k] = number(s, -9.0, 9.0);
        }
        texture_point uv;
        float *const all[] = { &uv.s, &uv.t, &uv.dsdx, &uv.dtdx, &uv.dsdy, &uv.dtdy };
        for (int k = 0; k < 6; k++)
            *all[k] = number(s, -5.0, 5.0);
        const texture_point p = texture_transform(&which, &uv);
        const double found[] = { (double)p.s,    (double)p.t,    (double)p.dsdx,
                                 (double)p.dtdx, (double)p.dsdy, (double)p.dtdy };
        give(s, "place on a texture", found, 6);
    }
}

/* Sizes that halve unevenly; colours and data. */
static void sweep_texels(sweep *s)
{
    report r = { 0 };
    for (int i = 0; i < 8; i++) {
        mipmap m;
        const int width = 3 + (int)(random_bits(&s->random) % 60);
        const int height = 3 + (int)(random_bits(&s->random) % 60);
        if (!mipmap_allocate(&m, width, height, i % 2 ? 4 : 3, "swept", &r))
            abort();
        for (int k = 0; k < width * height * m.channel_count; k++)
            m.levels[0].texels[k] = (uint16_t)random_bits(&s->random);
        if (i % 4 < 2 && !mipmap_decode_srgb(&m))
            abort();
        mipmap_build(&m);
        for (int level = 0; level < m.level_count; level++)
            for (int k = 0; k < m.levels[level].width * m.levels[level].height * m.channel_count; k++) {
                const double code = (double)m.levels[level].texels[k];
                give(s, "texel", &code, 1);
            }
        mipmap_free(&m);
    }
}

static void sweep_surfaces(sweep *s)
{
    scene_material material = scene_material_default();
    for (int i = 0; i < s->count; i++) {
        scene_texels t = scene_texels_of(&material);
        float *const all = (float *)&t;
        for (size_t k = 0; k < sizeof t / sizeof(float); k++)
            all[k] = (float)place(s) * 1e-3F; /* lookups give numbers, whatever they are asked */
        const glint_surface surfaces[] = { scene_base_surface(&material, &t), scene_coat_surface(&material, &t) };
        for (int k = 0; k < 2; k++) {
            const glint_surface *const p = &surfaces[k];
            const double found[] = { (double)p->alpha_x, (double)p->alpha_y,    (double)p->f0[0],
                                     (double)p->f90[1],  (double)p->diffuse[2], (double)p->discreteness };
            give(s, "surface", found, sizeof found / sizeof found[0]);
        }
    }
}

void preview_sweep(int count, int any_bits, preview_sink *sink, void *user)
{
    sweep s = { .random = 61, .count = count, .any_bits = any_bits, .sink = sink, .user = user };
    sweep_cameras(&s);
    sweep_lights(&s);
    sweep_surroundings(&s);
    sweep_samples(&s);
    sweep_texture_places(&s);
    sweep_texels(&s);
    sweep_surfaces(&s);
}
