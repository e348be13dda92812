/* Textures, normal maps and the clear coat of glTF 2.0, brought to calls of libglint. */
#include "preview/shade_parts.h"

#include "preview/place.h"
#include "scene/surface.h"

/* How far above the horizon of a bent normal the viewer is kept at least: sin of a twentieth of a degree. Taste. */
#define HORIZON 1e-3

/* All that a lookup needs to know about the hit. */
typedef struct lookup {
    const textures *textures;
    const hit *hit;
    double st[2][2], dx[2][2], dy[2][2]; /* both sets of texture coordinates */
} lookup;

static void look_up(const lookup *l, const scene_texture *t, float rgba[4])
{
    rgba[0] = rgba[1] = rgba[2] = rgba[3] = 1.0F;
    if (!EFFECT_TEXTURES || t->image == SCENE_NONE)
        return;
    const int set = t->texcoord;
    texture_lookup(l->textures, t, (float)l->st[set][0], (float)l->st[set][1], (float)l->dx[set][0],
                   (float)l->dx[set][1], (float)l->dy[set][0], (float)l->dy[set][1], rgba);
}

static lookup make_lookup(const shader *s, const hit *h, const hit_step *step)
{
    lookup l = { .textures = s->textures, .hit = h };
    for (int set = 0; set < 2; ++set) {
        hit_texcoord(h, set, l.st[set]);
        hit_texcoord_step(h, step, set, l.dx[set], l.dy[set]);
    }
    return l;
}

static void look_up_base_color(const lookup *l, const scene_material *m, float rgba[4])
{
    float of_vertices[4];
    look_up(l, &m->base_color_texture, rgba);
    hit_color(l->hit, of_vertices);
    for (int i = 0; i < 4; ++i)
        rgba[i] *= m->base_color[i] * of_vertices[i];
}

static void look_up_glint(const lookup *l, const scene_glint *g, float *factor, float *density, float color[3])
{
    float c[4];
    if (!g->present)
        return;
    look_up(l, &g->texture, c);
    *factor *= c[0];
    look_up(l, &g->density_texture, c);
    *density *= c[1];
    look_up(l, &g->color_texture, c);
    for (int i = 0; i < 3; ++i)
        color[i] *= c[i];
}

static scene_texels look_up_texels(const lookup *l, const scene_material *m)
{
    scene_texels t = scene_texels_of(m);
    float c[4];
    look_up_base_color(l, m, t.base_color);
    look_up(l, &m->metallic_roughness_texture, c);
    t.roughness *= c[1];
    t.metallic *= c[2];
    look_up(l, &m->specular_texture, c);
    t.specular *= c[3];
    look_up(l, &m->specular_color_texture, c);
    for (int i = 0; i < 3; ++i)
        t.specular_color[i] *= c[i];
    look_up(l, &m->anisotropy_texture, c);
    t.anisotropy *= c[2];
    look_up(l, &m->clearcoat_texture, c);
    t.clearcoat *= c[0];
    look_up(l, &m->clearcoat_roughness_texture, c);
    t.clearcoat_roughness *= c[1];
    look_up_glint(l, &m->glint, &t.glint_factor, &t.glint_density, t.glint_color);
    look_up_glint(l, &m->coat_glint, &t.coat_glint_factor, &t.coat_glint_density, t.coat_glint_color);
    return t;
}

/* ---- frames ---- */

/* The normal that a map asks for, kept where the viewer can see it. */
static vec3 mapped_normal(const lookup *l, const scene_texture *map, vec3 wo)
{
    const hit *const h = l->hit;
    if (!EFFECT_NORMAL_MAPS || map->image == SCENE_NONE || h->mesh->tangent == NULL)
        return h->normal;
    float c[4];
    look_up(l, map, c);
    const double x = (2.0 * (double)c[0] - 1.0) * (double)map->strength;
    const double y = (2.0 * (double)c[1] - 1.0) * (double)map->strength;
    const double z = 2.0 * (double)c[2] - 1.0;
    /* Seen from behind, the whole frame turns over; h->normal has turned already. */
    const double side = h->front ? 1.0 : -1.0;
    const vec3 bent = v3_mad(v3_mad(v3_scale(h->normal, z), h->tangent, x * side), h->bitangent, y * side);
    const vec3 n = v3_normalize(bent);
    if (v3_dot(n, n) == 0.0)
        return h->normal;
    const double above = v3_dot(n, wo);
    return above >= HORIZON ? n : v3_normalize(v3_mad(n, wo, HORIZON - above));
}

