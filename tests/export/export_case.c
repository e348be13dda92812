#include "export_case.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glint_export.h"

bytes read_bytes(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s cannot be opened", path);
    fseek(file, 0, SEEK_END);
    bytes b = { NULL, (size_t)ftell(file) };
    rewind(file);
    b.data = calloc(b.size + 1, 1);
    assert_non_null(b.data);
    assert_int_equal(fread(b.data, 1, b.size, file), b.size);
    fclose(file);
    return b;
}

void assert_same_files(const char *a, const char *b)
{
    bytes x = read_bytes(a), y = read_bytes(b);
    if (x.size != y.size || memcmp(x.data, y.data, x.size) != 0)
        fail_msg("%s (%zu bytes) and %s (%zu bytes) differ", a, x.size, b, y.size);
    free(x.data);
    free(y.data);
}

char *in_folder(const gltf_case *c, const char *name)
{
    static char paths[8][600];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", c->folder, name);
    return path;
}

static glint_export_result export(const char *input, const char *output, const request *q, char message[1024])
{
    const glint_export_assignment material = { q->material, q->preset }, value = { q->pointer, q->value };
    glint_export_gltf_options o = GLINT_EXPORT_GLTF_OPTIONS_INIT;
    o.input = input;
    o.output = output;
    o.materials = &material;
    o.material_count = q->preset ? 1 : 0;
    o.values = &value;
    o.value_count = q->value ? 1 : 0;
    o.strip = q->strip;
    return glint_export_gltf(&o, message, 1024);
}

void exported(const char *input, const char *output, const request *q)
{
    char message[1024];
    if (export(input, output, q, message) != GLINT_EXPORT_OK)
        fail_msg("%s", message);
}

void refused(const char *input, const char *output, const request *q, const char *reason)
{
    char message[1024] = "";
    assert_int_equal(export(input, output, q, message), GLINT_EXPORT_BAD_INPUT);
    if (!strstr(message, reason))
        fail_msg("said \"%s\", expected it to hold \"%s\"", message, reason);
}

const scene *read_output(gltf_case *c, const char *path)
{
    scene_free(&c->scene);
    snprintf(c->path, sizeof c->path, "%s", path);
    gltf_case_accepted(c);
    return &c->scene;
}
