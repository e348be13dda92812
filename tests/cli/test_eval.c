/* glint eval answers as libglint does, bit for bit, and refuses what is no query with its line and column. */
#include <math.h>
#include <poll.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "glint.h"
#include "run_glint.h"
#include "workplace.h"

/* A metal whose numbers are exact in binary: roughness .5 is alpha .25, facet roughness .25 is alpha .0625. */
static const char metal_text[] =
    "{ \"name\": \"metal\", \"pbrMetallicRoughness\": { \"baseColorFactor\": [0.75, 0.5, 0.25, 1], \"metallicFactor\": "
    "1,"
    "  \"roughnessFactor\": 0.5 }, \"extensions\": { \"KHR_materials_specular\": { \"specularFactor\": 0 },"
    "  \"GLINT_materials_glint\": { \"glintFactor\": 1,"
    "  \"glintDensity\": 1048576, \"glintFacetRoughness\": 0.25, \"glintSeed\": 5 } } }";

static const char upright[] = "0 0 1e-3 0 0 1e-3 0 0 1 0 0 1 1e-3 0\n";

static int enter(void **state)
{
    const int result = workplace_enter(state);
    if (result == 0)
        file_write_text("metal.json", metal_text);
    return result;
}

static glint_material *metal_create(glint_model model)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model;
    o.facet_alpha = 0.0625F;
    o.seed = 5;
    o.surface = (glint_surface){ .alpha_x = 0.25F,
                                 .alpha_y = 0.25F,
                                 .f0 = { 0.75F, 0.5F, 0.25F },
                                 .f90 = { 1.0F, 1.0F, 1.0F },
                                 .facets_per_m2 = 1048576.0F,
                                 .discreteness = 1.0F };
    glint_material *material = NULL;
    assert_int_equal(glint_material_create(&o, &material, NULL, 0), GLINT_OK);
    return material;
}

typedef struct query {
    glint_footprint footprint;
    double wo[3], wi[3];
    float solid_angle_sr;
} query;

static double uniform(uint32_t *state)
{
    *state = *state * 1664525U + 1013904223U;
    return (double)(*state >> 8) / 16777216.0;
}

static void random_direction(uint32_t *state, double direction[3])
{
    const double z = 0.05 + 0.95 * uniform(state), phi = 6.28 * uniform(state), r = sqrt(1.0 - z * z);
    direction[0] = r * cos(phi);
    direction[1] = r * sin(phi);
    direction[2] = z;
}

/* Some tens of facets a footprint, lights of a few degrees near the mirror direction: neither all nor none are lit. */
static query random_query(uint32_t *state)
{
    query q = { .footprint = { .u = 10.0 * uniform(state),
                               .v = 10.0 * uniform(state),
                               .dudx = (float)(0.01 * uniform(state)),
                               .dvdx = (float)(0.002 * uniform(state)),
                               .dudy = (float)(0.002 * uniform(state)),
                               .dvdy = (float)(0.01 * uniform(state)),
                               .seed = (uint32_t)(4294967295.0 * uniform(state)) },
                .solid_angle_sr = (float)(0.05 * uniform(state)) };
    random_direction(state, q.wo);
    q.wi[0] = -q.wo[0];
    q.wi[1] = -q.wo[1];
    q.wi[2] = q.wo[2];
    return q;
}

static void print_query(FILE *out, const query *q)
{
    const glint_footprint *f = &q->footprint;
    fprintf(out, "%.17g %.17g  %.9g %.9g %.9g %.9g  %.17g %.17g %.17g  %.17g %.17g %.17g  %.9g %u\n", f->u, f->v,
            (double)f->dudx, (double)f->dudy, (double)f->dvdx, (double)f->dvdy, q->wo[0], q->wo[1], q->wo[2], q->wi[0],
            q->wi[1], q->wi[2], (double)q->solid_angle_sr, f->seed);
}

