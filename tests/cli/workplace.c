/* A folder of its own for each test, with a small scene in it. */
#define _GNU_SOURCE /* nftw */
#include "workplace.h"

#include <dirent.h>
#include <ftw.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

int workplace_enter(void **state)
{
    char *folder = strdup("/tmp/glint-test-XXXXXX");
    if (!folder || !mkdtemp(folder) || chdir(folder) != 0)
        return -1;
    /* A test may act as another user. */
    chmod(folder, 0755);
    *state = folder;
    return 0;
}

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *where)
{
    (void)status;
    (void)kind;
    (void)where;
    return remove(path);
}

int workplace_leave(void **state)
{
    char *folder = *state;
    const bool gone = chdir("/") == 0 && nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS) == 0;
    free(folder);
    return gone ? 0 : -1;
}

void file_write(const char *path, const void *content, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(content, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void file_write_text(const char *path, const char *text)
{
    file_write(path, text, strlen(text));
}

char *file_read(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s: not there", path);
    char *content = NULL;
    FILE *copy = open_memstream(&content, size);
    assert_non_null(copy);
    for (int c; (c = getc(file)) != EOF;)
        putc(c, copy);
    fclose(file);
    fclose(copy);
    return content;
}

void assert_file_holds(const char *path, const char *text)
{
    size_t size;
    char *content = file_read(path, &size);
    assert_string_equal(content, text);
    assert_int_equal(size, strlen(text));
    free(content);
}

void assert_same_files(const char *a, const char *b)
{
    size_t a_size, b_size;
    char *a_content = file_read(a, &a_size), *b_content = file_read(b, &b_size);
    assert_int_equal(a_size, b_size);
    assert_memory_equal(a_content, b_content, a_size);
    free(a_content);
    free(b_content);
}

int folder_count(const char *path)
{
    DIR *folder = opendir(path);
    assert_non_null(folder);
    int count = 0;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(folder);
    return count;
}

/* Both cameras stand above the origin and look down: a turn by -90 degrees about x. */
static const char scene_text[] =
    "{ \"asset\": { \"version\": \"2.0\" },"
    "  \"extensionsUsed\": [\"KHR_lights_punctual\", \"KHR_materials_variants\"],"
    "  \"extensions\": { \"KHR_lights_punctual\": { \"lights\": [{ \"type\": \"directional\", \"intensity\": 3 }] },"
    "    \"KHR_materials_variants\": { \"variants\": [{ \"name\": \"day\" }, { \"name\": \"night\" }] } },"
    "  \"scene\": 0, \"scenes\": [{ \"nodes\": [0, 1, 2, 3] }],"
    "  \"nodes\": [{ \"mesh\": 0 },"
    "    { \"camera\": 0, \"translation\": [0, 2, 0], \"rotation\": [-0.70710678, 0, 0, 0.70710678] },"
    "    { \"camera\": 1, \"translation\": [0, 0.5, 0], \"rotation\": [-0.70710678, 0, 0, 0.70710678] },"
    "    { \"rotation\": [-0.70710678, 0, 0, 0.70710678],"
    "      \"extensions\": { \"KHR_lights_punctual\": { \"light\": 0 } } }],"
    "  \"cameras\": [{ \"name\": \"Main\", \"type\": \"perspective\", \"perspective\": { \"yfov\": 0.4, \"znear\": "
    "0.01 } },"
    "    { \"name\": \"Close\", \"type\": \"perspective\", \"perspective\": { \"yfov\": 0.4, \"znear\": 0.01 } }],"
    "  \"materials\": ["
    "    { \"name\": \"panel\", \"pbrMetallicRoughness\": { \"baseColorFactor\": [0.8, 0.2, 0.1, 1], "
    "\"metallicFactor\": 0 } },"
    "    { \"name\": \"dark\", \"pbrMetallicRoughness\": { \"baseColorFactor\": [0.01, 0.01, 0.02, 1] } }],"
    "  \"meshes\": [{ \"primitives\": [{ \"attributes\": { \"POSITION\": 0, \"NORMAL\": 1, \"TEXCOORD_0\": 2 },"
    "    \"indices\": 3, \"material\": 0, \"extensions\": { \"KHR_materials_variants\": { \"mappings\": ["
    "      { \"material\": 0, \"variants\": [0] }, { \"material\": 1, \"variants\": [1] }] } } }] }],"
    "  \"accessors\": ["
    "    { \"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\","
    "      \"min\": [-0.5, 0, -0.5], \"max\": [0.5, 0, 0.5] },"
    "    { \"bufferView\": 1, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\" },"
    "    { \"bufferView\": 2, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC2\" },"
    "    { \"bufferView\": 3, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\" }],"
    "  \"bufferViews\": [{ \"buffer\": 0, \"byteOffset\": 0, \"byteLength\": 48 },"
    "    { \"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 48 },"
    "    { \"buffer\": 0, \"byteOffset\": 96, \"byteLength\": 32 },"
    "    { \"buffer\": 0, \"byteOffset\": 128, \"byteLength\": 12 }],"
    "  \"buffers\": [{ \"uri\": \"plane.bin\", \"byteLength\": 140 }] }";

static const struct scene_bytes {
    float position[4][3], normal[4][3], texcoord[4][2];
    uint16_t index[6];
} scene_bytes = {
    { { -0.5F, 0.0F, -0.5F }, { -0.5F, 0.0F, 0.5F }, { 0.5F, 0.0F, 0.5F }, { 0.5F, 0.0F, -0.5F } },
    { { 0.0F, 1.0F, 0.0F }, { 0.0F, 1.0F, 0.0F }, { 0.0F, 1.0F, 0.0F }, { 0.0F, 1.0F, 0.0F } },
    { { 0.0F, 0.0F }, { 0.0F, 1.0F }, { 1.0F, 1.0F }, { 1.0F, 0.0F } },
    { 0, 1, 2, 0, 2, 3 },
};

void scene_write(const char *base)
{
    const char *slash = strrchr(base, '/');
    const int folder_length = slash ? (int)(slash - base) + 1 : 0;
    char path[512];
    snprintf(path, sizeof path, "%.*splane.bin", folder_length, base);
    file_write(path, &scene_bytes, sizeof scene_bytes);
    snprintf(path, sizeof path, "%s.gltf", base);
    file_write_text(path, scene_text);
}

int workplace_enter_plane(void **state)
{
    const int result = workplace_enter(state);
    if (result == 0)
        scene_write("plane");
    return result;
}
