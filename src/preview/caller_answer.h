/* What functions of glint_preview.h return, with its message; and the scene behind its handle. */
#ifndef PREVIEW_CALLER_ANSWER_H
#define PREVIEW_CALLER_ANSWER_H

#include "preview/caller_scene.h"

struct glint_preview_scene {
    caller_scene from;
    preview_stage *stage;
    int model;
};

glint_preview_result answer(glint_preview_result result, const char *text, char *message, size_t message_size);

/* What went wrong without an error was cancelled. */
glint_preview_result answer_of(bool done, const report *r, char *message, size_t message_size);

/* GLINT_PREVIEW_BAD_INPUT. */
glint_preview_result answer_wrong(char *message, size_t message_size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
