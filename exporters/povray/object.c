/* Meshes and their instances, each in the form that fits it best, with a comment that says what that form claims. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exporters/povray/povray.h"

/* Analytic reflection has no mirror images; below this roughness one would miss them. Taste. */
#define ANALYTIC_ALPHA 0.1F
/* The lobe of such a flake is wide enough to have a shape. Taste. */
#define WIDE_FACET 0.3F
/* Cells of the hash of glint.inc, to either side. */
#define CELLS 4.6e7

typedef enum form { FORM_UNLIT, FORM_SMOOTH, FORM_PORTABLE, FORM_EXACT, FORM_ANALYTIC, FORM_MESH } form;

static const struct {
    const char *name, *claim;
} forms[] = {
    [FORM_UNLIT] = { "unlit", "its colour, exactly" },
    [FORM_SMOOTH] = { "smooth", "no flakes; within 10 % of libglint's smooth model where light and view are within 60 "
                                "degrees of the normal" },
    [FORM_PORTABLE] = { "portable", "flakes of POV-Ray's own; mean within 10 % of smooth" },
    [FORM_EXACT] = { "exact", "the flakes of libglint's explicit model with its POV-Ray hash: x along u, y along v; "
                              "for this camera" },
    [FORM_ANALYTIC] = { "analytic", "libglint's smooth model to the precision of the picture, for this camera and the "
                                    "one light" },
    [FORM_MESH] = { "mesh", "one polygon a flake, tilted; those of libglint's explicit model with its POV-Ray hash" },
};

/* ---- meshes ---- */

static void write_uv(const scene_mesh *mesh, const scene_texture *t, text *out)
{
    const float *uv = mesh->texcoord[t->texcoord];
    const double c = cos((double)t->rotation), s = sin((double)t->rotation);
    text_print(out, "  uv_vectors {\n    %u", mesh->vertex_count);
    for (uint32_t v = 0; v < mesh->vertex_count; ++v) {
        /* KHR_texture_transform; POV-Ray counts v from the bottom. */
        const double x = (double)uv[2 * (size_t)v] * (double)t->scale[0];
        const double y = (double)uv[2 * (size_t)v + 1] * (double)t->scale[1];
        text_print(out, ",\n    <%.9g, %.9g>", c * x + s * y + (double)t->offset[0],
                   1.0 - (c * y - s * x + (double)t->offset[1]));
    }
    text_print(out, "\n  }\n");
}

static bool has_area(const scene_mesh *mesh, uint32_t triangle)
{
    const uint32_t *c = &mesh->index[3 * (size_t)triangle];
    const vec a = vec_of(&mesh->position[3 * (size_t)c[0]]), b = vec_of(&mesh->position[3 * (size_t)c[1]]);
    const vec d = vec_of(&mesh->position[3 * (size_t)c[2]]);
    return vec_length(vec_cross(vec_sub(b, a), vec_sub(d, a))) > 0.0;
}

static uint32_t count_faces(const scene_mesh *mesh)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; ++t)
        count += has_area(mesh, t);
    return count;
}

static void write_vectors(text *out, const char *what, const float *xyz, uint32_t count)
{
    text_print(out, "  %s {\n    %u", what, count);
    for (uint32_t v = 0; v < count; ++v) {
        text_print(out, ",\n    ");
        text_vector(out, vec_of(&xyz[3 * (size_t)v]));
    }
    text_print(out, "\n  }\n");
}

static void write_mesh(const povray *p, int index, text *out)
{
    const scene_mesh *mesh = &p->scene->meshes[index];
    const material_look look = material_look_of(p, mesh->material);
    char name[NAME_LENGTH];
    name_comment(name, mesh->name);
    text_print(out, "// %s\n#declare Mesh_%d = mesh2 {\n", name, index);
    write_vectors(out, "vertex_vectors", mesh->position, mesh->vertex_count);
    write_vectors(out, "normal_vectors", mesh->normal, mesh->vertex_count);
    if (look.base_image != SCENE_NONE && mesh->texcoord[look.material->base_color_texture.texcoord])
        write_uv(mesh, &look.material->base_color_texture, out);
    text_print(out, "  face_indices {\n    %u", count_faces(mesh));
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
        const uint32_t *c = &mesh->index[3 * (size_t)t];
        if (has_area(mesh, t))
            text_print(out, ",\n    <%u, %u, %u>", c[0], c[1], c[2]);
    }
    text_print(out, "\n  }\n}\n\n");
}

/* ---- which form ---- */

typedef struct choice {
    form form;
    flat flat; /* of the exact and the analytic form */
    vec light; /* of the analytic form, metres */
    text mesh; /* of the mesh form */
} choice;

/* Objects are nodes of the file with one of the primitives of their mesh. */
static void note_object(const povray *p, const scene_instance *i, const char *what)
{
    char name[NAME_LENGTH], place[2 * NAME_LENGTH];
    name_comment(name, i->name);
    snprintf(place, sizeof place, "nodes/%d (\"%s\")", i->node, name);
    notes_add(p->notes, place, what);
}