static glint_value value_of(const glint_material *material, const query *q)
{
    float wo[3], wi[3];
    const double o = sqrt(q->wo[0] * q->wo[0] + q->wo[1] * q->wo[1] + q->wo[2] * q->wo[2]);
    const double i = sqrt(q->wi[0] * q->wi[0] + q->wi[1] * q->wi[1] + q->wi[2] * q->wi[2]);
    for (int k = 0; k < 3; ++k) {
        wo[k] = (float)(q->wo[k] / o);
        wi[k] = (float)(q->wi[k] / i);
    }
    const glint_light light = { GLINT_LIGHT_CAP, q->solid_angle_sr };
    glint_value value;
    glint_eval_value(material, NULL, &q->footprint, wo, wi, &light, &value);
    return value;
}

enum { QUERY_COUNT = 500 };

static char *random_queries(query *queries)
{
    uint32_t state = 7;
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    for (int i = 0; i < QUERY_COUNT; ++i) {
        queries[i] = random_query(&state);
        print_query(out, &queries[i]);
    }
    fclose(out);
    return text;
}

static void assert_answers(const char *model_name, glint_model model, int *discrete)
{
    query queries[QUERY_COUNT];
    char *text = random_queries(queries);
    outcome o = glint_run(&(run_setup){ .input = text }, "eval", "--material", "metal.json", "--model", model_name);
    assert_exit(&o, 0);
    assert_string_equal(o.err, "");
    glint_material *material = metal_create(model);
    const char *line = o.out;
    for (int i = 0; i < QUERY_COUNT; ++i) {
        const glint_value value = value_of(material, &queries[i]);
        char expected[96];
        snprintf(expected, sizeof expected, "%.9g %.9g %.9g\n", (double)value.rgb[0], (double)value.rgb[1],
                 (double)value.rgb[2]);
        if (strncmp(line, expected, strlen(expected)) != 0)
            fail_msg("query %d: found %.60s, expected %s", i, line, expected);
        line += strlen(expected);
        *discrete += value.rgb[0] != value.smooth[0];
    }
    assert_string_equal(line, "");
    glint_material_destroy(material);
    outcome_free(&o);
    free(text);
}

static void answers_are_those_of_the_library(void **state)
{
    (void)state;
    int counting = 0, automatic = 0, smooth = 0;
    assert_answers("counting", GLINT_MODEL_COUNTING, &counting);
    assert_answers("auto", GLINT_MODEL_COUNTING, &automatic);
    assert_answers("smooth", GLINT_MODEL_SMOOTH, &smooth);
    /* Else the three models would not have been told apart. */
    assert_true(counting > QUERY_COUNT / 2);
    assert_int_equal(smooth, 0);
}

/* The metal under a coat of roughness .5, half covered, with glints of its own. */
static void a_coat_lies_over_the_base_unless_one_layer_is_asked_for(void **state)
{
    (void)state;
    char coated[2048];
    snprintf(coated, sizeof coated,
             "%.*s, \"KHR_materials_clearcoat\": { \"clearcoatFactor\": 0.5, "
             "\"clearcoatRoughnessFactor\": 0.5, \"extensions\": { \"GLINT_materials_glint\": { "
             "\"glintFactor\": 1, \"glintDensity\": 65536, \"glintSeed\": 9 } } } } }",
             (int)(strlen(metal_text) - strlen(" } }")), metal_text);
    file_write_text("coated.json", coated);
    glint_material_options base = GLINT_MATERIAL_OPTIONS_INIT, coat = GLINT_MATERIAL_OPTIONS_INIT, o = coat;
    glint_material *made[3];
    made[1] = metal_create(GLINT_MODEL_COUNTING);
    base.facet_alpha = 0.0625F;
    base.seed = 5;
    base.surface = glint_material_surface(made[1]);
    coat.facet_alpha = 0.0025F;
    coat.seed = 9U | 0x80000000U; /* never the base's */
    coat.surface.facets_per_m2 = 65536.0F;
    for (int c = 0; c < 3; ++c)
        coat.surface.f0[c] = 0.04F;
    o.model = GLINT_MODEL_LAYERED;
    o.layers.base = &base;
    o.layers.coat = &coat;
    o.layers.coat_weight = 0.5F;
    assert_int_equal(glint_material_create(&o, &made[0], NULL, 0), GLINT_OK);
    assert_int_equal(glint_material_create(&coat, &made[2], NULL, 0), GLINT_OK);
    static const char *const layers[3] = { "all", "base", "clearcoat" };
    query queries[QUERY_COUNT];
    char *text = random_queries(queries);
    for (int k = 0; k < 3; ++k) {
        outcome r = glint_run(&(run_setup){ .input = text }, "eval", "--material", "coated.json", "--layer", layers[k]);
        assert_exit(&r, 0);
        const char *line = r.out;
        for (int i = 0; i < QUERY_COUNT; ++i) {
            const glint_value value = value_of(made[k], &queries[i]);
            char *end;
            for (int c = 0; c < 3; ++c, line = end)
                assert_true(fabs(strtod(line, &end) - (double)value.rgb[c]) <= 1e-5 * (double)value.rgb[c]);
        }
        outcome_free(&r);
        glint_material_destroy(made[k]);
    }
    free(text);
    assert_refused(glint_run(NULL, "eval", "--material", "metal.json", "--layer", "clearcoat"), 1,
                   "metal.json: --layer clearcoat: found no clear coat, expected a clearcoatFactor above 0");
    assert_refused(glint_run(NULL, "eval", "--material", "metal.json", "--model", "layered"), 2, "layered");
}

