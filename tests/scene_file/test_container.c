/* The file around the scene: .glb chunks, JSON text, URIs. Whatever is wrong is named, and no path leaves the folder.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "gltf_case.h"

static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

#define TRIANGLE_MEMBERS                                                                                               \
    "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }],"                                                              \
    "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }],"                           \
    "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0 } }] }], 'nodes': [{ 'mesh': 0 }]"

#define TRIANGLE_GLB                                                                                                   \
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36}],\"bufferViews\":[{\"buffer\":0,"               \
    "\"byteLength\":36}],"                                                                                             \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"                         \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]}"

static uint8_t *file_content(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    uint8_t *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

static void glb_cut_anywhere_is_refused(void **state)
{
    gltf_case *c = *state;
    gltf_case_glb(c, TRIANGLE_GLB, triangle, sizeof triangle);
    gltf_case_accepted(c);
    size_t size;
    uint8_t *bytes = file_content(c->path, &size);
    for (size_t length = 0; length < size; length++) {
        gltf_case_write(c, "scene.glb", bytes, length);
        gltf_case_refused(c, length < 4 ? "neither the magic" : "truncated", NULL);
    }
    free(bytes);
}

static void glb_with_a_chunk_length_that_lies_is_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        size_t at;
        uint32_t value;
        const char *says;
    } lies[] = { { 4, 1, ".glb version 1" },
                 { 8, 1U << 31, "2147483648 bytes" },
                 { 12, UINT32_MAX, "4294967295 bytes" },
                 { 12, 0, "truncated" },
                 { 12, 3, "truncated" },
                 { 16, 0x004E4942, "not JSON" } };
    for (size_t i = 0; i < sizeof lies / sizeof lies[0]; i++) {
        gltf_case_glb(c, TRIANGLE_GLB, triangle, sizeof triangle);
        size_t size;
        uint8_t *bytes = file_content(c->path, &size);
        memcpy(bytes + lies[i].at, &lies[i].value, 4);
        gltf_case_write(c, "scene.glb", bytes, size);
        gltf_case_refused(c, lies[i].says, NULL);
        free(bytes);
    }
}

static void file_that_is_none_is_refused(void **state)
{
    gltf_case *c = *state;
    snprintf(c->path, sizeof c->path, "%s/none.gltf", c->folder);
    gltf_case_refused(c, "No such file", NULL);
    snprintf(c->path, sizeof c->path, "%s", c->folder);
    gltf_case_refused(c, "found a folder, expected a file", NULL);
    snprintf(c->path, sizeof c->path, "%s/pipe", c->folder);
    assert_int_equal(mkfifo(c->path, 0600), 0);
    gltf_case_refused(c, "not a regular file", NULL);
    gltf_case_write(c, "empty.gltf", "", 0);
    gltf_case_refused(c, "neither the magic", NULL);
    gltf_case_write(c, "picture.glb", "\x89PNG\r\n\x1a\n", 8);
    gltf_case_refused(c, "neither the magic", NULL);
}

static void text_that_is_not_json_is_refused_at_its_line(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *text, *says;
    } wrong[] = {
        { "{\n  \"asset\": {,}\n}", "line 2, column 13" },
        { "{\"asset\":{\"version\":\"2.0\"}", "line 1, column 27" },
        { "{\"asset\":{\"version\":\"2.0\"}} x", "line 1, column 29" },
        { "{\"asset\":{\"version\":\"2.0\",\"version\":\"2.0\"}}", "the key \"version\" twice" },
        { "{\"asset\":{\"version\":\"2.0\"},\"extras\":1e400}", "beyond the range of a double" },
        { "{\"asset\":{\"version\":\"\xFF\"}}", "not JSON" },
        { "{\"asset\":{\"version\":NaN}}", "not JSON" },
        { "{}", "found no \"asset\"" },
        { "{\"asset\":[]}", "/asset: found an array of 0, expected an object" },
        { "{\"asset\":{\"version\":\"1.0\"}}", "/asset/version: found \"1.0\", expected 2.0" },
        { "{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.1\"}}", "/asset/minVersion" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        gltf_case_write(c, "scene.gltf", wrong[i].text, strlen(wrong[i].text));
        gltf_case_refused(c, wrong[i].says, NULL);
    }
}

static void deep_json_is_refused_and_does_not_recurse(void **state)
{
    gltf_case *c = *state;
    const size_t depth = 1000000;
    char *deep = malloc(2 * depth + 1);
    assert_non_null(deep);
    memset(deep, '[', depth);
    memset(deep + depth, ']', depth);
    deep[2 * depth] = '\0';
    gltf_case_json(c, "'extras': %s", deep);
    gltf_case_refused(c, "nested deeper than 64", NULL);
    deep[depth + 50] = '\0';
    gltf_case_json(c, "'extras': %s", deep + depth - 50);
    gltf_case_accepted(c);
    free(deep);
}

static void byte_order_mark_is_skipped(void **state)
{
    gltf_case *c = *state;
    const char *text = "\xEF\xBB\xBF{\"asset\":{\"version\":\"2.0\"}}";
    gltf_case_write(c, "scene.gltf", text, strlen(text));
    gltf_case_accepted(c);
}

static void integers_beyond_their_range_are_refused(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'scene': 2147483648");
    gltf_case_refused(c, "/scene: found 2147483648, expected an index", NULL);
    gltf_case_json(c, "'buffers': [{ 'byteLength': 4294967296 }]");
    gltf_case_refused(c, "/buffers/0/byteLength: found 4294967296", NULL);
    gltf_case_json(c, "'buffers': [{ 'byteLength': 18446744073709551615 }]");
    gltf_case_refused(c, "/buffers/0/byteLength", NULL);
    gltf_case_json(c, "'buffers': [{ 'byteLength': -1 }]");
    gltf_case_refused(c, "/buffers/0/byteLength: found -1", NULL);
    gltf_case_json(c, "'buffers': [{ 'byteLength': 1.5 }]");
    gltf_case_refused(c, "/buffers/0/byteLength: found 1.5, expected an integer", NULL);
    gltf_case_json(c, "'nodes': [{ 'scale': [1, 1, 1e39] }]");
    gltf_case_refused(c, "/nodes/0/scale/2: found 1e+39", NULL);
}

/* glTF 2.0 section 2.7.1: 36, 36.0 and 3.6e1 are equivalent. */
static void integers_may_be_written_with_a_zero_fraction(void **state)
{
    gltf_case *c = *state;
    gltf_case_write(c, "data.bin", triangle, sizeof triangle);
    gltf_case_json(c, "'buffers': [{ 'uri': 'data.bin', 'byteLength': 3.6e1 }], 'bufferViews': [{ 'buffer': 0.0, "
                      "'byteLength': 36.0 }],"
                      "'accessors': [{ 'bufferView': 0, 'componentType': 5126.0, 'count': 3.0, 'type': 'VEC3' }],"
                      "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0.0 }, 'mode': 4.0 }] }], 'nodes': [{ "
                      "'mesh': 0e0 }]");
    gltf_case_accepted(c);
    assert_int_equal(c->scene.instance_count, 1);
}

