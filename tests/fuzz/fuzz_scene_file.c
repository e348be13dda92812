/* Any bytes at all as a glTF file: an error or a scene whose every index holds. */
#include "fuzz_file.h"
#include "io/scene_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_mesh(const scene *s, const scene_mesh *mesh)
{
    if (mesh->material < 0 || mesh->material >= s->material_count || !mesh->position || !mesh->normal || !mesh->index)
        abort();
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++)
        if (mesh->index[i] >= mesh->vertex_count)
            abort();
    /* Reads the ends of what may be there, so that the address sanitizer sees a short array. */
    const volatile float *arrays[] = { mesh->tangent, mesh->texcoord[0], mesh->texcoord[1], mesh->color };
    const size_t widths[] = { 4, 2, 2, 4 };
    for (size_t k = 0; k < 4; k++)
        if (arrays[k])
            (void)arrays[k][widths[k] * mesh->vertex_count - 1];
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    report r = { 0 };
    scene s;
    if (!scene_file_read(fuzz_file("input.gltf", data, size), NULL, &s, &r)) {
        if (r.error[0] == '\0' || s.mesh_count != 0 || s.images)
            abort();
        return 0;
    }
    for (int i = 0; i < s.mesh_count; i++)
        check_mesh(&s, &s.meshes[i]);
    for (int i = 0; i < s.instance_count; i++)
        if (s.instances[i].mesh < 0 || s.instances[i].mesh >= s.mesh_count)
            abort();
    free(scene_describe(&s, true));
    scene_free(&s);
    return 0;
}
