/* Any bytes at all as a glTF file: an error or a whole scene. */
#include "fuzz_file.h"
#include "io/scene_file.h"
#include "scene_fault.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    report r = { 0 };
    scene s;
    if (!scene_file_read(fuzz_file("input.gltf", data, size), NULL, &s, &r)) {
        if (r.error[0] == '\0' || s.mesh_count != 0 || s.images)
            abort();
        return 0;
    }
    if (scene_fault(&s))
        abort();
    free(scene_describe(&s, true));
    scene_free(&s);
    return 0;
}
