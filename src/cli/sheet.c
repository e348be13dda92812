/* A preset's properties, told once and shown twice: as lines for people or as keys of a JSON object. */
#include "cli/sheet.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/* One property. The words after the value, often its meaning in another unit, are for people only. */
static void show_numbers(document *object, const char *key, const char *label, const float *values, int count,
                         const char *words, ...) __attribute__((format(printf, 6, 7)));

static void show_numbers(document *object, const char *key, const char *label, const float *values, int count,
                         const char *words, ...)
{
    if (object) {
        if (count == 1)
            document_set_number(object, key, (double)values[0]);
        else
            document_set_numbers(object, key, values, count);
        return;
    }
    printf("  %-22s", label);
    for (int i = 0; i < count; ++i)
        printf("%s%.6g", i == 0 ? "" : " ", (double)values[i]);
    va_list list;
    va_start(list, words);
    vfprintf(stdout, words, list);
    va_end(list);
    putchar('\n');
}

static void show_text(document *object, const char *key, const char *label, const char *text)
{
    if (object)
        document_set_text(object, key, text);
    else
        printf("  %-22s%s\n", label, text);
}

/* A length in the unit that a person would use. */
static const char *readable_length(double metres, char *text, size_t size)
{
    if (metres >= 1e-2)
        snprintf(text, size, "%.3g m", metres);
    else if (metres >= 1e-4)
        snprintf(text, size, "%.3g mm", metres * 1e3);
    else
        snprintf(text, size, "%.3g um", metres * 1e6);
    return text;
}

static void show_base(const scene_material *m, document *object)
{
    show_numbers(object, "base_color", "base color", m->base_color, 3, " (linear RGB)");
    show_numbers(object, "metallic", "metallic", &m->metallic, 1, " (0 dielectric, 1 metal)");
    show_numbers(object, "roughness", "roughness", &m->roughness, 1, " (alpha %.3g)",
                 (double)m->roughness * (double)m->roughness);
    if (m->anisotropy != 0.0F) {
        show_numbers(object, "anisotropy", "anisotropy", &m->anisotropy, 1, " (0 round, 1 longest highlights)");
        show_numbers(object, "anisotropy_rotation_rad", "anisotropy rotation", &m->anisotropy_rotation, 1,
                     " rad from the tangent");
    }
    show_numbers(object, "ior", "index of refraction", &m->ior, 1, "%s", m->ior == 0.0F ? " (reflects all)" : "");
    show_numbers(object, "specular", "specular", &m->specular, 1, " (share of the dielectric reflection)");
    show_numbers(object, "specular_color", "specular color", m->specular_color, 3, " (linear RGB)");
    if (m->clearcoat > 0.0F) {
        show_numbers(object, "clearcoat", "clear coat", &m->clearcoat, 1, " (share of the surface)");
        show_numbers(object, "clearcoat_roughness", "clear coat roughness", &m->clearcoat_roughness, 1, " (alpha %.3g)",
                     (double)m->clearcoat_roughness * (double)m->clearcoat_roughness);
    }
}

/* The table of tints, a line for each. */
static void show_colors(const scene_glint *g, document *object)
{
    document *array = object && g->color_count > 0 ? document_array() : NULL;
    for (uint32_t i = 0; i < g->color_count; ++i)
        if (object)
            document_append_numbers(array, g->colors[i], 3);
        else
            show_numbers(NULL, NULL, i == 0 ? "colors of facets" : "", g->colors[i], 3, "%s",
                         i == 0 ? " (linear RGB, over their mean)" : "");
    if (array)
        document_set(object, "glint_colors", array);
}

static void show_facets(const scene_glint *g, document *object)
{
    char length[32];
    show_text(object, "glint_distribution", "facet normals",
              g->distribution == GLINT_DISTRIBUTION_BECKMANN ? "beckmann" : "ggx");
    show_numbers(object, "glint_density_per_m2", "facets per m^2", &g->density, 1, " (%.4g per cm^2, one every %s)",
                 (double)g->density * 1e-4, readable_length(1.0 / sqrt((double)g->density), length, sizeof length));
    show_numbers(object, "glint_facet_roughness", "facet roughness", &g->facet_roughness, 1, " (alpha %.3g)",
                 (double)g->facet_roughness * (double)g->facet_roughness);
    show_numbers(object, "glint_color", "facet color", g->color, 3, " (linear RGB)");
    show_numbers(object, "glint_color_variation", "color variation", &g->color_variation, 1, " (0 none, 1 full)");
    show_colors(g, object);
    show_numbers(object, "glint_elongation", "elongation", &g->elongation, 1, " (facet length over width)");
    show_numbers(object, "glint_coverage", "coverage", &g->coverage, 1, " of the surface carries facets");
    show_numbers(object, "glint_density_variation", "density variation", &g->density_variation, 1, " (0 even)");
}

static void show_anchor(const scene_glint *g, document *object)
{
    char length[32];
    const bool in_object = g->space == SCENE_SPACE_OBJECT;
    show_text(object, "glint_space", "anchored in", in_object ? "object" : "uv");
    if (!in_object)
        show_numbers(object, "glint_uv_scale_m", "metres per UV unit", &g->uv_scale, 1, " (%s, set TEXCOORD_%d)",
                     readable_length((double)g->uv_scale, length, sizeof length), g->texcoord);
    show_text(object, "glint_layer", "layer", g->layer == SCENE_LAYER_CLEARCOAT ? "clearcoat" : "base");
    if (object)
        document_set_integer(object, "glint_seed", g->seed);
    else
        printf("  %-22s%u\n", "seed", g->seed);
}

static void show_example(const scene_glint *g, document *object)
{
    char length[32];
    const bool scattered = g->example_placement == SCENE_PLACEMENT_SCATTERED;
    show_text(object, "glint_example_placement", "normal map", scattered ? "scattered" : "tiled");
    show_numbers(object, "glint_example_size_m", "side of the map", &g->example_size, 1, " (%s)",
                 readable_length((double)g->example_size, length, sizeof length));
    if (!scattered)
        return;
    show_numbers(object, "glint_example_rotation_variation_rad", "turned by", &g->example_rotation_variation, 1,
                 " rad at most, either way");
    show_numbers(object, "glint_example_scale_variation", "scaled by", &g->example_scale_variation, 1,
                 " of the side at most, either way");
}

void sheet_show(const scene_material *m, document *object)
{
    show_base(m, object);
    const scene_glint *g = &m->glint;
    if (!g->present) {
        if (!object)
            puts("  no glints");
        return;
    }
    show_numbers(object, "glint_factor", "glint factor", &g->factor, 1, " (0 smooth, 1 every facet counted)");
    show_facets(g, object);
    if (g->structure == SCENE_STRUCTURE_EXAMPLE)
        show_example(g, object);
    show_anchor(g, object);
}
