/* glint eval: a material's radiance factor for queries on standard input, so that other programs can ask libglint. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/eval_query.h"
#include "io/example_map.h"
#include "io/scene_file.h"
#include "scene/surface.h"

typedef struct eval_values {
    const char *material;
    int model; /* see arguments_model_choice */
    int layer; /* see layer_choice */
    double accuracy;
    bool json;
} eval_values;

enum { LAYER_ALL, LAYER_BASE, LAYER_CLEARCOAT };

static const char *layer_choice(int index)
{
    static const char *const names[] = { [LAYER_ALL] = "all", [LAYER_BASE] = "base", [LAYER_CLEARCOAT] = "clearcoat" };
    return index <= LAYER_CLEARCOAT ? names[index] : NULL;
}

static const argument_rule rules[] = {
    { .name = "material",
      .value = "PRESET",
      .help = "a preset (see glint materials) or a path to one; required",
      .kind = ARGUMENT_TEXT,
      .target = offsetof(eval_values, material) },
    { .name = "model",
      .help = "of each layer; auto is what it asks for: example, dictionary or counting",
      .kind = ARGUMENT_CHOICE,
      .choice = arguments_model_choice,
      .target = offsetof(eval_values, model) },
    { .name = "layer",
      .help = "the whole material, or one layer by itself (all)",
      .kind = ARGUMENT_CHOICE,
      .choice = layer_choice,
      .target = offsetof(eval_values, layer) },
    { .name = "accuracy",
      .value = "X",
      .help = "deviation of the facets that may be left out, relative; 0 counts all (0)",
      .kind = ARGUMENT_NUMBER,
      .min = 0,
      .max = 1,
      .target = offsetof(eval_values, accuracy) },
    { .name = "json",
      .help = "print an array of objects",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(eval_values, json) },
};

