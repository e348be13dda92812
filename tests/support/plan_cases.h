/* Scenes that a plan must keep within its budget: every kind of light, few facets and many, layers, colours, shadows.
 */
#ifndef SUPPORT_PLAN_CASES_H
#define SUPPORT_PLAN_CASES_H

#include "preview/preview.h"

int plan_case_count(void);
const char *plan_case_name(int index);
/* A scene and options that look at it: 24 x 24 pixels, no bounces, black around. The options point to the scene and to
 * *camera. Freed by scene_free. */
scene plan_case(int index, scene_camera *camera, preview_options *options);

/* Root mean square over the pixels of (a - b) / b, of the mean of the channels; pixels where b is black are left out.
 */
double plan_case_error(const image *a, const image *b);

#endif
