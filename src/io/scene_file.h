/* Reads scenes (.gltf, .glb) and material presets (a glTF material object in a file of its own). */
#ifndef IO_SCENE_FILE_H
#define IO_SCENE_FILE_H

#include "scene/report.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene_file_options {
    const char *variant; /* KHR_materials_variants: its name; NULL: the file's own materials */
} scene_file_options;

/* Fills *out, or reports an error, leaves *out zeroed and returns false. Hostile files end in an error, never in a
 * crash: sizes, depth, every index, offset, stride and cycle are checked, and no path leaves the file's folder. */
bool scene_file_read(const char *path, const scene_file_options *options, scene *out, report *r);

/* A preset: materials/NAME.gltf-material.json, or a path when the name has a slash or ends in .json.
 * The folder is $GLINT_MATERIALS, else share/libglint/materials beside the folder of the program. Textures of a preset
 * refer to the arrays "textures", "images" and "samplers" of its extras, as they would to those of a glTF file; its
 * images are appended to s->images. The caller frees out->name. An unknown name is an error that lists the nearest
 * ones. */
bool preset_read(const char *name_or_path, scene *s, scene_material *out, report *r);

/* Calls visit for every preset that is installed, in alphabetical order; note is the line that says where its numbers
 * come from. */
bool preset_each(void (*visit)(const char *name, const char *title, const char *note, void *user), void *user,
                 report *r);

/* Replaces the material called material_name (or every one, for "*") with the preset; keeps its name. An unknown name
 * is an error that lists the names there are. */
bool preset_apply(scene *s, const char *material_name, const char *preset, report *r);

/* The file as one JSON document for `glint inspect --json`, or as lines for people. Text ends with a newline; free it.
 */
char *scene_describe(const scene *s, bool json);

#ifdef __cplusplus
}
#endif

#endif
