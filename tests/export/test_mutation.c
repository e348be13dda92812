/* Broken files, exported, taken back and validated: each is refused with a reason or comes back byte for byte, and none
 * takes long.
 *
 * An argument says how many mutants each seed gets (500): `./dev fuzz` asks for 1e5 in all, under the sanitizers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glint_export.h"
#include "gltf_case.h"
#include "io/validate.h"
#include "mutant.h"

#define MODELS "/usr/share/assimp/models/glTF2/"

static unsigned mutants_per_seed = 500;

/* What JSON is made of, and names that this code looks for. */
static const char *const words[] = { "{",         "}",          "[",        "]",          ",",
                                     ":",         "\"",         "null",     "-1",         "0",
                                     "1e400",     "4294967296", "\\u0000",  "extensions", "extras",
                                     "export",    "added",      "replaced", "binBytes",   "GLINT_materials_glint",
                                     "materials", "name",       "[]",       "{}",         "\"/materials/0\"",
                                     "\"\"",      " " };

/* Half of the changes hit the JSON, which lies in front. */
static bytes mutate(bytes b)
{
    const size_t at = mutant_below(mutant_below(2) == 0 && b.size > 2048 ? 2048 : b.size);
    const size_t most = b.size - at < 64 ? b.size - at : 64, length = mutant_below(most) + 1;
    uint8_t byte = b.data[at];
    const char *word = words[mutant_below(sizeof words / sizeof words[0])];
    switch (mutant_below(6)) {
    case 0:
        byte ^= (uint8_t)(1U << mutant_below(8));
        return bytes_splice(b, at, 1, &byte, 1);
    case 1:
        return bytes_splice(b, at, length, "", 0);
    case 2: /* says something twice, or puts it elsewhere */
        return bytes_splice(b, mutant_below(b.size), 0, b.data + at, length);
    case 3: /* a digit is the most fruitful byte to change */
        byte = (uint8_t)('0' + mutant_below(10));
        return bytes_splice(b, at, 1, &byte, 1);
    default:
        return bytes_splice(b, at, mutant_below(2) == 0 ? 0 : length, word, strlen(word));
    }
}

static bool export(const char *input, const char *output, int strip, const char *seed, unsigned number)
{
    const glint_export_assignment material = { "*", "brushed-steel" }, value = { "/glintDensity", "2e7" };
    glint_export_gltf_options o = GLINT_EXPORT_GLTF_OPTIONS_INIT;
    o.input = input;
    o.output = output;
    o.strip = strip;
    o.materials = &material;
    o.values = &value;
    o.material_count = o.value_count = strip ? 0 : 1;
    char message[1024] = "";
    const glint_export_result result = glint_export_gltf(&o, message, sizeof message);
    if (result != GLINT_EXPORT_OK && message[0] == '\0')
        fail_msg("mutant %u of %s: refused without a reason", number, seed);
    return result == GLINT_EXPORT_OK;
}

/* A new file from what is read of it: whole or refused with a reason. */
static void write_new(const char *input, const char *output, const char *seed, unsigned number)
{
    glint_export_gltf_scene_options o = GLINT_EXPORT_GLTF_SCENE_OPTIONS_INIT;
    o.input = input;
    o.output = output;
    char message[1024] = "";
    if (glint_export_gltf_scene(&o, message, sizeof message) != GLINT_EXPORT_OK && message[0] == '\0')
        fail_msg("mutant %u of %s: refused as a new file without a reason", number, seed);
}

static void ignore(const validate_issue *issue, void *user)
{
    assert_true(issue->code[0] != '\0' && issue->found[0] != '\0');
    ++*(unsigned *)user;
}

static void check_mutant(gltf_case *c, const char *name, const char *seed, unsigned number, bool has_record)
{
    char out[600], back[600];
    snprintf(out, sizeof out, "%s/out-%s", c->folder, name);
    snprintf(back, sizeof back, "%s/back-%s", c->folder, name);
    const double start = cpu_seconds();
    unsigned issues = 0;
    write_new(c->path, out, seed, number);
    const bool valid = validate_file(c->path, ignore, &issues);
    if (!valid && issues == 0)
        fail_msg("mutant %u of %s: invalid without an issue", number, seed);
    if (export(c->path, out, 0, seed, number)) {
        /* A record that was mutated may say anything; taking it back must end in a whole file or a reason. */
        const bool stripped = export(out, back, 1, seed, number);
        if (!has_record) {
            assert_true(stripped);
            const bytes a = bytes_read(c->path), b = bytes_read(back);
            if (a.size != b.size || memcmp(a.data, b.data, a.size) != 0)
                fail_msg("mutant %u of %s did not come back byte for byte", number, seed);
            free(a.data);
            free(b.data);
        }
    }
    if (cpu_seconds() - start > 10.0) /* a thousand times what the slowest takes */
        fail_msg("mutant %u of %s took %g s", number, seed, cpu_seconds() - start);
}

static void check_seed(gltf_case *c, const char *name, const char *path, bool has_record)
{
    const bytes seed = bytes_read(path);
    for (unsigned i = 0; i < mutants_per_seed; i++) {
        const bytes mutant = mutant_of(seed, i, mutate);
        gltf_case_write(c, name, mutant.data, mutant.size);
        check_mutant(c, name, path, i, has_record);
        free(mutant.data);
    }
    free(seed.data);
}

static void mutants_of_files_come_back_or_are_refused(void **state)
{
    check_seed(*state, "scene.gltf", GLINT_TEST_DATA "/everything.gltf", false);
    check_seed(*state, "scene.glb", MODELS "BoxTextured-glTF-Binary/BoxTextured.glb", false);
    check_seed(*state, "scene.gltf", MODELS "simple_skin/simple_skin.gltf", false);
}

static void mutants_of_exported_files_are_whole_or_refused(void **state)
{
    gltf_case *c = *state;
    char seed[600];
    snprintf(seed, sizeof seed, "%s/seed.glb", c->folder);
    assert_true(export(MODELS "BoxTextured-glTF-Binary/BoxTextured.glb", seed, 0, "the seed", 0));
    check_seed(c, "scene.glb", seed, true);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        mutants_per_seed = (unsigned)strtoul(argv[1], NULL, 10);
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(mutants_of_files_come_back_or_are_refused),
        TEST(mutants_of_exported_files_are_whole_or_refused),
    };
    return cmocka_run_group_tests_name("export_mutation", tests, NULL, NULL);
}
