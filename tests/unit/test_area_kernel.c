/* Lights of real size in lanes: every width gives the bits of a single evaluation, whatever the light; and what few
 * points know of a plain light is its integral. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "area_cases.h"
#include "model/area.h"
#include "model/area_kernel.h"
#include "model/area_nodes.h"
#include "ndf/ndf.h"

/* Points of one material with a surface and a light each. */
typedef struct crowd {
    struct glint_material material;
    glint_surface surface[LOBE_MOST];
    glint_area_light light[LOBE_MOST];
    model_query query[LOBE_MOST];
} crowd;

static float any_float(uint64_t *random)
{
    const uint32_t bits = (uint32_t)random_bits(random);
    float x;
    memcpy(&x, &bits, sizeof(x));
    return x;
}

/* Below the horizon, which wide lights look over. */
static void flip(glint_area_light *l)
{
    l->center[2] = -l->center[2];
    for (uint32_t i = 0; i < l->corner_count; i++)
        l->corners[i][2] = -l->corners[i][2];
}

/* Most as lights are, some with numbers of any bits, some of any length. */
static glint_area_light any_light(uint64_t *random, float wo[3])
{
    area_case c = area_case_of(random, 0);
    memcpy(wo, c.wo, sizeof(c.wo));
    if (random_bits(random) % 2)
        c.light = area_light_towards(random, c.light.kind, c.light.center, random_log_between(random, 1e-9, 1e-2));
    c.light.two_sided = random_bits(random) % 2;
    c.light.hidden = random_bits(random) % 2 ? 0.0F : (float)random_between(random, -0.1, 1.1);
    if (random_bits(random) % 4 == 0)
        flip(&c.light);
    const float scale = random_bits(random) % 4 ? 1.0F : ldexpf(1.0F, (int)(random_bits(random) % 120) - 60);
    for (int k = 0; k < 3; k++) {
        c.light.center[k] *= scale;
        c.light.half_x[k] *= scale;
        c.light.half_y[k] *= scale;
        for (uint32_t i = 0; i < c.light.corner_count; i++)
            c.light.corners[i][k] *= scale;
    }
    float *const numbers[7] = { &c.light.center[random_bits(random) % 3],
                                &c.light.half_x[random_bits(random) % 3],
                                &c.light.half_y[random_bits(random) % 3],
                                &c.light.radius,
                                &c.light.solid_angle_sr,
                                &c.light.hidden,
                                &c.light.corners[random_bits(random) % 8][random_bits(random) % 3] };
    if (random_bits(random) % 8 == 0)
        *numbers[random_bits(random) % 7] = any_float(random);
    return c.light;
}

static void fill(crowd *c, uint64_t *random)
{
    for (int i = 0; i < LOBE_MOST; i++) {
        glint_surface *s = &c->surface[i];
        s->alpha_x = (float)random_log_between(random, 1e-4, 1.0);
        s->alpha_y = random_bits(random) % 4 ? s->alpha_x : (float)random_log_between(random, 1e-2, 1.0);
        const int is_metal = random_bits(random) % 3 == 0;
        for (int k = 0; k < 3; k++) {
            s->diffuse[k] = is_metal ? 0.0F : (float)random_between(random, 0.0, 1.0);
            s->f0[k] = (float)random_between(random, 0.0, 1.0);
            s->f90[k] = (float)random_between(random, 0.0, 1.0);
        }
        float wo[3];
        c->light[i] = any_light(random, wo);
        c->query[i] = (model_query){ .material = &c->material,
                                     .surface = s,
                                     .area_light = &c->light[i],
                                     .wo = { wo[0], wo[1], wo[2] },
                                     .total_area = random_bits(random) % 2 ? 0.0F : 1.5F };
    }
}

static void assert_same(float found, float expected)
{
    assert_memory_equal(&found, &expected, sizeof(found));
}

static void check(const area_value *v, const lobe_lit *lit, int i)
{
    for (int c = 0; c < 3; c++) {
        assert_same(lit->specular[c][i], v->specular[c]);
        assert_same(lit->diffuse[c][i], v->diffuse[c]);
    }
    assert_same(lit->h[0][i], v->h.x);
    assert_same(lit->h[1][i], v->h.y);
    assert_same(lit->cap[i], v->cap);
    assert_same(lit->p[i], v->lit_probability);
}

