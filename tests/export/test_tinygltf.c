/* Another program's reader and writer carries an exported file: the extension and the material arrive. (What it loses,
 * such as null and integers beyond int, is why the exporter does not use it.) */
#include <stdio.h>
#include <string.h>

#include "carry_tinygltf.h"
#include "glint_export.h"
#include "gltf_case.h"

static scene_material material_of(gltf_case *c, const char *path)
{
    scene_free(&c->scene);
    snprintf(c->path, sizeof c->path, "%s", path);
    gltf_case_accepted(c);
    scene_material m = c->scene.materials[0];
    m.name = NULL;
    return m;
}

static void tinygltf_carries_the_extension(void **state)
{
    gltf_case *c = *state;
    char first[128], second[128], message[1024];
    snprintf(first, sizeof first, "%s/first.glb", c->folder);
    snprintf(second, sizeof second, "%s/second.glb", c->folder);
    const glint_export_assignment preset = { "*", "brushed-steel" };
    glint_export_gltf_options o = GLINT_EXPORT_GLTF_OPTIONS_INIT;
    o.input = "/usr/share/assimp/models/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb";
    o.output = first;
    o.materials = &preset;
    o.material_count = 1;
    assert_int_equal(glint_export_gltf(&o, message, sizeof message), GLINT_EXPORT_OK);

    double density;
    int tangents;
    assert_true(carry_tinygltf(first, second, &density, &tangents));
    assert_true(density == 4e8); /* of the preset */
    assert_int_equal(tangents, 1);
    const scene_material before = material_of(c, first), after = material_of(c, second);
    assert_true(before.glint.present);
    assert_memory_equal(&before, &after, sizeof before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(tinygltf_carries_the_extension, gltf_case_begin, gltf_case_end),
    };
    return cmocka_run_group_tests_name("export_tinygltf", tests, NULL, NULL);
}