/* The direction along which alpha_x lies, in the tangent plane of the mesh (KHR_materials_anisotropy). */
static vec3 anisotropy_direction(const lookup *l, const scene_material *m)
{
    const hit *const h = l->hit;
    double x = 1.0, y = 0.0;
    if (m->anisotropy_texture.image != SCENE_NONE) {
        float c[4];
        look_up(l, &m->anisotropy_texture, c);
        x = 2.0 * (double)c[0] - 1.0;
        y = 2.0 * (double)c[1] - 1.0;
    }
    const double co = cos((double)m->anisotropy_rotation);
    const double si = sin((double)m->anisotropy_rotation);
    return v3_mad(v3_scale(h->tangent, co * x - si * y), h->bitangent, si * x + co * y);
}

void shade_set_frame(shade_layer *layer, vec3 normal, vec3 along, vec3 wo)
{
    const vec3 flat = v3_reject(along, normal);
    layer->z = normal;
    layer->x = v3_dot(flat, flat) > 0.0 ? v3_normalize(flat) : v3_any_tangent(normal);
    layer->y = v3_cross(layer->z, layer->x);
    layer->wo[0] = (float)v3_dot(wo, layer->x);
    layer->wo[1] = (float)v3_dot(wo, layer->y);
    layer->wo[2] = (float)v3_dot(wo, layer->z);
}

/* ---- layers ---- */

void shade_begin_coat(shade_point *p)
{
    float below[3];
    p->layer_count = 2;
    p->counts = p->counts || p->layers[1].counts;
    shade_below_coat(p, NULL, below);
    p->layers[0].weight = (below[0] + below[1] + below[2]) / 3.0F;
    for (int i = 0; i < 3; ++i)
        p->emission[i] *= below[i];
}

static void add_coat(const lookup *l, const scene_material *m, const scene_texels *t, const material_layers *handles,
                     vec3 wo, shade_point *out)
{
    if (!EFFECT_COATS || handles->coat == NULL || !(t->clearcoat > 0.0F))
        return;
    shade_layer *const coat = &out->layers[1];
    coat->material = handles->coat;
    coat->counts = handles->coat_counts;
    coat->mapped = handles->coat_mapped;
    coat->surface = scene_coat_surface(m, t);
    coat->weight = fminf(t->clearcoat, 1.0F);
    shade_set_frame(coat, mapped_normal(l, &m->clearcoat_normal_texture, wo), l->hit->tangent, wo);
    shade_begin_coat(out);
}

/* Turns the frame so that x and y are those of a normal map, along u and v. Seen from behind, the normal has turned
 * over and bumps are dents. */
static void align_to_map(shade_layer *layer, const hit *h, const scene_glint *g, float choice, vec3 wo)
{
    vec3 u = v3(0.0, 0.0, 0.0), v = u;
    scene_forget_directions(&layer->surface);
    place_axes(g, h, choice, &u, &v);
    if (!(v3_dot(u, u) > 0.0))
        return;
    const double side = h->front ? 1.0 : -1.0;
    shade_set_frame(layer, layer->z, v3_scale(u, side), wo);
    if (v3_dot(layer->y, v) * side < 0.0) {
        layer->y = v3_scale(layer->y, -1.0);
        layer->wo[1] = -layer->wo[1];
    }
}

