/* Broken files, exported, taken back and validated: each is refused with a reason or comes back byte for byte, and none
 * takes long.
 *
 * An argument says how many mutants each seed gets (500): `./dev fuzz` asks for 1e5 in all, under the sanitizers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "glint_export.h"
#include "gltf_case.h"
#include "io/validate.h"

#define MODELS "/usr/share/assimp/models/glTF2/"

static unsigned mutants_per_seed = 500;

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
    b.data = malloc(b.size + 1);
    assert_non_null(b.data);
    assert_int_equal(fread(b.data, 1, b.size, file), b.size);
    fclose(file);
    return b;
}

static bytes splice(bytes from, size_t at, size_t length, const void *by, size_t by_size)
{
    bytes out = { malloc(from.size - length + by_size + 1), from.size - length + by_size };
    assert_non_null(out.data);
    memcpy(out.data, from.data, at);
    memcpy(out.data + at, by, by_size);
    memcpy(out.data + at + by_size, from.data + at + length, from.size - at - length);
    return out;
}

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
    const size_t at = below(below(2) == 0 && b.size > 2048 ? 2048 : b.size);
    const size_t most = b.size - at < 64 ? b.size - at : 64, length = below(most) + 1;
    uint8_t byte = b.data[at];
    const char *word = words[below(sizeof words / sizeof words[0])];
    switch (below(6)) {
    case 0:
        byte ^= (uint8_t)(1U << below(8));
        return splice(b, at, 1, &byte, 1);
    case 1:
        return splice(b, at, length, "", 0);
    case 2: /* says something twice, or puts it elsewhere */
        return splice(b, below(b.size), 0, b.data + at, length);
    case 3: /* a digit is the most fruitful byte to change */
        byte = (uint8_t)('0' + below(10));
        return splice(b, at, 1, &byte, 1);
    default:
        return splice(b, at, below(2) == 0 ? 0 : length, word, strlen(word));
    }
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
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
    const double start = seconds();
    unsigned issues = 0;
    const bool valid = validate_file(c->path, ignore, &issues);
    if (!valid && issues == 0)
        fail_msg("mutant %u of %s: invalid without an issue", number, seed);
    if (export(c->path, out, 0, seed, number)) {
        /* A record that was mutated may say anything; taking it back must end in a whole file or a reason. */
        const bool stripped = export(out, back, 1, seed, number);
        if (!has_record) {
            assert_true(stripped);
            const bytes a = read_bytes(c->path), b = read_bytes(back);
            if (a.size != b.size || memcmp(a.data, b.data, a.size) != 0)
                fail_msg("mutant %u of %s did not come back byte for byte", number, seed);
            free(a.data);
            free(b.data);
        }
    }
    if (seconds() - start > 1.0)
        fail_msg("mutant %u of %s took %g s", number, seed, seconds() - start);
}

static void check_seed(gltf_case *c, const char *name, const char *path, bool has_record)
{
    const bytes seed = read_bytes(path);
    for (unsigned i = 0; i < mutants_per_seed; i++) {
        random_state = 0x9E3779B97F4A7C15U * (i + 1);
        bytes mutant = mutate(seed);
        for (size_t more = below(3); more > 0 && mutant.size > 1; more--) {
            const bytes next = mutate(mutant);
            free(mutant.data);
            mutant = next;
        }
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