static void gather(const crowd *c, area_crowd *p)
{
    for (int i = 0; i < LOBE_MOST; i++) {
        const model_query *q = &c->query[i];
        const glint_area_light *l = q->area_light;
        const float wo[3] = { q->wo.x, q->wo.y, q->wo.z };
        for (int k = 0; k < 3; k++) {
            p->wo[k][i] = wo[k];
            p->diffuse[k][i] = q->surface->diffuse[k];
            p->f0[k][i] = q->surface->f0[k];
            p->f90[k][i] = q->surface->f90[k];
            p->center[k][i] = l->center[k];
            p->half_x[k][i] = l->half_x[k];
            p->half_y[k][i] = l->half_y[k];
        }
        p->alpha_x[i] = q->surface->alpha_x;
        p->alpha_y[i] = q->surface->alpha_y;
        p->total_area[i] = q->total_area;
        p->hidden[i] = l->hidden >= 0.0F ? fminf(l->hidden, 1.0F) : 0.0F;
        p->kind[i] = (int32_t)l->kind;
        p->two_sided[i] = (int32_t)l->two_sided;
        p->size[i] = l->kind == GLINT_AREA_SPHERE ? l->radius : l->solid_angle_sr;
        const uint32_t corners = l->kind == GLINT_AREA_POLYGON && l->corner_count <= 8U ? l->corner_count : 0U;
        p->corner_count[i] = (int32_t)corners;
        for (uint32_t k = 0; k < 8U; k++)
            for (int axis = 0; axis < 3; axis++)
                p->corner[k][axis][i] = corners ? l->corners[k < corners ? k : 0U][axis] : 0.0F;
    }
    p->most_corners = 8;
}

/* How many lights there were of each kind. */
typedef struct census {
    int all, plain, mixed;
} census;

static void check_widths(const crowd *c, census *n)
{
    area_crowd points;
    static lobe_lit lit;
    gather(c, &points);
    for (size_t lanes = 1; lanes <= 16; lanes = lanes == 1 ? 4 : 2 * lanes) {
        float left[LOBE_MOST];
        memset(&lit, 0, sizeof(lit));
        area_kernel_widest(lanes)(&c->material.options, &points, LOBE_MOST, 1, &lit, left);
        for (int i = 0; i < LOBE_MOST; i++) {
            area_value v;
            assert_same(left[i], area_eval_plain(&c->query[i], &v));
            if (left[i] < 1.0F)
                check(&v, &lit, i);
            n->all++;
            n->plain += left[i] < 1.0F;
            n->mixed += left[i] > 0.0F && left[i] < 1.0F;
        }
    }
}

/* A count that is no multiple of any width, polygons and lights that are not plain among them. */
static void check_many(const crowd *c)
{
    static lobe_lit lit;
    memset(&lit, 0, sizeof(lit));
    area_eval_many(c->query, 61, 1, &lit);
    for (int i = 0; i < 61; i++) {
        area_value v;
        area_eval(&c->query[i], &v);
        check(&v, &lit, i);
    }
}

static glint_material_options options_of(int k, uint64_t *random)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.distribution = k % 2 ? GLINT_DISTRIBUTION_GGX : GLINT_DISTRIBUTION_BECKMANN;
    o.fresnel = (glint_fresnel)(k / 2 % 3);
    o.weighting = k / 6 % 2 ? GLINT_WEIGHTING_EQUAL_AREA : GLINT_WEIGHTING_EQUAL_PROJECTED_AREA;
    o.facet_alpha = k / 12 ? 0.1F : 0.0F;
    o.coverage = (float)random_between(random, 0.1, 1.0);
    for (int i = 0; i < 3; i++) {
        o.eta[i] = (float)random_log_between(random, 0.05, 4.0);
        o.k[i] = (float)random_between(random, 0.0, 7.0);
    }
    return o;
}

static void every_width_gives_the_bits_of_one_point(void **state)
{
    (void)state;
    uint64_t random = 61;
    static crowd c;
    census n = { 0, 0, 0 };
    for (int k = 0; k < 24; k++) {
        c.material.options = options_of(k, &random);
        for (int round = 0; round < 4; round++) {
            fill(&c, &random);
            check_widths(&c, &n);
            check_many(&c);
        }
    }
    printf("%d lights, %d of them plain, %d in part\n", n.all, n.plain, n.mixed);
    assert_true(n.plain > n.all / 3 && n.plain < n.all && n.mixed > 0);
}

