/* The map as a distribution: rows by their share of the light, then columns, then evenly over the texel's solid angle.
 */
#include "preview/environment.h"

#include <stdlib.h>
#include <string.h>

/* ---- directions and texels ---- */

static vec3 to_map(const environment *e, vec3 d)
{
    const double *const m = e->to_map;
    return v3(m[0] * d.x + m[1] * d.y + m[2] * d.z, m[3] * d.x + m[4] * d.y + m[5] * d.z,
              m[6] * d.x + m[7] * d.y + m[8] * d.z);
}

static vec3 to_world(const environment *e, vec3 d)
{
    const double *const m = e->to_map;
    return v3(m[0] * d.x + m[3] * d.y + m[6] * d.z, m[1] * d.x + m[4] * d.y + m[7] * d.z,
              m[2] * d.x + m[5] * d.y + m[8] * d.z);
}

static void place_of(const environment *e, vec3 direction, double *u, double *v)
{
    const vec3 d = to_map(e, direction);
    const double there[3] = { d.x, d.y, d.z };
    environment_map_place(there, u, v);
}

static int clamp_index(double at, int count)
{
    return at >= 0.0 ? (int)fmin(at, count - 1) : 0; /* NaN too */
}

double environment_texel_sr(const environment_map *m, int y)
{
    /* The difference of the cosines at the edges, 2 sin(middle) sin(half), without cancellation at the poles. */
    const double half = 0.5 * PREVIEW_PI / m->height;
    const double rise = 2.0 * sin(PREVIEW_PI * (y + 0.5) / m->height) * sin(half);
    return rise * 2.0 * PREVIEW_PI / m->width;
}

static size_t texel_index(const environment *e, int x, int y)
{
    return (size_t)y * (size_t)e->map->width + (size_t)x;
}

/* ---- light ---- */

void environment_seen(const environment *e, vec3 direction, float rgb[3])
{
    const environment_map *const m = e->map;
    double u, v;
    place_of(e, direction, &u, &v);
    const double x = u * m->width - 0.5, y = fmin(fmax(v * m->height - 0.5, 0.0), m->height - 1.0);
    const double left = floor(x), top = floor(y);
    const float s = (float)(x - left), t = (float)(y - top);
    const int x0 = (clamp_index(left + m->width, 2 * m->width)) % m->width, x1 = (x0 + 1) % m->width;
    const int y0 = clamp_index(top, m->height), y1 = y0 + 1 < m->height ? y0 + 1 : y0;
    const float *const corners[4] = { &m->rgb[3 * texel_index(e, x0, y0)], &m->rgb[3 * texel_index(e, x1, y0)],
                                      &m->rgb[3 * texel_index(e, x0, y1)], &m->rgb[3 * texel_index(e, x1, y1)] };
    for (int c = 0; c < 3; ++c) {
        const float above = (1.0F - s) * corners[0][c] + s * corners[1][c];
        const float below = (1.0F - s) * corners[2][c] + s * corners[3][c];
        rgb[c] = e->scale * ((1.0F - t) * above + t * below);
    }
}

static void describe_texel(const environment *e, int x, int y, environment_light *out)
{
    const size_t i = texel_index(e, x, y);
    const float *const edges = &e->column_edges[(size_t)y * (size_t)(e->map->width + 1)];
    const double share = (e->row_edges[y + 1] - e->row_edges[y]) * (double)(edges[x + 1] - edges[x]);
    const bool sun = !(e->patch_sr[i] > 0.0F);
    for (int c = 0; c < 3; ++c)
        out->rgb[c] = sun ? 0.0F : e->scale * e->map->rgb[3 * i + (size_t)c];
    out->pdf = (float)(share / environment_texel_sr(e->map, y));
    out->solid_angle_sr = e->patch_sr[i] < (float)(4.0 * PREVIEW_PI) ? e->patch_sr[i] : 0.0F;
}

void environment_from(const environment *e, vec3 direction, environment_light *out)
{
    double u, v;
    place_of(e, direction, &u, &v);
    out->wi = direction;
    describe_texel(e, clamp_index(u * e->map->width, e->map->width), clamp_index(v * e->map->height, e->map->height),
                   out);
}

/* ---- sampling ---- */

