/* glTF cameras look along -z with y up; rays start at the near plane's side of the lens and carry pixel steps. */
#define WIDE_LANES 1
#include "preview/camera_batch.h"
#include "preview/camera_lanes.h"

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

static vec3 vector_of(wide3 a)
{
    return v3(a.x, a.y, a.z);
}

void camera_ray(const camera *c, double x, double y, trace_ray *ray, differential *d)
{
    wide_ray r;
    camera_ray_wide(c, x, y, &r);
    *ray = (trace_ray){ vector_of(r.origin), vector_of(r.direction), r.near, r.far, 0U };
    *d = (differential){ vector_of(r.origin_step[0]), vector_of(r.origin_step[1]), vector_of(r.direction_step[0]),
                         vector_of(r.direction_step[1]) };
}

static vec3 take(const double from[3][CAMERA_BATCH], int i)
{
    return v3(from[0][i], from[1][i], from[2][i]);
}

void camera_batch_take(const camera_batch *b, int i, trace_ray *ray, differential *d)
{
    *ray = (trace_ray){ take(b->origin, i), take(b->direction, i), b->near[i], b->far[i], 0U };
    d->origin_dx = take(b->origin_step[0], i);
    d->origin_dy = take(b->origin_step[1], i);
    d->direction_dx = take(b->direction_step[0], i);
    d->direction_dy = take(b->direction_step[1], i);
}

double camera_depth(const camera *c, vec3 position)
{
    return v3_dot(v3_sub(position, c->origin), c->forward);
}
