/* The smooth reflection in lanes: every width gives the bits of a single evaluation, for every lobe there is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "model/lobe.h"
#include "model/lobe_kernel.h"
#include "statistics.h"

/* Points of one material with a surface each. */
typedef struct crowd {
    struct glint_material material;
    glint_surface surface[LOBE_MOST];
    model_query query[LOBE_MOST];
} crowd;

static vec3 direction(uint64_t *random)
{
    /* Down to the ground, where quotients are largest. */
    const double z = random_log_between(random, 1e-6, 1.0), turn = random_between(random, 0.0, 6.2831853);
    const double sine = sqrt(1.0 - z * z);
    return (vec3){ (float)(sine * cos(turn)), (float)(sine * sin(turn)), (float)z };
}

static void fill(crowd *c, uint64_t *random)
{
    for (int i = 0; i < LOBE_MOST; i++) {
        glint_surface *s = &c->surface[i];
        s->alpha_x = (float)random_log_between(random, 1e-4, 1.0);
        s->alpha_y = random_bits(random) % 2 ? s->alpha_x : (float)random_log_between(random, 1e-4, 1.0);
        const int is_metal = random_bits(random) % 3 == 0;
        for (int k = 0; k < 3; k++) {
            s->diffuse[k] = is_metal ? 0.0F : (float)random_between(random, 0.0, 1.0);
            s->f0[k] = random_bits(random) % 8 == 0 ? 1.0F : (float)random_between(random, 0.0, 1.0);
            s->f90[k] = (float)random_between(random, 0.0, 1.0);
        }
        model_query *q = &c->query[i];
        *q = (model_query){ .material = &c->material, .surface = s, .wo = direction(random), .wi = direction(random) };
        /* Mirrored views have their half vector at the peak, opposite ones along the ground. */
        if (random_bits(random) % 4 == 0)
            q->wi = (vec3){ -q->wo.x, -q->wo.y, q->wo.z };
        q->solid_angle_sr = random_bits(random) % 5 == 0 ? 0.0F : (float)random_log_between(random, 1e-8, 6.28);
        q->total_area = random_bits(random) % 2 ? 0.0F : (float)random_between(random, 1.0, 2.0);
    }
}

static void gather(const crowd *c, lobe_points *p)
{
    for (int i = 0; i < LOBE_MOST; i++) {
        const model_query *q = &c->query[i];
        const float wo[3] = { q->wo.x, q->wo.y, q->wo.z }, wi[3] = { q->wi.x, q->wi.y, q->wi.z };
        for (int k = 0; k < 3; k++) {
            p->wo[k][i] = wo[k];
            p->wi[k][i] = wi[k];
            p->diffuse[k][i] = q->surface->diffuse[k];
            p->f0[k][i] = q->surface->f0[k];
            p->f90[k][i] = q->surface->f90[k];
        }
        p->alpha_x[i] = q->surface->alpha_x;
        p->alpha_y[i] = q->surface->alpha_y;
        p->total_area[i] = q->total_area;
        p->solid_angle[i] = q->solid_angle_sr;
    }
}

static void assert_same(float found, float expected)
{
    assert_memory_equal(&found, &expected, sizeof(found));
}

static void check_one(const model_query *q, const lobe_lit *lit, int i)
{
    lobe_value v;
    lobe_eval(q, &v);
    for (int c = 0; c < 3; c++) {
        assert_same(lit->specular[c][i], v.specular[c]);
        assert_same(lit->diffuse[c][i], v.diffuse[c]);
    }
    const float solid_angle = lobe_lit_solid_angle(q, &v);
    assert_same(lit->h[0][i], v.h.x);
    assert_same(lit->h[1][i], v.h.y);
    assert_same(lit->cap[i], solid_angle * v.h.z);
    assert_same(lit->p[i], lobe_lit_probability(q, &v, solid_angle));
}

/* Whatever fills the options, three hundred points a lobe. */
static void check_lobe(crowd *c, uint64_t *random)
{
    for (int round = 0; round < 5; round++) {
        lobe_points points;
        static lobe_lit lit;
        fill(c, random);
        gather(c, &points);
        for (size_t lanes = 1; lanes <= 16; lanes = lanes == 1 ? 4 : 2 * lanes) {
            memset(&lit, 0, sizeof(lit));
            lobe_kernel_widest(lanes)(&c->material.options, &points, LOBE_MOST, 1, &lit);
            for (int i = 0; i < LOBE_MOST; i++)
                check_one(&c->query[i], &lit, i);
        }
        /* A count that is no multiple of any width. */
        memset(&lit, 0, sizeof(lit));
        lobe_eval_many(c->query, 61, 1, &lit);
        for (int i = 0; i < 61; i++)
            check_one(&c->query[i], &lit, i);
    }
}

static void every_width_gives_the_bits_of_one_point(void **state)
{
    (void)state;
    uint64_t random = 31;
    static crowd c;
    for (int k = 0; k < 2 * 3 * 2 * 3; k++) {
        const glint_material_options init = GLINT_MATERIAL_OPTIONS_INIT;
        glint_material_options *o = &c.material.options;
        *o = init;
        o->distribution = k % 2 ? GLINT_DISTRIBUTION_GGX : GLINT_DISTRIBUTION_BECKMANN;
        o->fresnel = (glint_fresnel)(k / 2 % 3);
        o->weighting = k / 6 % 2 ? GLINT_WEIGHTING_EQUAL_AREA : GLINT_WEIGHTING_EQUAL_PROJECTED_AREA;
        static const float facet_alpha[3] = { 0.0F, 1e-4F, 0.2F };
        o->facet_alpha = facet_alpha[k / 12];
        o->coverage = (float)random_between(&random, 0.1, 1.0);
        for (int i = 0; i < 3; i++) {
            o->eta[i] = (float)random_log_between(&random, 0.05, 4.0);
            o->k[i] = (float)random_between(&random, 0.0, 7.0);
        }
        check_lobe(&c, &random);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_width_gives_the_bits_of_one_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