static int find_row(const environment *e, double u)
{
    int low = 0, high = e->map->height; /* edges[low] <= u < edges[high] */
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (e->row_edges[middle] <= u)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static int find_column(const float *edges, int width, double u)
{
    int low = 0, high = width;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if ((double)edges[middle] <= u)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double between(double u, double low, double high)
{
    return high > low ? (u - low) / (high - low) : 0.5;
}

bool environment_sample(const environment *e, const double u[2], environment_light *out)
{
    const environment_map *const m = e->map;
    if (!(e->row_edges[m->height] > 0.0))
        return false;
    const int y = find_row(e, u[1]);
    const float *const edges = &e->column_edges[(size_t)y * (size_t)(m->width + 1)];
    const int x = find_column(edges, m->width, u[0]);
    const double s = between(u[0], (double)edges[x], (double)edges[x + 1]);
    const double t = between(u[1], e->row_edges[y], e->row_edges[y + 1]);

    const double top = cos(PREVIEW_PI * y / m->height), bottom = cos(PREVIEW_PI * (y + 1) / m->height);
    const double height = top + (bottom - top) * t; /* even in solid angle */
    const double longitude = 2.0 * PREVIEW_PI * ((x + s) / m->width - 0.5);
    const double across = sqrt(fmax(1.0 - height * height, 0.0));
    describe_texel(e, x, y, out);
    out->wi = v3_normalize(to_world(e, v3(across * cos(longitude), height, across * sin(longitude))));
    return out->pdf > 0.0F;
}

/* ---- set-up ---- */

/* Shares of the columns of row y; returns the row's light. */
static double fill_row(environment *e, int y)
{
    const int width = e->map->width;
    float *const edges = &e->column_edges[(size_t)y * (size_t)(width + 1)];
    double sum = 0.0;
    for (int x = 0; x < width; ++x) {
        const size_t i = texel_index(e, x, y);
        sum += e->patch_sr[i] > 0.0F ? environment_level(&e->map->rgb[3 * i]) : 0.0;
    }
    double so_far = 0.0;
    edges[0] = 0.0F;
    for (int x = 0; x < width; ++x) {
        const size_t i = texel_index(e, x, y);
        so_far += e->patch_sr[i] > 0.0F ? environment_level(&e->map->rgb[3 * i]) : 0.0;
        edges[x + 1] = sum > 0.0 ? (float)fmin(so_far / sum, 1.0) : (float)(x + 1) / (float)width;
    }
    edges[width] = 1.0F;
    return sum * environment_texel_sr(e->map, y);
}

static void fill_distribution(environment *e)
{
    const int height = e->map->height;
    double sum = 0.0;
    e->row_edges[0] = 0.0;
    for (int y = 0; y < height; ++y) {
        sum += fill_row(e, y);
        e->row_edges[y + 1] = sum;
    }
    if (!(sum > 0.0))
        return;
    for (int y = 0; y < height; ++y)
        e->row_edges[y + 1] /= sum;
    e->row_edges[height] = 1.0;
}

/* The rotation that undoes the quaternion, which has passed the reader's check of its length. */
static void set_rotation(environment *e, const float q[4])
{
    const double length = sqrt((double)q[0] * (double)q[0] + (double)q[1] * (double)q[1] + (double)q[2] * (double)q[2] +
                               (double)q[3] * (double)q[3]);
    const double x = (double)q[0] / length, y = (double)q[1] / length, z = (double)q[2] / length,
                 w = (double)q[3] / length;
    const double m[9] = { 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w),       2.0 * (x * z - y * w),
                          2.0 * (x * y - z * w),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w),
                          2.0 * (x * z + y * w),       2.0 * (y * z - x * w),       1.0 - 2.0 * (x * x + y * y) };
    memcpy(e->to_map, m, sizeof m);
}

bool environment_make(const preview_environment *from, environment *out, report *r)
{
    const environment_map *const m = from->map;
    const size_t texels = (size_t)m->width * (size_t)m->height;
    *out = (environment){ .map = m, .scale = from->scale };
    set_rotation(out, from->rotation);
    out->patch_sr = malloc(texels * sizeof *out->patch_sr);
    out->row_edges = malloc(((size_t)m->height + 1) * sizeof *out->row_edges);
    out->column_edges = malloc((texels + (size_t)m->height) * sizeof *out->column_edges);
    if (out->patch_sr == NULL || out->row_edges == NULL || out->column_edges == NULL)
        return report_error(r, "no memory for an environment of %d x %d texels", m->width, m->height);
    if (!environment_find_suns(out, r))
        return false;
    environment_find_patches(out);
    fill_distribution(out);
    return true;
}

void environment_free(environment *e)
{
    free(e->patch_sr);
    free(e->row_edges);
    free(e->column_edges);
    *e = (environment){ 0 };
}
