/* Any bytes at all as a glTF file: an error or a whole scene, at rest and in motion. */
#include "fuzz_file.h"
#include "io/scene_motion.h"
#include "scene_fault.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The same file as one that moves. */
static void pose_motion(const char *path)
{
    report r = { 0 };
    scene s;
    scene_motion *motion;
    if (!scene_motion_open(path, NULL, NULL, &s, &motion, &r)) {
        if (r.error[0] == '\0' || motion || s.meshes)
            abort();
        return;
    }
    for (int i = 0; i < 3; ++i) {
        scene_motion_pose(motion, 0.4 * i, &s, &r);
        if (scene_fault(&s))
            abort();
    }
    scene_motion_close(motion);
    scene_free(&s);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    report r = { 0 };
    scene s;
    const char *const path = fuzz_file("input.gltf", data, size);
    pose_motion(path);
    if (!scene_file_read(path, NULL, &s, &r)) {
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
