/* From a glTF material to the parameters of glint.inc, and what of it POV-Ray cannot show. */
#include <stdio.h>
#include <string.h>

#include "exporters/povray/povray.h"
#include "scene/surface.h"

/* A lobe that is narrower than this lights no sample at all. Taste. */
#define LEAST_LOBE 2e-3
/* Surfaces that reflect what is around them so that one misses it: metals, and what is smooth. Taste. */
#define MIRROR_F0 0.3F
#define MIRROR_ALPHA 0.15F

/* ---- means of textures ---- */

static void mean_of(const povray *p, const scene_texture *which, float rgba[4])
{
    /* A pixel as wide as the picture sees its mean. */
    texture_lookup(p->textures, which, 0.5F, 0.5F, 1.0F, 0.0F, 0.0F, 1.0F, rgba);
}

static scene_texels mean_texels(const povray *p, const scene_material *m)
{
    scene_texels t = scene_texels_of(m);
    float c[4];
    mean_of(p, &m->base_color_texture, c);
    for (int i = 0; i < 4; ++i)
        t.base_color[i] *= c[i];
    mean_of(p, &m->metallic_roughness_texture, c);
    t.roughness *= c[1];
    t.metallic *= c[2];
    mean_of(p, &m->specular_texture, c);
    t.specular *= c[3];
    mean_of(p, &m->specular_color_texture, c);
    for (int i = 0; i < 3; ++i)
        t.specular_color[i] *= c[i];
    mean_of(p, &m->anisotropy_texture, c);
    t.anisotropy *= c[2];
    mean_of(p, &m->clearcoat_texture, c);
    t.clearcoat *= c[0];
    mean_of(p, &m->clearcoat_roughness_texture, c);
    t.clearcoat_roughness *= c[1];
    if (!m->glint.present)
        return t;
    mean_of(p, &m->glint.texture, c);
    t.glint_factor *= c[0];
    mean_of(p, &m->glint.density_texture, c);
    t.glint_density *= c[1];
    mean_of(p, &m->glint.color_texture, c);
    for (int i = 0; i < 3; ++i)
        t.glint_color[i] *= c[i];
    return t;
}

material_look material_look_of(const povray *p, int material)
{
    const scene_material *m = &p->scene->materials[material];
    const scene_texels t = mean_texels(p, m);
    char file[2 * NAME_LENGTH];
    material_look look = { .material = m, .surface = scene_base_surface(m, &t), .base_image = SCENE_NONE };
    const glint_surface *s = &look.surface;
    look.flakes = !m->unlit && m->glint.present && m->glint.layer == SCENE_LAYER_BASE && s->discreteness > 0.0F &&
                  s->facets_per_m2 > 0.0F;
    look.anisotropic = fabsf(s->alpha_x - s->alpha_y) > 1e-6F;
    if (m->base_color_texture.image != SCENE_NONE && texture_file(p, m->base_color_texture.image, file))
        look.base_image = m->base_color_texture.image;
    const double facet = (double)(m->glint.facet_roughness * m->glint.facet_roughness);
    look.lobe = (float)fmax(sqrt(facet * facet + lights_width2(p)), LEAST_LOBE);
    look.edge_m = look.flakes ? (float)(1.0 / sqrt((double)s->facets_per_m2)) : 0.0F;
    return look;
}

/* ---- what is left out ---- */

typedef struct left_out {
    bool is_so;
    const char *what;
} left_out;

static void warn_list(const povray *p, int material, const left_out *list, size_t count)
{
    char name[NAME_LENGTH], place[NAME_LENGTH + 32];
    name_comment(name, p->scene->materials[material].name);
    snprintf(place, sizeof place, "materials/%d (\"%s\")", material, name);
    for (size_t i = 0; i < count; ++i)
        if (list[i].is_so)
            notes_add(p->notes, place, list[i].what);
}

static bool has(const scene_texture *t)
{
    return t->image != SCENE_NONE;
}

static bool tinted(const float c[4])
{
    return fabsf(c[0] - c[1]) > 1e-6F || fabsf(c[1] - c[2]) > 1e-6F;
}

/* How many sets its textures use. */
static int texcoord_sets(const scene_material *m)
{
    const scene_texture *list[SCENE_MATERIAL_TEXTURES];
    bool used[2] = { false, false };
    scene_material_textures(m, list);
    for (int i = 0; i < SCENE_MATERIAL_TEXTURES; ++i)
        if (has(list[i]))
            used[list[i]->texcoord == 1] = true;
    return used[0] + used[1];
}

