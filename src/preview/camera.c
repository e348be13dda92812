/* glTF cameras look along -z with y up; rays start at the near plane's side of the lens and carry pixel steps. */
#include "preview/camera.h"

/* How far a picture of this shape opens in the direction across, relative to what the camera asks for. */
static void fit(camera *c, double camera_aspect)
{
    const double picture_aspect = (double)c->width / (double)c->height;
    if (picture_aspect >= camera_aspect)
        c->half_width = c->half_height * picture_aspect;
    else
        c->half_height = c->half_width / picture_aspect;
}

static bool has_window(const scene_camera *from)
{
    return from->window[0] < from->window[1];
}

static void set_window(camera *c, const float window[4])
{
    const double left = (double)window[0], right = (double)window[1];
    const double bottom = (double)window[2], top = (double)window[3];
    c->half_width = 0.5 * (right - left);
    c->half_height = 0.5 * (top - bottom);
    c->middle_x = 0.5 * (right + left);
    c->middle_y = 0.5 * (top + bottom);
}

bool camera_make(const scene_camera *from, int width, int height, camera *out, report *r)
{
    double m[16];
    for (int i = 0; i < 16; ++i)
        m[i] = (double)from->to_world[i];

    /* A camera has no size: scale and shear of its node do not count. */
    out->forward = v3_normalize(v3_scale(m4_column(m, 2), -1.0));
    out->right = v3_normalize(v3_reject(m4_column(m, 0), out->forward));
    out->up = v3_cross(out->right, out->forward);
    out->origin = m4_column(m, 3);
    if (!(v3_length(out->up) > 0.5))
        return report_error(r, "camera \"%s\": its node's transform is flat; expected three independent axes",
                            from->name ? from->name : "");

    const bool perspective = from->projection == SCENE_PERSPECTIVE;
    out->projection = from->projection;
    out->width = width;
    out->height = height;
    out->near = (double)from->znear;
    out->far = from->zfar > 0.0F ? (double)from->zfar : (double)INFINITY;
    out->middle_x = out->middle_y = 0.0;
    if (has_window(from)) {
        set_window(out, from->window);
        return true;
    }
    out->half_height = perspective ? tan(0.5 * (double)from->yfov_rad) : fabs((double)from->ymag);
    if (perspective && !(from->aspect > 0.0F)) {
        out->half_width = out->half_height * (double)width / (double)height;
        return true;
    }
    out->half_width = perspective ? out->half_height * (double)from->aspect : fabs((double)from->xmag);
    fit(out, out->half_width / out->half_height);
    return true;
}

/* A step of the direction before it is made unit, to the step of the unit direction. */
static vec3 unit_step(vec3 direction, vec3 step, double length)
{
    return v3_scale(v3_reject(step, direction), 1.0 / length);
}

void camera_ray(const camera *c, double x, double y, trace_ray *ray, differential *d)
{
    const vec3 zero = v3(0.0, 0.0, 0.0);
    const double across = (2.0 * x / (double)c->width - 1.0) * c->half_width + c->middle_x;
    const double upwards = (1.0 - 2.0 * y / (double)c->height) * c->half_height + c->middle_y;
    const vec3 offset = v3_mad(v3_scale(c->right, across), c->up, upwards);
    const vec3 step_x = v3_scale(c->right, 2.0 * c->half_width / (double)c->width);
    const vec3 step_y = v3_scale(c->up, -2.0 * c->half_height / (double)c->height);

    if (c->projection == SCENE_ORTHOGRAPHIC) {
        *ray = (trace_ray){ v3_add(c->origin, offset), c->forward, c->near, c->far, 0U };
        *d = (differential){ step_x, step_y, zero, zero };
        return;
    }
    const vec3 towards = v3_add(c->forward, offset);
    const double length = v3_length(towards);
    const vec3 direction = v3_scale(towards, 1.0 / length);
    *ray = (trace_ray){ c->origin, direction, c->near * length, c->far * length, 0U };
    *d = (differential){ zero, zero, unit_step(direction, step_x, length), unit_step(direction, step_y, length) };
}

double camera_depth(const camera *c, vec3 position)
{
    return v3_dot(v3_sub(position, c->origin), c->forward);
}
