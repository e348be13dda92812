/* The camera: one of the file's, or one that frames the scene. */
#include <stdlib.h>
#include <string.h>

#include "exporters/povray/povray.h"

/* Taste: the three-quarter view of product photography, as glint render frames a file without a camera. */
#define AZIMUTH_RAD 0.6
#define ELEVATION_RAD 0.4
#define YFOV_RAD 0.5
#define MARGIN 1.05

static double picture_aspect(const povray *p)
{
    return (double)p->options->width / (double)p->options->height;
}

/* All corners of the bounds are in the picture from this distance on. */
static double framing_distance(const povray *p, const eye *e)
{
    const scene *s = p->scene;
    const bool empty = !(s->bounds_min[0] <= s->bounds_max[0]);
    if (empty)
        return 4.0 * p->radius;
    const vec half = vec_scale(vec_sub(vec_of(s->bounds_max), vec_of(s->bounds_min)), 0.5);
    double distance = 0.01 * p->radius;
    for (int corner = 0; corner < 8; ++corner) {
        const vec c = { corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z };
        const double reach = fmax(fabs(vec_dot(c, e->right)) / e->half_width, fabs(vec_dot(c, e->up)) / e->half_height);
        distance = fmax(distance, MARGIN * reach - vec_dot(c, e->forward));
    }
    return distance;
}

static void frame(povray *p)
{
    eye *e = &p->eye;
    const vec back = { sin(AZIMUTH_RAD) * cos(ELEVATION_RAD), sin(ELEVATION_RAD),
                       cos(AZIMUTH_RAD) * cos(ELEVATION_RAD) };
    e->perspective = true;
    e->forward = vec_scale(back, -1.0);
    e->right = vec_unit(vec_cross(e->forward, (vec){ 0.0, 1.0, 0.0 }));
    e->up = vec_cross(e->right, e->forward);
    e->half_height = tan(0.5 * YFOV_RAD);
    e->half_width = e->half_height * picture_aspect(p);
    e->at = vec_add(p->centre, vec_scale(back, framing_distance(p, e)));
}

/* A picture of another shape than the camera's shows more, never less. */
static bool look_through(povray *p, const scene_camera *c)
{
    eye *e = &p->eye;
    e->perspective = c->projection == SCENE_PERSPECTIVE;
    e->at = matrix_column(c->to_world, 3);
    e->forward = vec_unit(vec_scale(matrix_column(c->to_world, 2), -1.0));
    const vec x = matrix_column(c->to_world, 0);
    e->right = vec_unit(vec_sub(x, vec_scale(e->forward, vec_dot(x, e->forward))));
    e->up = vec_cross(e->right, e->forward);
    if (!(vec_length(e->up) > 0.5)) {
        char name[NAME_LENGTH];
        name_comment(name, c->name);
        return report_error(p->report,
                            "%s: camera \"%s\": its node's transform is flat; expected three independent axes",
                            p->options->input, name);
    }
    const double aspect = picture_aspect(p);
    e->half_height = e->perspective ? tan(0.5 * (double)c->yfov_rad) : fabs((double)c->ymag);
    e->half_width = e->perspective ? e->half_height * (double)c->aspect : fabs((double)c->xmag);
    if ((e->perspective && !(c->aspect > 0.0F)) || aspect >= e->half_width / e->half_height)
        e->half_width = e->half_height * aspect;
    else
        e->half_height = e->half_width / aspect;
    return true;
}

/* A name first, a number only where no camera is called so. */
static const scene_camera *find(const scene *s, const char *wanted)
{
    for (int i = 0; i < s->camera_count; ++i)
        if (s->cameras[i].name && strcmp(s->cameras[i].name, wanted) == 0)
            return &s->cameras[i];
    const bool number = *wanted != '\0' && strlen(wanted) < 10 && wanted[strspn(wanted, "0123456789")] == '\0';
    return number && atoi(wanted) < s->camera_count ? &s->cameras[atoi(wanted)] : NULL;
}

bool eye_choose(povray *p)
{
    const scene *s = p->scene;
    const char *wanted = p->options->camera;
    if (wanted) {
        const scene_camera *c = find(s, wanted);
        if (!c)
            return report_error(p->report,
                                "%s: camera '%s' is unknown; expected the name of one of the file's %d, or "
                                "its number from 0",
                                p->options->input, wanted, s->camera_count);
        return look_through(p, c);
    }
    if (s->camera_count > 0)
        return look_through(p, &s->cameras[0]);
    notes_add(p->notes, NULL, "there is no camera; one that frames the scene is added");
    frame(p);
    return true;
}

/* To the last bit: POV-Ray warns of axes whose products are not below 1e-10. */
static void write_axis(text *out, const char *name, vec v)
{
    text_print(out, "  %s <%.17g, %.17g, %.17g>\n", name, v.x + 0.0, v.y + 0.0, v.z + 0.0);
}

void eye_write(const povray *p, text *out)
{
    const eye *e = &p->eye;
    const double size = e->perspective ? 1.0 : p->unit;
    text_print(out, "camera {\n  %s\n", e->perspective ? "perspective" : "orthographic");
    write_axis(out, "location", vec_scale(e->at, p->unit));
    write_axis(out, "right", vec_scale(e->right, 2.0 * e->half_width * size));
    write_axis(out, "up", vec_scale(e->up, 2.0 * e->half_height * size));
    write_axis(out, "direction", e->forward);
    text_print(out, "}\n\n");
}