static void warn_of_textures(const povray *p, int material)
{
    const scene_material *m = &p->scene->materials[material];
    const material_look look = material_look_of(p, material);
    const bool shown = look.base_image != SCENE_NONE;
    const scene_texture *base = &m->base_color_texture;
    const left_out list[] = {
        { has(base) && !shown, "baseColorTexture is left out, its mean is taken: POV-Ray reads PNG and JPEG only" },
        { shown && m->metallic > 0.0F, "baseColorTexture colours the matt part; the metal has its mean" },
        { shown && tinted(m->base_color), "the hue of baseColorFactor is left out beside baseColorTexture" },
        { shown && (base->wrap_s != SCENE_WRAP_REPEAT || base->wrap_t != SCENE_WRAP_REPEAT),
          "baseColorTexture is repeated; its sampler asks for another wrap mode" },
        { texcoord_sets(m) > 1, "its textures use several sets of TEXCOORD; POV-Ray's mesh has the one of "
                                "baseColorTexture" },
        { has(&m->metallic_roughness_texture), "metallicRoughnessTexture is left out, its mean is taken" },
        { has(&m->normal_texture), "normalTexture is left out: POV-Ray has no normal maps" },
        { has(&m->occlusion_texture), "occlusionTexture is left out" },
        { has(&m->emissive_texture), "emissiveTexture is left out, its mean is taken" },
        { has(&m->specular_texture) || has(&m->specular_color_texture),
          "textures of KHR_materials_specular are left out, their means are taken" },
        { has(&m->anisotropy_texture), "anisotropyTexture is left out" },
        { has(&m->clearcoat_texture) || has(&m->clearcoat_roughness_texture),
          "textures of the clear coat are left out, their means are taken" },
        { has(&m->clearcoat_normal_texture), "clearcoatNormalTexture is left out: POV-Ray has no normal maps" },
        { m->glint.present &&
              (has(&m->glint.texture) || has(&m->glint.density_texture) || has(&m->glint.color_texture)),
          "textures of GLINT_materials_glint are left out, their means are taken" },
    };
    warn_list(p, material, list, sizeof list / sizeof list[0]);
}

void material_warn(const povray *p, int material)
{
    const scene_material *m = &p->scene->materials[material];
    const scene_glint *g = &m->glint;
    const bool flakes = g->present && g->factor > 0.0F;
    const left_out list[] = {
        { m->alpha_mode == SCENE_ALPHA_BLEND, "alphaMode BLEND is left out: the surface is opaque" },
        { m->alpha_mode == SCENE_ALPHA_MASK, "alphaMode MASK is left out: the surface has no holes" },
        { flakes && g->layer == SCENE_LAYER_CLEARCOAT, "flakes in the clear coat are left out: the coat is smooth" },
        { m->coat_glint.present && m->coat_glint.factor > 0.0F,
          "flakes in the clear coat are left out: the coat is smooth" },
        { flakes && g->density_variation > 0.0F, "glintDensityVariation is left out: the density is even" },
        { flakes && g->structure == SCENE_STRUCTURE_EXAMPLE, "glintStructure \"example\" is exported as \"flakes\"" },
    };
    warn_list(p, material, list, sizeof list / sizeof list[0]);
    warn_of_textures(p, material);
}

/* ---- what is written ---- */

static void declare(text *out, const char *name, double value)
{
    text_print(out, "  #declare Glint_%s = %.9g;\n", name, value + 0.0);
}

static void declare_color(text *out, const char *name, const float rgb[3])
{
    text_print(out, "  #declare Glint_%s = ", name);
    text_color(out, rgb);
    text_print(out, ";\n");
}

static void write_pigment(const povray *p, const material_look *look, const float rgb[3], text *out)
{
    char file[2 * NAME_LENGTH];
    if (look->base_image == SCENE_NONE) {
        text_print(out, "pigment { color rgb ");
        text_color(out, rgb);
        text_print(out, " }");
        return;
    }
    const char *name = texture_file(p, look->base_image, file);
    p->image_used[look->base_image] = true;
    text_print(out, "pigment { uv_mapping image_map { %s \"%s\" gamma srgb interpolate %d } }",
               strcmp(strrchr(name, '.'), ".png") == 0 ? "png" : "jpeg", name,
               look->material->base_color_texture.nearest ? 0 : 2);
}

