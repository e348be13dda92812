/* Writes small glTF files and reads them back with the reader under test. */
#include "gltf_case.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void keep_warning(const char *text, void *user)
{
    gltf_case *c = user;
    const size_t length = strlen(c->warnings);
    snprintf(c->warnings + length, sizeof c->warnings - length, "%s\n", text);
}

int gltf_case_begin(void **state)
{
    gltf_case *c = calloc(1, sizeof *c);
    if (!c)
        return -1;
    strcpy(c->folder, "/tmp/glint-scene-XXXXXX");
    *state = c;
    return mkdtemp(c->folder) ? 0 : -1;
}

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *walk)
{
    (void)status;
    (void)type;
    (void)walk;
    return remove(path);
}

int gltf_case_end(void **state)
{
    gltf_case *c = *state;
    scene_free(&c->scene);
    const int result = nftw(c->folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    free(c);
    return result;
}

void gltf_case_write(gltf_case *c, const char *name, const void *bytes, size_t size)
{
    assert_true((size_t)snprintf(c->path, sizeof c->path, "%s/%s", c->folder, name) < sizeof c->path);
    FILE *file = fopen(c->path, "wb");
    assert_non_null(file);
    assert_int_equal(size > 0 ? fwrite(bytes, 1, size, file) : 0, size);
    assert_int_equal(fclose(file), 0);
}

static void write_json(gltf_case *c, const char *buffers, const char *format, va_list arguments)
{
    char *members = NULL;
    assert_true(vasprintf(&members, format, arguments) >= 0);
    for (char *p = members; *p; p++)
        if (*p == '\'')
            *p = '"';
    char *text = NULL;
    const int length =
        asprintf(&text, "{ \"asset\": { \"version\": \"2.0\" }%s%s%s }", buffers, members[0] ? ", " : "", members);
    assert_true(length >= 0);
    gltf_case_write(c, "scene.gltf", text, (size_t)length);
    free(text);
    free(members);
}

void gltf_case_json(gltf_case *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_json(c, "", format, arguments);
    va_end(arguments);
}

void gltf_case_json_with_buffer(gltf_case *c, const void *bytes, size_t size, const char *format, ...)
{
    char buffers[128];
    snprintf(buffers, sizeof buffers, ", \"buffers\": [{ \"uri\": \"data.bin\", \"byteLength\": %zu }]", size);
    gltf_case_write(c, "data.bin", bytes, size);
    va_list arguments;
    va_start(arguments, format);
    write_json(c, buffers, format, arguments);
    va_end(arguments);
}

static void put_u32(uint8_t *out, size_t value)
{
    for (int k = 0; k < 4; k++)
        out[k] = (uint8_t)(value >> 8 * k);
}

void gltf_case_glb(gltf_case *c, const char *json, const void *bin, size_t bin_size)
{
    const size_t length = strlen(json), padded = (length + 3) / 4 * 4, padded_bin = (bin_size + 3) / 4 * 4;
    const size_t total = 12 + 8 + padded + 8 + padded_bin;
    uint8_t *bytes = calloc(1, total);
    assert_non_null(bytes);
    memcpy(bytes, "glTF\2\0\0", 8);
    put_u32(bytes + 8, total);
    put_u32(bytes + 12, padded);
    put_u32(bytes + 16, 0x4E4F534A); /* JSON */
    for (size_t i = 0; i < padded; i++)
        bytes[20 + i] = i < length ? (uint8_t)json[i] : ' ';
    put_u32(bytes + 20 + padded, padded_bin);
    put_u32(bytes + 24 + padded, 0x004E4942); /* BIN */
    if (bin_size > 0)
        memcpy(bytes + 28 + padded, bin, bin_size);
    gltf_case_write(c, "scene.glb", bytes, total);
    free(bytes);
}

bool gltf_case_read_variant(gltf_case *c, const char *variant)
{
    const scene_file_options options = { .variant = variant };
    scene_free(&c->scene);
    c->warnings[0] = '\0';
    c->said = (report){ .warn = keep_warning, .user = c };
    return scene_file_read(c->path, &options, &c->scene, &c->said);
}

bool gltf_case_read(gltf_case *c)
{
    return gltf_case_read_variant(c, NULL);
}

void gltf_case_refused(gltf_case *c, ...)
{
    if (gltf_case_read(c))
        fail_msg("%s was accepted", c->path);
    assert_int_equal(c->scene.mesh_count, 0);
    assert_null(c->scene.meshes);
    assert_null(c->scene.path);
    if (strncmp(c->said.error, c->path, strlen(c->path)) != 0)
        fail_msg("\"%s\" does not begin with the file", c->said.error);
    va_list texts;
    va_start(texts, c);
    /* clang-tidy 14 does not see va_start through cmocka's macros. */
    for (const char *text = va_arg(texts, const char *); text; /* NOLINT(clang-analyzer-valist.Uninitialized) */
         text = va_arg(texts, const char *))
        if (!strstr(c->said.error, text))
            fail_msg("\"%s\" does not say \"%s\"", c->said.error, text);
    va_end(texts);
}

void gltf_case_accepted(gltf_case *c)
{
    if (!gltf_case_read(c))
        fail_msg("refused: %s", c->said.error);
}

void gltf_case_warned(const gltf_case *c, const char *text)
{
    if (!strstr(c->warnings, text))
        fail_msg("no warning says \"%s\", but: %s", text, c->warnings);
}
