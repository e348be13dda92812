/* Any bytes at all as a material preset: an error or a material that can replace another. */
#include "fuzz_file.h"
#include "io/scene_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    report r = { 0 };
    scene s = { 0 };
    scene_material material;
    if (preset_read(fuzz_file("input.json", data, size), &s, &material, &r))
        free(material.name);
    else if (r.error[0] == '\0')
        abort();
    scene_free(&s);
    return 0;
}