void shade_place_glints(const shader *s, const hit *h, const hit_step *step, float choice, vec3 wo,
                        scene_glint_layer which, shade_layer *layer)
{
    const scene_glint *const g = scene_layer_glint(&s->scene->materials[h->mesh->material], which);
    if (!layer->counts || g == NULL)
        return;
    float density_scale;
    layer->footprint = place_footprint(g, h, step, choice, &density_scale);
    /* Other renderers know no objects' seeds: their facets hang on the texture coordinates alone. */
    if (EFFECT_FACETS_OF_OTHERS && s->materials->facets != PREVIEW_FACETS_OWN)
        layer->footprint.seed = 0U;
    if (EFFECT_FACET_PLANES && density_scale != 1.0F) {
        layer->surface.facets_per_m2 *= density_scale;
        layer->is_own = false;
    }
    if (EFFECT_EXAMPLES && layer->mapped)
        align_to_map(layer, h, g, choice, wo);
}

void shade_prepare_any(const shader *s, const hit *h, const hit_step *step, vec3 wo, float choice, shade_point *out)
{
    const scene_material *const m = &s->scene->materials[h->mesh->material];
    const material_layers *const handles = &s->materials->layers[h->mesh->material];
    const lookup l = make_lookup(s, h, step);
    *out = (shade_point){ .occlusion = 1.0F };

    if (m->unlit) {
        float rgba[4];
        look_up_base_color(&l, m, rgba);
        out->opacity = m->alpha_mode == SCENE_ALPHA_BLEND ? rgba[3] : 1.0F;
        for (int i = 0; i < 3; ++i)
            out->emission[i] = out->albedo[i] = rgba[i];
        return;
    }

    const scene_texels t = look_up_texels(&l, m);
    float emissive[4], occlusion[4];
    look_up(&l, &m->emissive_texture, emissive);
    look_up(&l, &m->occlusion_texture, occlusion);
    out->opacity = m->alpha_mode == SCENE_ALPHA_BLEND ? fminf(t.base_color[3], 1.0F) : 1.0F;
    if (m->occlusion_texture.image != SCENE_NONE)
        out->occlusion = 1.0F + m->occlusion_texture.strength * (occlusion[0] - 1.0F);
    for (int i = 0; i < 3; ++i) {
        out->emission[i] = m->emissive[i] * emissive[i];
        out->albedo[i] = t.base_color[i];
    }

    shade_layer *const base = &out->layers[out->layer_count++];
    base->material = handles->base;
    base->counts = handles->base_counts;
    base->mapped = handles->base_mapped;
    base->surface = scene_base_surface(m, &t);
    base->weight = 1.0F;
    shade_set_frame(base, mapped_normal(&l, &m->normal_texture, wo), anisotropy_direction(&l, m), wo);
    out->whole = handles->whole;
    add_coat(&l, m, &t, handles, wo, out);
    out->draws = handles->draws;
    out->counts = out->counts || base->counts;
    if (!EFFECT_FACETS || !out->counts)
        return;
    shade_place_glints(s, h, step, choice, wo, SCENE_LAYER_BASE, base);
    if (shade_layers(out) == 2)
        shade_place_glints(s, h, step, choice, wo, SCENE_LAYER_CLEARCOAT, &out->layers[1]);
}

float shade_opacity(const shader *s, const geometry *g, const trace_hit *at)
{
    const hit_step still = { 0 };
    hit h;
    hit_locate(g, at, &h);
    const lookup l = make_lookup(s, &h, &still);
    float rgba[4];
    look_up_base_color(&l, &s->scene->materials[h.mesh->material], rgba);
    return rgba[3];
}

void shade_emission(const shader *s, const geometry *g, const trace_hit *at, float rgb[3])
{
    const scene_mesh *const mesh = &s->scene->meshes[s->scene->instances[at->instance].mesh];
    const scene_material *const m = &s->scene->materials[mesh->material];
    float rgba[4] = { 1.0F, 1.0F, 1.0F, 1.0F };
    if (EFFECT_TEXTURES && m->emissive_texture.image != SCENE_NONE) {
        const hit_step still = { 0 };
        hit h;
        hit_locate(g, at, &h);
        const lookup l = make_lookup(s, &h, &still);
        look_up(&l, &m->emissive_texture, rgba);
    }
    for (int c = 0; c < 3; ++c)
        rgb[c] = m->emissive[c] * rgba[c];
}
