/* Batches and threads: every model gives the bits of single calls, whoever asks and however many at a time. */
#include "contract.h"

#include <pthread.h>
#include <string.h>

#include "area_cases.h"
#include "batch_points.h"

enum { BATCH = 1000 };

typedef struct batch_arrays {
    batch_points points;
    glint_surface surface[BATCH];
} batch_arrays;

static void fill(batch_arrays *a, const glint_material *m, uint64_t *random)
{
    for (int i = 0; i < BATCH; i++) {
        const glint_footprint f = random_footprint(random);
        float wo[3], wi[3];
        random_direction(random, wo);
        random_direction(random, wi);
        for (int k = 0; k < 3; k++)
            wi[k] = i % 17 == 0 ? -wi[k] : wi[k]; /* some below the horizon */
        batch_points_place(&a->points, i, &f);
        batch_points_light(&a->points, i, wo, wi, (float)random_log_between(random, 1e-6, 1.0));
        a->surface[i] = glint_material_surface(m);
        a->surface[i].alpha_x = (float)random_log_between(random, 1e-3, 1.0);
        a->surface[i].facets_per_m2 = i % 13 == 0 ? 0.0F : (float)random_log_between(random, 1.0, 1e12);
    }
}

/* Every second entry and more of them are another light at the point before; one in eleven has as many facets as it
 * had.
 */
static void put_together(batch_arrays *a, uint64_t *random)
{
    for (int i = 1; i < BATCH; i++) {
        if (random_bits(random) % 8 < 3)
            continue;
        const glint_footprint before = batch_points_footprint(&a->points, i - 1);
        batch_points_place(&a->points, i, &before);
        if (i % 11 != 0)
            a->surface[i].facets_per_m2 = a->surface[i - 1].facets_per_m2;
    }
}

static glint_batch batch_of(batch_arrays *a, int with_surfaces)
{
    glint_batch b = batch_points_of(&a->points, BATCH);
    b.surfaces = with_surfaces ? a->surface : NULL;
    return b;
}

static void batch_gives_the_bits_of_single_calls(void **state)
{
    (void)state;
    static batch_arrays a;
    static glint_value values[BATCH];
    uint64_t random = 6;
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int kind = 0; kind < 3; kind++) {
        const int with_surfaces = kind > 0;
        fill(&a, m, &random);
        if (kind == 2)
            put_together(&a, &random);
        glint_batch b = batch_of(&a, with_surfaces);
        b.values = values;
        assert_int_equal(glint_eval_batch(m, &b), GLINT_OK);
        for (int i = 0; i < BATCH; i++) {
            const batch_points *const p = &a.points;
            const glint_footprint f = batch_points_footprint(p, i);
            const float wo[3] = { p->wo[0][i], p->wo[1][i], p->wo[2][i] };
            const float wi[3] = { p->wi[0][i], p->wi[1][i], p->wi[2][i] };
            const glint_light light = { GLINT_LIGHT_CAP, p->solid_angle_sr[i] };
            float rgb[3];
            glint_eval(m, with_surfaces ? &a.surface[i] : NULL, &f, wo, wi, &light, rgb);
            for (int k = 0; k < 3; k++)
                assert_memory_equal(&rgb[k], &p->rgb[k][i], sizeof(float));
            glint_value value;
            glint_eval_value(m, with_surfaces ? &a.surface[i] : NULL, &f, wo, wi, &light, &value);
            assert_memory_equal(&value, &values[i], sizeof(value));
        }
    }
    contract_kept(12, "A batch gives the bits of single calls", "batches", NULL);
}

static void batch_with_a_missing_array_is_refused(void **state)
{
    (void)state;
    static batch_arrays a;
    const glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    glint_material *m = create(&o);
    glint_batch b = batch_of(&a, 0);
    b.wi[1] = NULL;
    assert_int_equal(glint_eval_batch(m, &b), GLINT_ERROR_ARGUMENT);
    b = batch_of(&a, 0);
    b.size = 0;
    assert_int_equal(glint_eval_batch(m, &b), GLINT_ERROR_ARGUMENT);
    assert_int_equal(glint_eval_batch(m, NULL), GLINT_ERROR_ARGUMENT);
    glint_material_destroy(m);
}

typedef struct job {
    const glint_material *material;
    batch_arrays *arrays;
} job;

static void *evaluate(void *argument)
{
    const job *j = argument;
    const glint_batch b = batch_of(j->arrays, 1);
    for (int i = 0; i < 5; i++)
        glint_eval_batch(j->material, &b);
    return NULL;
}

static void threads_may_share_a_material(void **state)
{
    (void)state;
    static batch_arrays a[3];
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        uint64_t random = 7;
        fill(&a[0], m, &random);
        a[1] = a[2] = a[0];
        pthread_t thread[2];
        job jobs[3] = { { m, &a[0] }, { m, &a[1] }, { m, &a[2] } };
        for (int i = 0; i < 2; i++)
            assert_int_equal(pthread_create(&thread[i], NULL, evaluate, &jobs[i]), 0);
        evaluate(&jobs[2]);
        for (int i = 0; i < 2; i++)
            pthread_join(thread[i], NULL);
        assert_memory_equal(a[0].points.rgb, a[2].points.rgb, sizeof(a[0].points.rgb));
        assert_memory_equal(a[1].points.rgb, a[2].points.rgb, sizeof(a[1].points.rgb));
    }
    contract_kept(13, "Threads may share a material, and get the same bits", "batches", NULL);
}

/* ---- lights of real size ---- */

enum { LIGHTS = 64 };

typedef struct light_job {
    const glint_material *material;
    const area_case *cases;
    int from; /* where to begin: threads meet at different lights */
    glint_value values[LIGHTS];
} light_job;

static void *light_up(void *argument)
{
    light_job *j = argument;
    for (int k = 0; k < LIGHTS; k++) {
        const int i = (j->from + k) % LIGHTS;
        const glint_footprint f = { 1e-2 * i, 1e-2, 3e-4F, 1e-4F, 0.0F, 3e-4F, (uint32_t)i };
        glint_eval_area(j->material, NULL, &f, j->cases[i].wo, &j->cases[i].light, &j->values[i]);
    }
    return NULL;
}

/* Dictionary and example draw points of the light by hashes, which must belong to the query and not to a thread. */
static void lights_of_real_size_are_the_same_on_every_thread(void **state)
{
    (void)state;
    static area_case cases[LIGHTS];
    static light_job jobs[3];
    uint64_t random = 8;
    for (int i = 0; i < LIGHTS; i++)
        cases[i] = area_case_of(&random, 0);
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        pthread_t thread[2];
        memset(jobs, 0, sizeof(jobs));
        for (int i = 0; i < 3; i++) {
            jobs[i].material = m;
            jobs[i].cases = cases;
            jobs[i].from = i * LIGHTS / 3;
        }
        for (int i = 0; i < 2; i++)
            assert_int_equal(pthread_create(&thread[i], NULL, light_up, &jobs[i]), 0);
        for (int i = 0; i < 2; i++)
            pthread_join(thread[i], NULL);
        light_up(&jobs[2]);
        for (int i = 0; i < 2; i++)
            assert_memory_equal(jobs[i].values, jobs[2].values, sizeof(jobs[2].values));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(batch_gives_the_bits_of_single_calls),
        cmocka_unit_test(batch_with_a_missing_array_is_refused),
        cmocka_unit_test(threads_may_share_a_material),
        cmocka_unit_test(lights_of_real_size_are_the_same_on_every_thread),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
