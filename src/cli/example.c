/* glint example: writes one of the built-in normal maps of the example model as a picture. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/nearest.h"
#include "glint.h"
#include "io/example_map.h"

typedef struct example_values {
    const char *output;
    int size, bits; /* indices of choices */
    double slope, feature, aspect, facet_roughness;
    int64_t count, seed;
    bool json;
} example_values;

/* By glint_example_kind. */
static const char *const kinds[] = { "scratches", "brushed",         "leather",
                                     "structure", "isotropic-noise", "anisotropic-noise" };
enum { KIND_COUNT = sizeof kinds / sizeof kinds[0] };

static const char *size_choice(int index)
{
    static const char *const sizes[] = { "8", "16", "32", "64", "128", "256", NULL };
    return sizes[index];
}

static const char *bits_choice(int index)
{
    static const char *const bits[] = { "16", "8", NULL };
    return bits[index];
}

static const argument_rule rules[] = {
    { .name = "output",
      .letter = 'o',
      .value = "MAP.png",
      .help = "the picture; required",
      .kind = ARGUMENT_TEXT,
      .target = offsetof(example_values, output) },
    { .name = "size",
      .help = "texels along a side; 32",
      .kind = ARGUMENT_CHOICE,
      .choice = size_choice,
      .target = offsetof(example_values, size) },
    { .name = "bits",
      .help = "of a channel; 8 has steps of the slope of 1/128 and a quarter of the file; 16",
      .kind = ARGUMENT_CHOICE,
      .choice = bits_choice,
      .target = offsetof(example_values, bits) },
    { .name = "slope",
      .value = "S",
      .help = "root mean square slope; 0.2",
      .kind = ARGUMENT_NUMBER,
      .min = 1e-6,
      .max = 2,
      .target = offsetof(example_values, slope) },
    { .name = "feature",
      .value = "T",
      .help = "texels: width of a groove, side of a cushion or of a bump; 4",
      .kind = ARGUMENT_NUMBER,
      .min = 1,
      .max = 64,
      .target = offsetof(example_values, feature) },
    { .name = "aspect",
      .value = "A",
      .help = "length over width: of anisotropic noise and of brushed grooves; 8",
      .kind = ARGUMENT_NUMBER,
      .min = 1,
      .max = 64,
      .target = offsetof(example_values, aspect) },
    { .name = "count",
      .value = "N",
      .help = "grooves of scratches; 6",
      .kind = ARGUMENT_INTEGERS,
      .count = 1,
      .min = 1,
      .max = 64,
      .target = offsetof(example_values, count) },
    { .name = "seed",
      .value = "N",
      .help = "another map of the kind; 0",
      .kind = ARGUMENT_INTEGERS,
      .count = 1,
      .min = 0,
      .max = 4294967295.0,
      .target = offsetof(example_values, seed) },
    { .name = "facet-roughness",
      .value = "R",
      .help = "glintFacetRoughness of the material, for the roughness that is printed; 0.05",
      .kind = ARGUMENT_NUMBER,
      .min = 0,
      .max = 1,
      .target = offsetof(example_values, facet_roughness) },
    { .name = "json",
      .help = "print one JSON document",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(example_values, json) },
};

