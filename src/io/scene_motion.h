/* A scene that moves: its file is read once, and put into the pose of any time. */
#ifndef IO_SCENE_MOTION_H
#define IO_SCENE_MOTION_H

#include "io/scene_file.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is needed of a file to pose its scene. */
typedef struct scene_motion scene_motion;

/* As scene_file_read, with the animations, which are checked as well: that of the given name, or of that number where
 * none is called so, or, for NULL, all of them together. An error where there is none, where one moves what another
 * moves, and where keys are not what glTF 2.0 says. *out is at rest: as the file's nodes stand. */
bool scene_motion_open(const char *path, const scene_file_options *options, const char *animation, scene *out,
                       scene_motion **motion, report *r);
/* NULL is allowed. */
void scene_motion_close(scene_motion *m);

/* Of the last key, seconds; nothing moves from there on. */
double scene_motion_end_s(const scene_motion *m);

/* Puts the scene's instances, cameras and lights where they are at a time, and fits its bounds; the arrays are new, all
 * else of the scene stays. What comes of a time depends on nothing that was posed before. Translations, rotations and
 * scales move; weights of morph targets, skins and what else KHR_animation_pointer may point to stay. On failure the
 * scene stays as it was. */
bool scene_motion_pose(scene_motion *m, double time_s, scene *s, report *r);

#ifdef __cplusplus
}
#endif

#endif
