/* Ten thousand broken files: each is refused with a reason or gives a whole scene, and none takes long or much memory.
 *
 * The mutants follow from fixed seeds, so that a failure can be repeated; tests/fuzz searches further. */
#define SEEDS_FOLDER GLINT_TEST_DATA "/"
#define MODELS "/usr/share/assimp/models/glTF2/"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "gltf_case.h"
#include "scene_fault.h"

typedef struct bytes {
    uint8_t *data;
    size_t size;
} bytes;

static uint64_t random_state;

/* Marsaglia's xorshift64. */
static size_t below(size_t limit)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (size_t)(random_state % limit);
}

static bytes read_bytes(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s cannot be opened", path);
    fseek(file, 0, SEEK_END);
    bytes b = { NULL, (size_t)ftell(file) };
    rewind(file);
    b.data = malloc(b.size);
    assert_non_null(b.data);
    assert_int_equal(fread(b.data, 1, b.size, file), b.size);
    fclose(file);
    return b;
}

/* Replaces length bytes at a place by others. */
static bytes splice(bytes from, size_t at, size_t length, const void *by, size_t by_size)
{
    bytes out = { malloc(from.size - length + by_size), from.size - length + by_size };
    assert_non_null(out.data);
    memcpy(out.data, from.data, at);
    memcpy(out.data + at, by, by_size);
    memcpy(out.data + at + by_size, from.data + at + length, from.size - at - length);
    return out;
}

static size_t digits_at(bytes b, size_t at)
{
    size_t length = 0;
    while (at + length < b.size && length < 20 && b.data[at + length] >= '0' && b.data[at + length] <= '9')
        length++;
    return length;
}

/* Numbers at the edges of types, and values of other types. */
static bytes replace_number(bytes b)
{
    static const char *const values[] = { "-1",         "0",
                                          "1",          "2",
                                          "3",          "7",
                                          "255",        "65535",
                                          "65536",      "2147483647",
                                          "2147483648", "4294967295",
                                          "1e39",       "1e400",
                                          "-0",         "0.5",
                                          "null",       "\"\"",
                                          "[]",         "{}",
                                          "true",       "18446744073709551616" };
    size_t at = below(b.size);
    while (at < b.size && digits_at(b, at) == 0)
        at++;
    const char *value = values[below(sizeof values / sizeof values[0])];
    return splice(b, at, digits_at(b, at), value, strlen(value));
}

static bytes mutate(bytes b)
{
    const size_t at = below(b.size);
    const size_t length = below(b.size - at < 64 ? b.size - at : 64) + 1;
    uint8_t byte = b.data[at];
    switch (below(6)) {
    case 0:
        byte ^= (uint8_t)(1U << below(8));
        return splice(b, at, 1, &byte, 1);
    case 1:
        byte = (uint8_t)below(256);
        return splice(b, at, 1, &byte, 1);
    case 2:
        return splice(b, at, length <= b.size - at ? length : 1, "", 0);
    case 3: /* says something twice, or puts it elsewhere */
        return splice(b, below(b.size), 0, b.data + at, length <= b.size - at ? length : 1);
    default: /* most often: it is numbers that point and count */
        return replace_number(b);
    }
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Reads what was written last; a scene must be whole, a refusal must have a reason. */
static void check_one(gltf_case *c, const char *seed, unsigned number)
{
    const double start = seconds();
    if (gltf_case_read(c)) {
        const char *fault = scene_fault(&c->scene);
        if (fault)
            fail_msg("mutant %u of %s: %s", number, seed, fault);
        char *text = scene_describe(&c->scene, true);
        assert_non_null(text);
        free(text);
    } else if (c->said.error[0] == '\0' || c->scene.meshes || c->scene.images) {
        fail_msg("mutant %u of %s: refused without a reason, or not emptied", number, seed);
    }
    if (seconds() - start > 10.0) /* a thousand times what the largest seed takes */
        fail_msg("mutant %u of %s took %g s", number, seed, seconds() - start);
}

static void check_mutants(gltf_case *c, const char *name, const char *path, unsigned count)
{
    const bytes seed = read_bytes(path);
    for (unsigned i = 0; i < count; i++) {
        random_state = 0x9E3779B97F4A7C15U * (i + 1);
        bytes mutant = mutate(seed);
        for (size_t more = below(3); more > 0 && mutant.size > 1; more--) {
            const bytes next = mutate(mutant);
            free(mutant.data);
            mutant = next;
        }
        gltf_case_write(c, name, mutant.data, mutant.size);
        check_one(c, path, i);
        free(mutant.data);
    }
    free(seed.data);
}

/* ru_maxrss counts KiB; sanitizers keep freed memory for a while, so the bound is generous: 2 GiB. */
static void assert_little_memory(void)
{
    struct rusage usage;
    assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
    assert_true(usage.ru_maxrss < 2L * 1024 * 1024);
}

static void mutants_of_a_file_with_everything_are_whole_or_refused(void **state)
{
    check_mutants(*state, "scene.gltf", SEEDS_FOLDER "everything.gltf", 6000);
    assert_little_memory();
}

static void mutants_of_real_files_are_whole_or_refused(void **state)
{
    static const char *const seeds[] = { MODELS "BoxTextured-glTF-Binary/BoxTextured.glb",
                                         MODELS "simple_skin/simple_skin.gltf", MODELS "issue_3269/texcoord_crash.gltf",
                                         MODELS "BoxBadNormals-glTF-Binary/BoxBadNormals.glb" };
    for (size_t i = 0; i < sizeof seeds / sizeof seeds[0]; i++)
        check_mutants(*state, "scene.gltf", seeds[i], 1000);
    assert_little_memory();
}

/* The compressed bytes change, the JSON stays. */
static void mutants_of_draco_data_are_whole_or_refused(void **state)
{
    gltf_case *c = *state;
    const bytes json = read_bytes(MODELS "draco/2CylinderEngine.gltf"),
                data = read_bytes(MODELS "draco/2CylinderEngine.bin");
    for (unsigned i = 0; i < 150; i++) {
        random_state = 0xD1B54A32D192ED03U * (i + 1);
        bytes copy = splice(data, 0, 0, "", 0);
        for (int k = 0; k < 4; k++)
            copy.data[below(copy.size)] ^= (uint8_t)(1U << below(8));
        gltf_case_write(c, "2CylinderEngine.bin", copy.data, copy.size);
        gltf_case_write(c, "scene.gltf", json.data, json.size);
        check_one(c, "2CylinderEngine.bin", i);
        free(copy.data);
    }
    free(json.data);
    free(data.data);
    assert_little_memory();
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(mutants_of_a_file_with_everything_are_whole_or_refused),
        TEST(mutants_of_real_files_are_whole_or_refused),
        TEST(mutants_of_draco_data_are_whole_or_refused),
    };
    return cmocka_run_group_tests_name("gltf_mutation", tests, NULL, NULL);
}
