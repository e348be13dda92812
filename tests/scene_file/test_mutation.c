/* Thirteen thousand broken files: each is refused with a reason or gives a whole scene, and none takes long or much
 * memory.
 *
 * The mutants follow from fixed seeds, so that a failure can be repeated; tests/fuzz searches further. */
#define SEEDS_FOLDER GLINT_TEST_DATA "/"
#define MODELS "/usr/share/assimp/models/glTF2/"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "gltf_case.h"
#include "io/scene_motion.h"
#include "mutant.h"
#include "scene_fault.h"

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
    size_t at = mutant_below(b.size);
    while (at < b.size && digits_at(b, at) == 0)
        at++;
    const char *value = values[mutant_below(sizeof values / sizeof values[0])];
    return bytes_splice(b, at, digits_at(b, at), value, strlen(value));
}

static bytes mutate(bytes b)
{
    const size_t at = mutant_below(b.size);
    const size_t length = mutant_below(b.size - at < 64 ? b.size - at : 64) + 1;
    uint8_t byte = b.data[at];
    switch (mutant_below(6)) {
    case 0:
        byte ^= (uint8_t)(1U << mutant_below(8));
        return bytes_splice(b, at, 1, &byte, 1);
    case 1:
        byte = (uint8_t)mutant_below(256);
        return bytes_splice(b, at, 1, &byte, 1);
    case 2:
        return bytes_splice(b, at, length <= b.size - at ? length : 1, "", 0);
    case 3: /* says something twice, or puts it elsewhere */
        return bytes_splice(b, mutant_below(b.size), 0, b.data + at, length <= b.size - at ? length : 1);
    default: /* most often: it is numbers that point and count */
        return replace_number(b);
    }
}

/* Reads what was written last; a scene must be whole, a refusal must have a reason. */
static void check_one(gltf_case *c, const char *seed, unsigned number)
{
    const double start = cpu_seconds();
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
    if (cpu_seconds() - start > 10.0) /* some hundred times what the slowest takes */
        fail_msg("mutant %u of %s took %g s", number, seed, cpu_seconds() - start);
}

static void check_mutants(gltf_case *c, const char *name, const char *path, unsigned count)
{
    const bytes seed = bytes_read(path);
    for (unsigned i = 0; i < count; i++) {
        const bytes mutant = mutant_of(seed, i, mutate);
        gltf_case_write(c, name, mutant.data, mutant.size);
        check_one(c, path, i);
        free(mutant.data);
    }
    free(seed.data);
}

/* At rest and in three poses a scene that is accepted must be whole. */
static void mutants_of_a_file_that_moves_are_whole_or_refused(void **state)
{
    gltf_case *c = *state;
    const bytes seed = bytes_read(SEEDS_FOLDER "moving.gltf");
    int accepted = 0;
    for (unsigned i = 0; i < 3000; i++) {
        const bytes mutant = mutant_of(seed, i, mutate);
        gltf_case_write(c, "scene.gltf", mutant.data, mutant.size);
        free(mutant.data);
        scene_motion *motion;
        scene_free(&c->scene);
        c->said.error[0] = '\0';
        if (!scene_motion_open(c->path, NULL, NULL, &c->scene, &motion, &c->said) &&
            (c->said.error[0] == '\0' || c->scene.meshes || motion))
            fail_msg("mutant %u: refused without a reason, or not emptied", i);
        accepted += motion != NULL;
        for (int k = 0; motion && k < 3; k++) {
            scene_motion_pose(motion, 0.4 * k, &c->scene, &c->said);
            const char *fault = scene_fault(&c->scene);
            if (fault)
                fail_msg("mutant %u at %g s: %s", i, 0.4 * k, fault);
        }
        scene_motion_close(motion);
    }
    free(seed.data);
    assert_true(accepted > 100); /* else nothing was posed */
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
    const bytes json = bytes_read(MODELS "draco/2CylinderEngine.gltf"),
                data = bytes_read(MODELS "draco/2CylinderEngine.bin");
    for (unsigned i = 0; i < 150; i++) {
        mutant_start(0xD1B54A32D192ED03U * (i + 1));
        bytes copy = bytes_splice(data, 0, 0, "", 0);
        for (int k = 0; k < 4; k++)
            copy.data[mutant_below(copy.size)] ^= (uint8_t)(1U << mutant_below(8));
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
        TEST(mutants_of_a_file_that_moves_are_whole_or_refused),
        TEST(mutants_of_real_files_are_whole_or_refused),
        TEST(mutants_of_draco_data_are_whole_or_refused),
    };
    return cmocka_run_group_tests_name("gltf_mutation", tests, NULL, NULL);
}