static void uris_that_leave_the_folder_are_refused(void **state)
{
    gltf_case *c = *state;
    static const char *const uris[] = { "../data.bin",       "a/../../data.bin",
                                        "%2e%2e/data.bin",   "..%2Fdata.bin",
                                        "/etc/passwd",       "file:///etc/passwd",
                                        "http://h/data.bin", "C:/data.bin",
                                        "%2Fetc/passwd",     "",
                                        "data.bin%00.png",   "a/.." };
    for (size_t i = 0; i < sizeof uris / sizeof uris[0]; i++) {
        gltf_case_json(c, "'buffers': [{ 'uri': '%s', 'byteLength': 36 }], %s", uris[i], TRIANGLE_MEMBERS);
        gltf_case_refused(c, "/buffers/0/uri: found the", "folder", NULL);
        gltf_case_json(c, "'images': [{ 'uri': '%s' }]", uris[i]);
        gltf_case_refused(c, "/images/0/uri: found the", "folder", NULL);
    }
}

static void link_that_leaves_the_folder_is_refused(void **state)
{
    gltf_case *c = *state;
    char link[128];
    snprintf(link, sizeof link, "%s/data.bin", c->folder);
    assert_int_equal(symlink("/etc/passwd", link), 0);
    gltf_case_json(c, "'buffers': [{ 'uri': 'data.bin', 'byteLength': 36 }], %s", TRIANGLE_MEMBERS);
    gltf_case_refused(c, "leaves the file's folder", NULL);
}