static void json_holds_every_value(void **state)
{
    (void)state;
    query queries[QUERY_COUNT];
    char *text = random_queries(queries);
    outcome o = glint_run(&(run_setup){ .input = text }, "eval", "--material", "metal.json", "--json");
    assert_exit(&o, 0);
    json_t *all = json_loads(o.out, JSON_REJECT_DUPLICATES, NULL);
    assert_int_equal(json_array_size(all), QUERY_COUNT);
    glint_material *material = metal_create(GLINT_MODEL_COUNTING);
    for (size_t i = 0; i < QUERY_COUNT; ++i) {
        const glint_value expected = value_of(material, &queries[i]);
        const json_t *one = json_array_get(all, i);
        for (size_t c = 0; c < 3; ++c) {
            assert_true((float)json_number_value(json_array_get(json_object_get(one, "rgb"), c)) == expected.rgb[c]);
            assert_true((float)json_number_value(json_array_get(json_object_get(one, "smooth"), c)) ==
                        expected.smooth[c]);
        }
        assert_true((float)json_number_value(json_object_get(one, "facet_count")) == expected.facet_count);
        assert_true((float)json_number_value(json_object_get(one, "lit_probability")) == expected.lit_probability);
    }
    glint_material_destroy(material);
    json_decref(all);
    outcome_free(&o);
    free(text);
}

static void no_query_gives_no_answer(void **state)
{
    (void)state;
    static const char *const empty[] = { "", "\n\n", "# nothing\n", "   \t\r\n  # nothing" };
    for (size_t i = 0; i < sizeof empty / sizeof empty[0]; ++i) {
        outcome o = glint_run(&(run_setup){ .input = empty[i] }, "eval", "--material", "metal.json");
        assert_exit(&o, 0);
        assert_string_equal(o.out, "");
        outcome_free(&o);
        o = glint_run(&(run_setup){ .input = empty[i] }, "eval", "--material", "metal.json", "--json");
        assert_exit(&o, 0);
        json_t *all = json_loads(o.out, 0, NULL);
        assert_true(json_is_array(all));
        assert_int_equal(json_array_size(all), 0);
        json_decref(all);
        outcome_free(&o);
    }
}