static const argument_syntax syntax = {
    .command = "glint example",
    .operands = "KIND -o MAP.png",
    .summary = "Writes a small normal map that tiles without a seam, for glintExampleTexture. KIND is scratches,\n"
               "brushed, leather, structure, isotropic-noise or anisotropic-noise; grooves run along u.",
    .operands_min = 1,
    .operands_max = 1,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

static int find_kind(const char *name)
{
    for (int i = 0; i < KIND_COUNT; ++i)
        if (strcmp(kinds[i], name) == 0)
            return i;
    return -1;
}

static int refuse_kind(const char *name)
{
    nearest near = nearest_begin(name);
    for (int i = 0; i < KIND_COUNT; ++i)
        nearest_consider(&near, kinds[i]);
    if (near.name)
        return arguments_wrong(&syntax, "unknown kind '%s'; did you mean '%s'?", name, near.name);
    return arguments_wrong(&syntax, "unknown kind '%s'; see --help", name);
}

/* The roughness and anisotropy of glTF whose lobe has the slopes of a map and of its facets: what viewers without the
 * model shall show. A lobe of roughness alpha has slopes of variance alpha^2 / 2 on each axis. */
typedef struct fallback {
    double slope[2]; /* root mean square along u and v */
    double roughness, anisotropy, rotation_rad;
} fallback;

static fallback fallback_of(const float *normals, int size, double facet_roughness)
{
    double square[2] = { 0.0, 0.0 };
    for (int i = 0; i < size * size; ++i)
        for (int k = 0; k < 2; ++k) {
            const double slope = (double)normals[3 * i + k] / (double)normals[3 * i + 2];
            square[k] += slope * slope / (double)(size * size);
        }
    const double facet_alpha = facet_roughness * facet_roughness;
    const double low = fmin(sqrt(2.0 * fmin(square[0], square[1]) + facet_alpha * facet_alpha), 1.0);
    const double high = fmin(sqrt(2.0 * fmax(square[0], square[1]) + facet_alpha * facet_alpha), 1.0);
    /* KHR_materials_anisotropy: the rougher direction has alpha + (1 - alpha) strength^2. */
    return (fallback){ .slope = { sqrt(square[0]), sqrt(square[1]) },
                       .roughness = sqrt(low),
                       .anisotropy = low < 1.0 ? sqrt((high - low) / (1.0 - low)) : 0.0,
                       .rotation_rad = square[1] > square[0] ? 1.5707963267948966 : 0.0 };
}

static int print(const example_values *v, const char *kind, int size, const fallback *f)
{
    if (!v->json) {
        printf("%s: %s, %d x %d texels, slopes of %.3g along u and %.3g along v; without the model: roughness %.3g, "
               "anisotropy %.3g turned by %.3g rad\n",
               v->output, kind, size, size, f->slope[0], f->slope[1], f->roughness, f->anisotropy, f->rotation_rad);
        return COMMAND_DONE;
    }
    document *d = document_object();
    document_set_text(d, "output", v->output);
    document_set_text(d, "kind", kind);
    document_set_integer(d, "size", size);
    document_set_number(d, "slope_u", f->slope[0]);
    document_set_number(d, "slope_v", f->slope[1]);
    document_set_number(d, "roughness", f->roughness);
    document_set_number(d, "anisotropy", f->anisotropy);
    document_set_number(d, "anisotropy_rotation_rad", f->rotation_rad);
    return print_document(d);
}

static int write_map(const example_values *v, int kind)
{
    messages m;
    messages_begin(&m, v->json);
    const int size = 8 << v->size;
    const glint_example_shape shape = { (float)v->slope, (float)v->feature, (float)v->aspect, (uint32_t)v->count };
    float *normals = malloc((size_t)size * (size_t)size * 3 * sizeof *normals);
    bool done = normals != NULL;
    if (!done)
        report_error(&m.report, "%s: %d x %d texels do not fit into memory", v->output, size, size);
    const glint_result result =
        done ? glint_example_generate((glint_example_kind)kind, (uint32_t)size, &shape, (uint32_t)v->seed, normals)
             : GLINT_ERROR_MEMORY;
    if (done && result != GLINT_OK)
        done = report_error(&m.report, "%s: %s", v->output, glint_result_text(result));
    done = done && example_map_write_png(v->output, normals, size, v->bits ? 8 : 16, &m.report);
    const fallback f = done ? fallback_of(normals, size, v->facet_roughness) : (fallback){ 0 };
    free(normals);
    if (!done)
        return messages_fail(&m);
    const int code = print(v, kinds[kind], size, &f);
    messages_end(&m);
    return code;
}

int command_example(int argc, char **argv)
{
    const glint_example_shape s = GLINT_EXAMPLE_SHAPE_INIT;
    example_values v = { .size = 2,
                         .slope = (double)s.slope,
                         .feature = (double)s.feature_texels,
                         .aspect = (double)s.aspect,
                         .facet_roughness = 0.05,
                         .count = s.count };
    const char *name;
    switch (arguments_parse(&syntax, argc, argv, &v, &name)) {
    case ARGUMENTS_HELP:
        return COMMAND_DONE;
    case ARGUMENTS_WRONG:
        return COMMAND_WRONG_USAGE;
    case ARGUMENTS_OK:
        break;
    }
    const int kind = find_kind(name);
    if (kind < 0)
        return refuse_kind(name);
    if (!v.output)
        return arguments_wrong(&syntax, "-o MAP.png is missing");
    const size_t length = strlen(v.output);
    if (length < 5 || strcmp(v.output + length - 4, ".png") != 0)
        return arguments_wrong(&syntax, "-o '%s': expected a name that ends in .png", v.output);
    return write_map(&v, kind);
}