static void write_flakes(const povray *p, const material_look *look, text *out)
{
    const scene_glint *g = &look->material->glint;
    declare(out, "Lobe", (double)look->lobe);
    declare(out, "Size", (double)look->edge_m * p->unit);
    declare(out, "Seed", (double)g->seed);
    declare(out, "Coverage", (double)g->coverage);
    declare(out, "Share", (double)look->surface.discreteness);
    if (g->elongation > 1.0F)
        declare(out, "Aspect", (double)g->elongation);
    if (g->color_variation > 0.0F)
        declare(out, "Hues", (double)g->color_variation);
    if (g->color_count == 0)
        return;
    text_print(out, "  #declare Glint_Tints = array[%u] {", g->color_count);
    for (uint32_t i = 0; i < g->color_count; ++i) {
        text_print(out, i ? ", " : " ");
        text_color(out, g->colors[i]);
    }
    text_print(out, " }\n");
}

static void write_parameters(const povray *p, int material, const material_look *look, text *out)
{
    const scene_material *m = look->material;
    const glint_surface *s = &look->surface;
    text_print(out, "#macro %s_Parameters()\n  Glint_Reset()\n", p->material_name[material]);
    text_print(out, "  #declare Glint_Ndf = %s;\n",
               m->glint.present && m->glint.distribution == GLINT_DISTRIBUTION_BECKMANN ? "Glint_Beckmann"
                                                                                        : "Glint_GGX");
    if (look->anisotropic)
        text_print(out, "  #declare Glint_Alpha = <%.9g, %.9g, 0>;\n", (double)s->alpha_x, (double)s->alpha_y);
    else
        declare(out, "Alpha", (double)s->alpha_x);
    declare_color(out, "F0", s->f0);
    declare_color(out, "F90", s->f90);
    text_print(out, "  #declare Glint_Base = ");
    write_pigment(p, look, s->diffuse, out);
    text_print(out, "\n");
    if (look->base_image != SCENE_NONE)
        declare(out, "Diffuse",
                (double)((m->base_color[0] + m->base_color[1] + m->base_color[2]) / 3.0F *
                         (1.0F - fminf(m->metallic, 1.0F))));
    float emissive[3], c[4];
    mean_of(p, &m->emissive_texture, c);
    for (int i = 0; i < 3; ++i)
        emissive[i] = m->emissive[i] * c[i];
    if (emissive[0] > 0.0F || emissive[1] > 0.0F || emissive[2] > 0.0F)
        declare_color(out, "Emission", emissive);
    declare(out, "Ambient", p->studio ? 1.0 : 0.0);
    const float brightest = fmaxf(s->f0[0], fmaxf(s->f0[1], s->f0[2]));
    declare(out, "Mirror", brightest > MIRROR_F0 || s->alpha_y < MIRROR_ALPHA ? 1.0 : 0.0);
    if (m->clearcoat > 0.0F) {
        const scene_texels t = mean_texels(p, m);
        const glint_surface coat = scene_coat_surface(m, &t);
        declare(out, "Coat", (double)fminf(t.clearcoat, 1.0F));
        const double wide = sqrt((double)coat.alpha_x * (double)coat.alpha_x + lights_width2(p));
        declare(out, "Coat_Alpha", fmax(wide, LEAST_LOBE));
    }
    if (look->flakes)
        write_flakes(p, look, out);
    text_print(out, "#end\n");
}

void material_write(povray *p, int material)
{
    text *out = &p->materials;
    const material_look look = material_look_of(p, material);
    char name[NAME_LENGTH];
    name_comment(name, look.material->name);
    text_print(out, "// ---- material \"%s\" ----\n", name);
    if (look.material->unlit) {
        text_print(out, "// Unlit: its colour is its light.\n#declare %s = texture {\n  ", p->material_name[material]);
        write_pigment(p, &look, look.material->base_color, out);
        text_print(out, "\n  finish { ambient 0 diffuse 0 emission 1 }\n}\n\n");
        return;
    }
    write_parameters(p, material, &look, out);
    text_print(out, "%s_Parameters()\n#declare %s = Glint_%s_Texture()\n\n", p->material_name[material],
               p->material_name[material], look.flakes ? "Portable" : "Smooth");
}