/* The same query in the ways that editors and spreadsheets write it. */
static void layout_of_a_line_does_not_matter(void **state)
{
    (void)state;
    static const char *const layouts[] = {
        "0 0 1e-3 0 0 1e-3 0 0 1 0 0 1 1e-3 0",
        "0 0 1e-3 0 0 1e-3 0 0 1 0 0 1 1e-3 0\r\n",
        "\t0\t0\t.001\t0\t0\t.001\t0\t0\t1\t0\t0\t1\t.001\t0\t\n",
        "# u v\r\n\r\n0 -0 +1e-3 0 0 0.1e-2 0 0 1.0 0 0 1 1E-3 0.0 # trailing\n",
        "0 0 1e-3 0 0 1e-3 0 0 1.0009 0 0 .9991 1e-3 0\n",
    };
    outcome expected = glint_run(&(run_setup){ .input = upright }, "eval", "--material", "metal.json");
    assert_exit(&expected, 0);
    assert_true(strlen(expected.out) > 5);
    for (size_t i = 0; i < sizeof layouts / sizeof layouts[0]; ++i) {
        outcome o = glint_run(&(run_setup){ .input = layouts[i] }, "eval", "--material", "metal.json");
        assert_exit(&o, 0);
        assert_string_equal(o.out, expected.out);
        outcome_free(&o);
    }
    outcome_free(&expected);
}