static const argument_syntax syntax = {
    .command = "glint eval",
    .operands = "--material PRESET",
    .summary = "Reads one query a line on standard input, fourteen numbers parted by blanks:\n"
               "  u v  dudx dudy dvdx dvdy  wox woy woz  wix wiy wiz  solid_angle seed\n"
               "and writes one line of r g b for each: f(wo, wi) * |cos theta_i|. Lengths are metres, the\n"
               "solid angle steradians, directions unit vectors away from the surface (z is the normal).",
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

/* One layer before its material is made. The normals are what options.example.normals points to. */
typedef struct layer_plan {
    glint_material_options options;
    float *normals;
} layer_plan;

static bool plan_layer(const eval_values *values, const scene *s, const scene_material *m, scene_glint_layer layer,
                       layer_plan *out, report *r)
{
    const scene_glint *const g = scene_layer_glint(m, layer);
    const glint_model automatic = g != NULL ? scene_model_of(g) : GLINT_MODEL_SMOOTH;
    const glint_model model = values->model == 0 ? automatic : (glint_model)(values->model - 1);
    out->options = layer == SCENE_LAYER_BASE ? scene_base_options(m, model) : scene_coat_options(m, model);
    out->options.smooth_deviation = (float)values->accuracy;
    if (g == NULL || out->options.model != GLINT_MODEL_EXAMPLE)
        return true;
    if (g->structure != SCENE_STRUCTURE_EXAMPLE)
        report_warning(r,
                       "%s: has no glintExampleTexture for the example model; 16 x 16 flat facets that follow its "
                       "roughness stand in",
                       values->material);
    return example_map_open(s, g, &out->options, &out->normals, r);
}

static glint_material *create(const eval_values *values, const glint_material_options *options, report *r)
{
    glint_material *material = NULL;
    char message[256] = "";
    if (glint_material_create(options, &material, message, sizeof message) != GLINT_OK)
        report_error(r, "%s: %s", values->material, message);
    return material;
}

static glint_material *create_layer(const eval_values *values, const scene *s, const scene_material *m,
                                    scene_glint_layer layer, report *r)
{
    layer_plan plan = { 0 };
    glint_material *material = plan_layer(values, s, m, layer, &plan, r) ? create(values, &plan.options, r) : NULL;
    free(plan.normals);
    return material;
}

/* The layer that is asked for, or both, one over the other. */
static glint_material *create_layers(const eval_values *values, const scene *s, const scene_material *m, report *r)
{
    const bool has_coat = m->clearcoat > 0.0F;
    if (values->layer == LAYER_CLEARCOAT && !has_coat) {
        report_error(r, "%s: --layer clearcoat: found no clear coat, expected a clearcoatFactor above 0",
                     values->material);
        return NULL;
    }
    if (values->layer != LAYER_ALL || !has_coat)
        return create_layer(values, s, m, values->layer == LAYER_CLEARCOAT ? SCENE_LAYER_CLEARCOAT : SCENE_LAYER_BASE,
                            r);
    layer_plan base = { 0 }, coat = { 0 };
    glint_material *material = NULL;
    if (plan_layer(values, s, m, SCENE_LAYER_BASE, &base, r) &&
        plan_layer(values, s, m, SCENE_LAYER_CLEARCOAT, &coat, r)) {
        glint_material_options both = GLINT_MATERIAL_OPTIONS_INIT;
        both.model = GLINT_MODEL_LAYERED;
        both.layers.base = &base.options;
        both.layers.coat = &coat.options;
        both.layers.coat_weight = m->clearcoat;
        material = create(values, &both, r);
    }
    free(base.normals);
    free(coat.normals);
    return material;
}

static glint_material *open_material(const eval_values *values, report *r)
{
    scene s = { 0 };
    scene_material m;
    if (!preset_read(values->material, &s, &m, r)) {
        scene_free(&s);
        return NULL;
    }
    glint_material *material = create_layers(values, &s, &m, r);
    free(m.name);
    scene_free(&s);
    return material;
}

static bool write_text(const glint_material *material, const eval_query *q)
{
    float rgb[3];
    glint_eval(material, NULL, &q->footprint, q->wo, q->wi, &q->light, rgb);
    return printf("%.9g %.9g %.9g\n", (double)rgb[0], (double)rgb[1], (double)rgb[2]) > 0;
}

static bool write_object(const glint_material *material, const eval_query *q, bool first)
{
    glint_value value;
    glint_eval_value(material, NULL, &q->footprint, q->wo, q->wi, &q->light, &value);
    document *d = document_object();
    document_set_numbers(d, "rgb", value.rgb, 3);
    document_set_numbers(d, "smooth", value.smooth, 3);
    document_set_number(d, "facet_count", (double)value.facet_count);
    document_set_number(d, "lit_probability", (double)value.lit_probability);
    fputs(first ? "\n" : ",\n", stdout);
    return document_print(d, stdout);
}

/* Answers up to the end of the input or to the first query that cannot be answered. */
static bool answer(const glint_material *material, bool json, report *r)
{
    size_t line_number = 0;
    for (bool first = true;; first = false) {
        eval_query query;
        const eval_query_result result = eval_query_read(stdin, &line_number, &query, r);
        if (result != EVAL_QUERY_READ)
            return result == EVAL_QUERY_END;
        const bool written = json ? write_object(material, &query, first) : write_text(material, &query);
        if (ferror(stdout))
            return report_error(r, "standard output: %s", strerror(errno));
        if (!written)
            return report_error(r, "standard input: line %zu: out of memory for the answer", line_number);
    }
}

static int answer_all(const glint_material *material, bool json, report *r)
{
    /* A program that asks through a pipe waits for each answer before it asks again. */
    setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
    if (json)
        putchar('[');
    const bool done = answer(material, json, r);
    if (ferror(stdout))
        clearerr(stdout); /* the report has it */
    else if (json)
        fputs("\n]\n", stdout);
    if (done)
        return COMMAND_DONE;
    fprintf(stderr, "glint: %s\n", r->error);
    return COMMAND_BAD_INPUT;
}

int command_eval(int argc, char **argv)
{
    eval_values values = { 0 };
    switch (arguments_parse(&syntax, argc, argv, &values, NULL)) {
    case ARGUMENTS_HELP:
        return COMMAND_DONE;
    case ARGUMENTS_WRONG:
        return COMMAND_WRONG_USAGE;
    case ARGUMENTS_OK:
        break;
    }
    if (!values.material)
        return arguments_wrong(&syntax, "--material PRESET is missing");
    messages m;
    messages_begin(&m, values.json);
    glint_material *material = open_material(&values, &m.report);
    if (!material)
        return messages_fail(&m);
    const int code = answer_all(material, values.json, &m.report);
    glint_material_destroy(material);
    messages_end(&m);
    return code;
}
