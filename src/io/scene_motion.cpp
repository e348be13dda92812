// A scene that moves: what is left of its file after reading poses the nodes, and they are read anew.
#include "io/scene_motion.h"

#include <memory>

#include "io/gltf_animation.hpp"
#include "io/gltf_scene.hpp"
#include "io/scene_bounds.h"

struct scene_motion {
    gltf_file file = {};
    std::vector<gltf_mesh_range> meshes;
    gltf_animation animation;
    uint64_t elements_left = 0; // for the nodes, each time that they are read
};

bool scene_motion_open(const char *path, const scene_file_options *options, const char *animation, scene *out,
                       scene_motion **motion, report *r)
{
    *out = scene{};
    *motion = nullptr;
    try {
        auto made = std::make_unique<scene_motion>();
        made->file.moves = true;
        made->meshes = gltf_read_scene(path, options, made->file, out, r);
        made->animation = gltf_read_animation(made->file, animation);
        made->elements_left = made->file.elements_left;
        *motion = made.release();
        return true;
    } catch (...) {
        gltf_report(path, r);
    }
    scene_free(out);
    return false;
}

void scene_motion_close(scene_motion *m)
{
    delete m;
}

double scene_motion_end_s(const scene_motion *m)
{
    return m->animation.end_s;
}

bool scene_motion_pose(scene_motion *m, double time_s, scene *s, report *r)
{
    scene posed = {};
    try {
        m->file.warnings = r;
        m->file.elements_left = m->elements_left;
        gltf_pose(m->animation, time_s, m->file.model);
        gltf_read_nodes(m->file, m->meshes, &posed);
    } catch (...) {
        gltf_report(m->file.path.c_str(), r);
        scene_free(&posed);
        return false;
    }
    std::swap(s->instances, posed.instances);
    std::swap(s->instance_count, posed.instance_count);
    std::swap(s->cameras, posed.cameras);
    std::swap(s->camera_count, posed.camera_count);
    std::swap(s->lights, posed.lights);
    std::swap(s->light_count, posed.light_count);
    scene_free(&posed);
    scene_compute_bounds(s);
    return true;
}