/* ---- the integral ---- */

/* 1 - value / expected, and so that it says what it was. */
static void assert_near(double found, double expected, double bound, const char *what, const area_case *c)
{
    if (fabs(found - expected) > bound * expected)
        fail_msg("%s: %g, expected %g, off by %.2g; kind %d, %g sr, alpha %g, %g, view %g degrees", what, found,
                 expected, found / expected - 1.0, (int)c->light.kind, (double)c->light.solid_angle_sr, c->lobe.alpha_x,
                 c->lobe.alpha_y, c->view * 180.0 / AREA_PI);
}

/* A lobe that reflects all, so that values are its integrals. */
static model_query query_of(const area_case *c, glint_surface *s, struct glint_material *m)
{
    *s = (glint_surface){ .alpha_x = (float)c->lobe.alpha_x, .alpha_y = (float)c->lobe.alpha_y };
    for (int k = 0; k < 3; k++) {
        s->f0[k] = s->f90[k] = 1.0F;
        s->diffuse[k] = 0.0F;
    }
    const glint_material_options init = GLINT_MATERIAL_OPTIONS_INIT;
    m->options = init;
    m->options.distribution = c->lobe.is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    m->options.weighting = GLINT_WEIGHTING_EQUAL_PROJECTED_AREA;
    m->options.coverage = 1.0F;
    return (
        model_query){ .material = m, .surface = s, .area_light = &c->light, .wo = { c->wo[0], c->wo[1], c->wo[2] } };
}

/* The rules leave 3e-4 of a pole at the limits in area_plain.h; ten times that for lobes, whose poles are of second
 * order, whose masking bends too, and which are summed over two dimensions. The brute force is within 1e-3 itself. */
static void points_of_a_plain_light_are_its_integral(void **state)
{
    (void)state;
    uint64_t random = 62;
    int count = 0;
    for (int i = 0; i < 1200; i++) {
        area_case c = area_case_of(&random, i % 2);
        if (i % 3 == 0)
            flip(&c.light);
        glint_surface s;
        static struct glint_material m;
        const model_query q = query_of(&c, &s, &m);
        area_value v;
        if (!(area_eval_plain(&q, &v) < 1.0F))
            continue;
        const area_truth truth = area_truth_of(&c.lobe, c.wo, &c.light, 200);
        if (!area_is_lit(&truth))
            continue;
        count++;
        assert_near((double)v.specular[0], truth.specular, 0.004, "reflection", &c);
        assert_near((double)v.lit_probability, truth.projected, 0.004, "lit facets", &c);
    }
    printf("%d lights\n", count);
    assert_true(count > 300);
}

/* Wide lights, those that the horizon cuts, and anisotropic lobes; not those that are plain. A cell has the errors of a
 * plain light, but where the peak of the lobe is within: a hundredth. The brute force's points miss a part of its rows
 * that the horizon cuts, one of 400. */
static void parts_of_a_light_are_its_integral(void **state)
{
    (void)state;
    uint64_t random = 63;
    int count = 0, cut = 0;
    for (int i = 0; i < 900; i++) {
        area_case c = area_case_of(&random, i % 2);
        glint_surface s;
        static struct glint_material m;
        const model_query q = query_of(&c, &s, &m);
        area_value v;
        area_light light;
        if (!(area_eval_plain(&q, &v) > 0.0F) || !area_see(&q, &light) || area_eval_parts(&q, &light, &v) > 0.0F)
            continue;
        const area_truth truth = area_truth_of(&c.lobe, c.wo, &c.light, 400);
        if (!area_is_lit(&truth))
            continue;
        count++;
        cut += light.kind == AREA_CONIC ? !light.is_whole : light.corner_count > (int)c.light.corner_count;
        assert_near((double)v.specular[0], truth.specular, 0.015, "reflection", &c);
        assert_near((double)v.lit_probability, truth.projected, 0.015, "lit facets", &c);
    }
    printf("%d lights in parts, %d of them cut\n", count, cut);
    assert_true(count > 100 && cut > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_width_gives_the_bits_of_one_point),
        cmocka_unit_test(points_of_a_plain_light_are_its_integral),
        cmocka_unit_test(parts_of_a_light_are_its_integral),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