static void wrong_line_is_named_after_the_answers_before_it(void **state)
{
    (void)state;
    static const struct {
        const char *line, *expected;
    } wrong[] = {
        { "abc", "line 3, column 1 (u): found 'abc', expected a finite number" },
        { "0 nan", "line 3, column 2 (v): found 'nan'" },
        { "0 0 inf", "line 3, column 3 (dudx): found 'inf'" },
        { "0 0 0 1e39", "line 3, column 4 (dudy): found '1e39', expected a finite float" },
        { "1e999", "line 3, column 1 (u): found '1e999'" },
        { "0 0 0 0 0 0 0 0 1.5", "line 3, column 9 (woz): found '1.5', expected a number from -1 to 1" },
        { "0 0 0 0 0 0 0 0 .5 0 0 1 .1 0", "line 3, columns 7 to 9 (wox woy woz): a direction of length 0.5" },
        { "0 0 0 0 0 0 0 0 1 0 0 0 .1 0", "line 3, columns 10 to 12 (wix wiy wiz): a direction of length 0" },
        { "0 0 0 0 0 0 0 0 1 0 0 1.002 .1 0", "line 3, column 12 (wiz)" },
        { "0 0 0 0 0 0 0 0 1 0 0 1 -.1 0", "line 3, column 13 (solid_angle): found '-.1'" },
        { "0 0 0 0 0 0 0 0 1 0 0 1 6.3 0", "line 3, column 13 (solid_angle): found '6.3', expected a number from 0" },
        { "0 0 0 0 0 0 0 0 1 0 0 1 .1 .5", "line 3, column 14 (seed): found '.5', expected a whole number" },
        { "0 0 0 0 0 0 0 0 1 0 0 1 .1 4294967296", "line 3, column 14 (seed)" },
        { "0 0 0 0 0 0 0 0 1 0 0 1 .1 -1", "line 3, column 14 (seed)" },
        { "0 0 0 0 0 0 0 0 1 0 0 1 .1", "line 3, column 14 (seed): the line ends, expected 14 numbers" },
        { "0 0 0 0 0 0 0 0 1 0 0 1 .1 0 0", "line 3: more than 14 numbers" },
        { "0,0,0,0,0,0,0,0,1,0,0,1,.1,0", "line 3, column 1 (u): found '0,0" },
        { "\x1b[31m", "found '?[31m'" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        char input[512];
        snprintf(input, sizeof input, "%s# two\n%s\n%s", upright, wrong[i].line, upright);
        outcome o = glint_run(&(run_setup){ .input = input }, "eval", "--material", "metal.json");
        assert_exit(&o, 1);
        assert_says(o.err, "glint: standard input: ");
        assert_says(o.err, wrong[i].expected);
        assert_non_null(strchr(o.out, '\n'));
        assert_ptr_equal(strchr(o.out, '\n') + 1, o.out + strlen(o.out));
        outcome_free(&o);
        o = glint_run(&(run_setup){ .input = input }, "eval", "--material", "metal.json", "--json");
        assert_exit(&o, 1);
        json_t *all = json_loads(o.out, 0, NULL);
        assert_int_equal(json_array_size(all), 1);
        json_decref(all);
        outcome_free(&o);
    }
}

static void input_that_is_no_text_is_refused(void **state)
{
    (void)state;
    static const char zeros[] = "0 0 0\0 0";
    const run_setup setup = { .input = zeros, .input_size = sizeof zeros - 1 };
    outcome o = glint_run(&setup, "eval", "--material", "metal.json");
    assert_refused(o, 1, "line 1: found a zero byte");
    char *endless = malloc(1000001);
    assert_non_null(endless);
    memset(endless, '1', 1000000);
    endless[1000000] = '\0';
    o = glint_run(&(run_setup){ .input = endless }, "eval", "--material", "metal.json");
    assert_refused(o, 1, "line 1: longer than 4095 characters");
    free(endless);
}

static void hundred_thousand_queries_get_as_many_answers(void **state)
{
    (void)state;
    enum { COUNT = 100000 };
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    uint32_t random = 3;
    for (int i = 0; i < COUNT; ++i) {
        const query q = random_query(&random);
        print_query(out, &q);
    }
    fclose(out);
    outcome o = glint_run(&(run_setup){ .input = text }, "eval", "--material", "metal.json");
    assert_exit(&o, 0);
    int lines = 0;
    for (const char *c = o.out; *c; ++c)
        lines += *c == '\n';
    assert_int_equal(lines, COUNT);
    outcome_free(&o);
    free(text);
}

/* As a program does that keeps one glint eval running: ask, wait for the answer, ask again. */
static void each_answer_comes_before_the_next_question(void **state)
{
    (void)state;
    int question[2], answer[2];
    assert_int_equal(pipe(question), 0);
    assert_int_equal(pipe(answer), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(question[0], STDIN_FILENO);
        dup2(answer[1], STDOUT_FILENO);
        close(question[1]);
        close(answer[0]);
        execl(GLINT_COMMAND, "glint", "eval", "--material", "metal.json", (char *)NULL);
        _exit(1);
    }
    close(question[0]);
    close(answer[1]);
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(write(question[1], upright, strlen(upright)), strlen(upright));
        struct pollfd ready = { .fd = answer[0], .events = POLLIN };
        assert_int_equal(poll(&ready, 1, 30000), 1);
        char text[256];
        const ssize_t length = read(answer[0], text, sizeof text);
        assert_true(length > 0 && text[length - 1] == '\n');
    }
    close(question[1]);
    close(answer[0]);
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

static void full_disk_behind_standard_output_is_an_error(void **state)
{
    (void)state;
    static const char *const formats[] = { "--model=auto", "--json" };
    for (int i = 0; i < 2; ++i) {
        const run_setup setup = { .input = upright, .output = "/dev/full" };
        assert_refused(glint_run(&setup, "eval", "--material", "metal.json", formats[i]), 1,
                       "glint: standard output: No space left on device");
    }
}

static void material_that_cannot_be_read_is_named(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "eval", "--material", "missing.json"), 1, "missing.json");
    assert_refused(glint_run(NULL, "eval", "--material", "craft-gliter"), 1, "craft-glitter");
    file_write_text("broken.json", "{ \"pbrMetallicRoughness\": { \"roughnessFactor\": 7 } }");
    assert_refused(glint_run(NULL, "eval", "--material", "broken.json"), 1, "roughnessFactor");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_those_of_the_library),
        cmocka_unit_test(a_coat_lies_over_the_base_unless_one_layer_is_asked_for),
        cmocka_unit_test(json_holds_every_value),
        cmocka_unit_test(no_query_gives_no_answer),
        cmocka_unit_test(layout_of_a_line_does_not_matter),
        cmocka_unit_test(wrong_line_is_named_after_the_answers_before_it),
        cmocka_unit_test(input_that_is_no_text_is_refused),
        cmocka_unit_test(hundred_thousand_queries_get_as_many_answers),
        cmocka_unit_test(each_answer_comes_before_the_next_question),
        cmocka_unit_test(full_disk_behind_standard_output_is_an_error),
        cmocka_unit_test(material_that_cannot_be_read_is_named),
    };
    return cmocka_run_group_tests_name("eval", tests, enter, workplace_leave);
}