static void warn(const povray *p, const scene_instance *i, const char *asked, const char *why)
{
    char what[256];
    snprintf(what, sizeof what, "--form %s does not fit: %s", asked, why);
    note_object(p, i, what);
}

static bool can_be_exact(const povray *p, const scene_instance *i, const material_look *look, flat *out)
{
    const double elongated = sqrt((double)look->material->glint.elongation);
    return flat_find(p->scene, i, out) && (vec_length(vec_sub(out->at, p->centre)) + p->radius) * elongated <
                                              CELLS * (double)look->edge_m * out->stretch;
}

static bool can_be_analytic(const povray *p, const scene_instance *i, const material_look *look, choice *c)
{
    return look->base_image == SCENE_NONE && !(look->material->clearcoat > 0.0F) && lights_single_point(p, &c->light) &&
           flat_find(p->scene, i, &c->flat);
}

static uint32_t seed_of(const scene_instance *i, const material_look *look)
{
    /* Instances of one node are one object; other nodes have other flakes. */
    return look->material->glint.seed + (uint32_t)(i->node > 0 ? i->node : 0);
}

static bool make_flake_mesh(const povray *p, const scene_instance *i, const material_look *look, choice *c)
{
    double count;
    char why[128];
    if (look->base_image != SCENE_NONE) {
        warn(p, i, "mesh", "baseColorTexture has no place on flakes; it is exported as portable");
        return false;
    }
    if (flake_mesh_write(p, i, seed_of(i, look), &c->mesh, &count))
        return true;
    snprintf(why, sizeof why, "%.3g flakes are too many, at most 250000; it is exported as portable", count);
    warn(p, i, "mesh", why);
    return false;
}

static void choose_with_flakes(const povray *p, const scene_instance *i, const material_look *look, choice *c)
{
    c->form = FORM_PORTABLE;
    switch (p->options->form) {
    case GLINT_EXPORT_POVRAY_AUTO:
    case GLINT_EXPORT_POVRAY_EXACT:
        if (can_be_exact(p, i, look, &c->flat))
            c->form = FORM_EXACT;
        else if (p->options->form == GLINT_EXPORT_POVRAY_EXACT)
            warn(p, i, "exact",
                 "the object is not flat, or its flakes are not square on it; it is exported as portable");
        break;
    case GLINT_EXPORT_POVRAY_MESH:
        if (make_flake_mesh(p, i, look, c))
            c->form = FORM_MESH;
        break;
    case GLINT_EXPORT_POVRAY_ANALYTIC:
        if (can_be_analytic(p, i, look, c))
            c->form = FORM_ANALYTIC;
        else
            warn(p, i, "analytic",
                 "it needs a flat object without texture or coat, and one light that is a point; it "
                 "is exported as portable");
        break;
    case GLINT_EXPORT_POVRAY_PORTABLE:
        break;
    }
}

static void choose(const povray *p, const scene_instance *i, const material_look *look, choice *c)
{
    *c = (choice){ .form = FORM_SMOOTH };
    if (look->material->unlit)
        c->form = FORM_UNLIT;
    else if (look->flakes)
        choose_with_flakes(p, i, look, c);
    else if ((p->options->form == GLINT_EXPORT_POVRAY_AUTO && look->surface.alpha_y >= ANALYTIC_ALPHA &&
              can_be_analytic(p, i, look, c)) ||
             (p->options->form == GLINT_EXPORT_POVRAY_ANALYTIC && can_be_analytic(p, i, look, c)))
        c->form = FORM_ANALYTIC;
    else if (p->options->form == GLINT_EXPORT_POVRAY_ANALYTIC)
        warn(p, i, "analytic",
             "it needs a flat object without texture or coat, and one light that is a point; it is exported as smooth");
}

/* ---- objects ---- */

static void write_matrix(text *out, const char *indent, vec x, vec y, vec z, vec at)
{
    const vec rows[4] = { x, y, z, at };
    text_print(out, "%smatrix <", indent);
    for (int i = 0; i < 4; ++i)
        text_print(out, "%s%.9g, %.9g, %.9g", i ? ", " : "", rows[i].x + 0.0, rows[i].y + 0.0, rows[i].z + 0.0);
    text_print(out, ">\n");
}

/* A point of the world in the space of the flakes, whose surface is z = 0. */
static vec to_flat(const povray *p, const flat *f, vec world)
{
    const vec d = vec_sub(world, f->at);
    return vec_scale((vec){ vec_dot(d, f->across), vec_dot(d, f->along), vec_dot(d, f->normal) }, p->unit);
}

static vec eye_point(const povray *p)
{
    return p->eye.perspective ? p->eye.at : vec_sub(p->centre, vec_scale(p->eye.forward, 1e6 * p->radius));
}