static void percent_encoded_uris_name_files_of_the_folder(void **state)
{
    gltf_case *c = *state;
    char folder[128];
    snprintf(folder, sizeof folder, "%s/my parts", c->folder);
    assert_int_equal(mkdir(folder, 0700), 0);
    gltf_case_write(c, "my parts/100% \xC3\xA9..bin", triangle, sizeof triangle);
    gltf_case_json(c, "'buffers': [{ 'uri': 'my%%20parts/100%% %%c3%%A9..bin', 'byteLength': 36 }], %s",
                   TRIANGLE_MEMBERS);
    gltf_case_accepted(c);
    assert_true(c->scene.meshes[0].position[3] == 1.0F);
}

static void buffer_that_is_too_short_is_refused(void **state)
{
    gltf_case *c = *state;
    gltf_case_write(c, "data.bin", triangle, 35);
    gltf_case_json(c, "'buffers': [{ 'uri': 'data.bin', 'byteLength': 36 }], %s", TRIANGLE_MEMBERS);
    gltf_case_refused(c, "/buffers/0: found 35 bytes of data, expected the 36", NULL);
    gltf_case_json(c, "'buffers': [{ 'byteLength': 36 }], %s", TRIANGLE_MEMBERS);
    gltf_case_refused(c, "/buffers/0: found no \"uri\"", NULL);
}

static void data_uris_are_decoded_and_bad_ones_refused(void **state)
{
    gltf_case *c = *state;
    static const char *const members = "'bufferViews': [{ 'buffer': 0, 'byteLength': 3 }],"
                                       "'images': [{ 'bufferView': 0, 'mimeType': 'image/png' }]";
    gltf_case_json(c, "'buffers': [{ 'uri': 'data:application/octet-stream;base64,AQL/', 'byteLength': 3 }], %s",
                   members);
    gltf_case_accepted(c);
    assert_int_equal(c->scene.images[0].byte_count, 3);
    assert_memory_equal(c->scene.images[0].bytes, "\1\2\xFF", 3);
    static const char *const wrong[] = { "data:;base64,AQL",  "data:;base64,AQ\\n/", "data:;base64,A===", "data:,AQL/",
                                         "data:;base64,AQ-_", "data:;base64",        "data:;base64,AQ=/" };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        gltf_case_json(c, "'buffers': [{ 'uri': '%s', 'byteLength': 3 }], %s", wrong[i], members);
        gltf_case_refused(c, "/buffers/0/uri: found", NULL);
    }
}

static void unknown_extensions_warn_once_when_used_and_fail_when_required(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'extensionsUsed': ['EXT_fur', 'KHR_materials_ior']");
    gltf_case_accepted(c);
    gltf_case_warned(c, "EXT_fur is not known");
    assert_null(strstr(c->warnings, "KHR_materials_ior"));
    gltf_case_json(c, "'extensionsUsed': ['EXT_fur'], 'extensionsRequired': ['EXT_fur']");
    gltf_case_refused(c, "/extensionsRequired/0: found \"EXT_fur\"", NULL);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(glb_cut_anywhere_is_refused),
        TEST(glb_with_a_chunk_length_that_lies_is_refused),
        TEST(file_that_is_none_is_refused),
        TEST(text_that_is_not_json_is_refused_at_its_line),
        TEST(deep_json_is_refused_and_does_not_recurse),
        TEST(byte_order_mark_is_skipped),
        TEST(integers_beyond_their_range_are_refused),
        TEST(integers_may_be_written_with_a_zero_fraction),
        TEST(uris_that_leave_the_folder_are_refused),
        TEST(link_that_leaves_the_folder_is_refused),
        TEST(percent_encoded_uris_name_files_of_the_folder),
        TEST(buffer_that_is_too_short_is_refused),
        TEST(data_uris_are_decoded_and_bad_ones_refused),
        TEST(unknown_extensions_warn_once_when_used_and_fail_when_required),
    };
    return cmocka_run_group_tests_name("gltf_container", tests, NULL, NULL);
}