/* The texture of one flat object, for the eye and perhaps the light. */
static void write_flat_texture(const povray *p, int index, const material_look *look, const choice *c, text *out)
{
    const scene_instance *i = &p->scene->instances[index];
    const char *material = p->material_name[p->scene->meshes[i->mesh].material];
    text_print(out, "%s_Parameters()\n", material);
    if (c->form == FORM_EXACT) {
        text_print(out, "#declare Glint_Seed = %u;\n", seed_of(i, look));
        text_print(out, "#declare Glint_Size = %.9g;\n", (double)look->edge_m * c->flat.stretch * p->unit);
    }
    text_print(out, "#declare Object_%d_Texture = Glint_%s_Texture(", index,
               c->form == FORM_EXACT ? "Exact_View" : "Analytic");
    text_vector(out, to_flat(p, &c->flat, eye_point(p)));
    if (c->form == FORM_ANALYTIC) {
        text_print(out, ", ");
        text_vector(out, to_flat(p, &c->flat, c->light));
    }
    text_print(out, ")\n");
}

static void write_object(const povray *p, int index, const material_look *look, const choice *c, text *out)
{
    const scene_instance *i = &p->scene->instances[index];
    const char *material = p->material_name[p->scene->meshes[i->mesh].material];
    const bool placed = c->form == FORM_EXACT || c->form == FORM_ANALYTIC;
    if (placed)
        write_flat_texture(p, index, look, c, out);
    if (c->form == FORM_MESH) {
        text_print(out, "%s_Parameters()\n#declare Object_%d_Texture = Glint_Mirror_Texture()\n", material, index);
        text_add(out, c->mesh.bytes, c->mesh.length);
        text_print(out, "object {\n  Object_%d_Flakes\n", index);
    } else {
        text_print(out, "object {\n  Mesh_%d\n", i->mesh);
        const float *m = i->to_world;
        write_matrix(out, "  ", vec_scale(matrix_column(m, 0), p->unit), vec_scale(matrix_column(m, 1), p->unit),
                     vec_scale(matrix_column(m, 2), p->unit), vec_scale(matrix_column(m, 3), p->unit));
    }
    if (placed || c->form == FORM_MESH)
        text_print(out, "  texture {\n    Object_%d_Texture\n", index);
    else
        text_print(out, "  texture {\n    %s\n", material);
    if (placed)
        write_matrix(out, "    ", c->flat.across, c->flat.along, c->flat.normal, vec_scale(c->flat.at, p->unit));
    text_print(out, "  }\n}\n\n");
}

static void warn_of_mesh(const povray *p, int index, const material_look *look)
{
    const scene_mesh *mesh = &p->scene->meshes[index];
    char name[NAME_LENGTH];
    name_comment(name, mesh->name);
    if (mesh->color)
        notes_add(p->notes, name, "vertex colours are left out");
    if (look->base_image != SCENE_NONE && !mesh->texcoord[look->material->base_color_texture.texcoord])
        notes_add(p->notes, name, "has not the TEXCOORD that its baseColorTexture uses");
}

static void warn_of_portable(const povray *p, const scene_instance *i, const material_look *look)
{
    const scene_glint *g = &look->material->glint;
    if (g->elongation > 1.0F || look->anisotropic)
        note_object(p, i,
                    "the portable form has round tilts and square flakes; anisotropy and glintElongation are left out");
    if (g->distribution == GLINT_DISTRIBUTION_GGX && g->facet_roughness > WIDE_FACET)
        note_object(p, i, "the portable form has flakes with a Beckmann lobe in the place of GGX");
    if (g->color_variation > 0.0F || g->color_count > 0)
        note_object(p, i, "the portable form tints cubes of a flake's size, not flakes");
}

static void write_instance(povray *p, int index, bool *mesh_written)
{
    const scene_instance *i = &p->scene->instances[index];
    const int material = p->scene->meshes[i->mesh].material;
    if (count_faces(&p->scene->meshes[i->mesh]) == 0)
        return;
    const material_look look = material_look_of(p, material);
    choice c;
    choose(p, i, &look, &c);
    if (c.form == FORM_PORTABLE)
        warn_of_portable(p, i, &look);
    if (!mesh_written[i->mesh]) {
        mesh_written[i->mesh] = true;
        warn_of_mesh(p, i->mesh, &look);
    }
    char name[NAME_LENGTH];
    name_comment(name, i->name);
    text *out = &p->objects;
    text_print(out, "// ---- object \"%s\", form %s: %s ----\n", name, forms[c.form].name, forms[c.form].claim);
    write_object(p, index, &look, &c, out);
    if (p->options->object)
        p->options->object(i->name ? i->name : "", p->scene->materials[material].name, forms[c.form].name,
                           p->options->listener.user);
    text_free(&c.mesh);
}

void objects_write(povray *p)
{
    const scene *s = p->scene;
    bool *written = calloc((size_t)s->mesh_count + 1, sizeof *written);
    if (!written) {
        p->objects.failed = true;
        return;
    }
    for (int i = 0; i < s->mesh_count; ++i)
        if (count_faces(&s->meshes[i]) > 0)
            write_mesh(p, i, &p->objects);
    for (int i = 0; i < s->instance_count; ++i)
        write_instance(p, i, written);
    if (s->instance_count == 0)
        notes_add(p->notes, NULL, "there is nothing to see: the scene has no objects");
    free(written);
}
