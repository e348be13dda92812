/* Lights of real size. */
#include "naive.h"

#include "light/area.h"
#include "light/ltc.h"
#include "math/real.h"
#define GLINT_LANES 1
#include "math/elementary.h"

#include "lobe_truth.h"

/* A square of directions of this half side, overhead; the sum of its sides' normals by products of whole directions. */
static double square_by_products(double half)
{
    const vec3d corner[4] = { { 0.3 + half, 0.4 + half, 1.0 },
                              { 0.3 - half, 0.4 + half, 1.0 },
                              { 0.3 - half, 0.4 - half, 1.0 },
                              { 0.3 + half, 0.4 - half, 1.0 } };
    vec3d sum = { 0.0, 0.0, 0.0 };
    for (int i = 0; i < 4; i++)
        sum = vec3d_mad(sum, vec3d_cross(vec3d_normalize(corner[i]), vec3d_normalize(corner[(i + 1) % 4])), 0.5);
    return vec3d_length(sum);
}

static void tiny_square(void)
{
    const double half = 1e-8;
    area_light l;
    const vec3d corner[4] = { { 0.3 + half, 0.4 + half, 1.0 },
                              { 0.3 - half, 0.4 + half, 1.0 },
                              { 0.3 - half, 0.4 - half, 1.0 },
                              { 0.3 + half, 0.4 - half, 1.0 } };
    area_make_polygon(&l, corner, 4, 1);
    area_measure(&l);
    /* Flat as far as double can tell: its area by cos / distance^2. */
    const wide distance2 = 1.25L;
    naive_print(&(naive_row){ "solid angle of a square of 2·10⁻⁸ radians, sr", "Lambert's sum of a x b, in double",
                              square_by_products(half), 4.0L * (wide)half * (wide)half / (distance2 * sqrtl(distance2)),
                              vec3d_length(l.moment), "a x (b - a)",
                              "double roundings of the outline: 10⁻⁸ of this one", "area_precision" });
}

static void short_side(void)
{
    const float a[3] = { 0.6F, 0.0F, 0.8F }, x = 2e-5F;
    const float b[3] = { 0.6F * cosf(x), 0.6F * sinf(x), 0.8F };
    const float dot = f(f(a[0] * b[0]) + f(a[1] * b[1]) + f(a[2] * b[2]));
    const wide exact = 0.6L * (wide)x;
    const vec3d p = vec3d_from(a), q = vec3d_from(b);
    naive_print(&(naive_row){ "angle of a light's side of 1.2·10⁻⁵ radians", "acos(a·b)", (double)acosf(dot), exact,
                              real_atan2(vec3d_length(vec3d_cross(p, vec3d_sub(q, p))), vec3d_dot(p, q)),
                              "atan2 of the length of a x (b - a) and a·b, in double", "16 double roundings",
                              "area_precision" });
}

static void tiny_sun(void)
{
    const float solid_angle = 1e-9F, cosine = f(1.0F - f(solid_angle / 6.28318531F));
    const double versine = (double)solid_angle / (2.0 * REAL_PI);
    area_light l;
    area_make_round(&l, (vec3d){ 0.0, 0.0, 1.0 }, sqrt(versine * (2.0 - versine)), 1.0 - versine);
    area_measure(&l);
    const wide v = (wide)solid_angle / (2.0L * WIDE_PI);
    naive_print(&(naive_row){ "form factor of a sun of 10⁻⁹ sr overhead, times π", "π sin² with cos = 1 - Ω / 2π",
                              (double)(MATH_PI * f(1.0F - cosine * cosine)), WIDE_PI * v * (2.0L - v), l.moment.z,
                              "sin² = v (2 - v), v = Ω / 2π, in double", "480 double roundings", "area_precision" });
}

static void long_ellipse(void)
{
    /* Half axes 1e-2 and 1e-9 radians, turned by a third of a right angle. */
    const double a = 1e-2, b = 1e-9, c = 0.8660254037844387, s = 0.5;
    const double uu = a * a * c * c + b * b * s * s, vv = a * a * s * s + b * b * c * c, uv = (a * a - b * b) * c * s;
    const double sum = 0.5 * (uu + vv), root = sqrt(0.25 * (uu - vv) * (uu - vv) + uv * uv);
    area_light l;
    area_make_ellipse(&l, (vec3d){ 0.0, 0.0, 1.0 }, (vec3d){ a * c, a * s, 0.0 }, (vec3d){ -b * s, b * c, 0.0 }, 1);
    area_measure(&l);
    naive_print(&(naive_row){
        "width over length of an ellipse of 10⁻² by 10⁻⁹ radians", "smaller eigenvalue: trace / 2 - √…, in double",
        sqrt(fmax(sum - root, 0.0) / (sum + root)), (wide)b / (wide)a, l.kind == AREA_CONIC ? l.cone.b / l.cone.a : 0.0,
        "determinant as squares of areas, over the larger eigenvalue", "480 double roundings, and (4·2⁻⁵³ / b)²",
        "area_precision" });
}

/* What the library makes of a rectangle: its integral of the cosine. */
static double rectangle_cosine(vec3d center, vec3d half_x, vec3d half_y)
{
    area_light l;
    area_make_rectangle(&l, center, half_x, half_y, 1);
    return l.kind != AREA_NOTHING && area_measure(&l) ? l.moment.z : 0.0;
}

/* Lambert's formula as it is printed, in float: corners made unit, angles by acos. sum: of angle times normal, half. */
static void lambert(const float corner[4][3], float sum[3])
{
    float unit[4][3];
    for (int i = 0; i < 4; i++) {
        const float length =
            sqrtf(f(corner[i][0] * corner[i][0] + corner[i][1] * corner[i][1] + corner[i][2] * corner[i][2]));
        for (int k = 0; k < 3; k++)
            unit[i][k] = f(corner[i][k] / length);
    }
    sum[0] = sum[1] = sum[2] = 0.0F;
    for (int i = 0; i < 4; i++) {
        const float *const a = unit[i], *const b = unit[(i + 1) % 4];
        const float n[3] = { f(a[1] * b[2] - a[2] * b[1]), f(a[2] * b[0] - a[0] * b[2]), f(a[0] * b[1] - a[1] * b[0]) };
        const float length = sqrtf(f(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
        const float angle = acosf(f(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]));
        for (int k = 0; k < 3; k++)
            sum[k] += 0.5F * angle * n[k] / length;
    }
}

static void edge_on(void)
{
    /* In a plane through the point: one half axis is half of the way to its middle, in floats exactly. */
    const float c[3] = { 0.3F, 0.4F, 0.7F }, y[3] = { 0.1F, -0.2F, 0.3F };
    const float n[3] = { f(f(0.5F * c[1] * y[2]) - f(0.5F * c[2] * y[1])),
                         f(f(0.5F * c[2] * y[0]) - f(0.5F * c[0] * y[2])),
                         f(f(0.5F * c[0] * y[1]) - f(0.5F * c[1] * y[0])) };
    const float distance2 = f(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    const float facing = fabsf(f(f(n[0] * c[0]) + f(n[1] * c[1])) + f(n[2] * c[2]));
    const vec3d center = vec3d_from(c);
    naive_print(&(naive_row){ "solid angle of a panel seen exactly edge-on, sr", "A n·d / d³",
                              (double)(4.0F * facing / f(distance2 * sqrtf(distance2))), 0.0L,
                              rectangle_cosine(center, vec3d_scale(center, 0.5), vec3d_from(y)),
                              "none where the plane passes within 10⁻⁹ of its size", "exact", "area_edges" });
}

static void below_the_floor(void)
{
    static const float corner[4][3] = {
        { 1.3F, 0.3F, -1.0F }, { 0.7F, 0.3F, -1.0F }, { 0.7F, -0.3F, -1.0F }, { 1.3F, -0.3F, -1.0F }
    };
    float sum[3];
    lambert(corner, sum);
    naive_print(
        &(naive_row){ "form factor of a square below the floor, times π", "Lambert's sum", (double)-fabsf(sum[2]), 0.0L,
                      rectangle_cosine((vec3d){ 1.0, 0.0, -1.0 }, (vec3d){ 0.3, 0.0, 0.0 }, (vec3d){ 0.0, 0.3, 0.0 }),
                      "cut at the horizon first", "exact", "area_edges" });
}

static void astride_the_horizon(void)
{
    static const float corner[4][3] = {
        { 1.0F, 0.5F, 0.5F }, { 1.0F, -0.5F, 0.5F }, { 1.0F, -0.5F, -0.5F }, { 1.0F, 0.5F, -0.5F }
    };
    float sum[3];
    lambert(corner, sum);
    /* Both halves of what stands on the floor, from its foot. */
    const wide h = sqrtl(1.25L), upper = atanl(0.5L) - atanl(0.5L / h) / h;
    naive_print(&(naive_row){
        "form factor of a square that is half below the floor, times π", "Lambert's sum", (double)sum[2], upper,
        rectangle_cosine((vec3d){ 1.0, 0.0, 0.0 }, (vec3d){ 0.0, 0.5, 0.0 }, (vec3d){ 0.0, 0.0, 0.5 }),
        "cut at the horizon first", "96 double roundings of the outline", "area_precision" });
}

static void on_the_point(void)
{
    static const float corner[4][3] = {
        { 0.0F, 0.0F, 0.0F }, { 0.6F, 0.0F, 0.0F }, { 0.6F, 0.0F, 0.6F }, { 0.0F, 0.0F, 0.6F }
    };
    float sum[3];
    lambert(corner, sum);
    naive_print(&(naive_row){
        "form factor of a wall with a corner in the point, times π", "Lambert's sum", (double)sum[2], 0.0L,
        rectangle_cosine((vec3d){ 0.3, 0.0, 0.3 }, (vec3d){ 0.3, 0.0, 0.0 }, (vec3d){ 0.0, 0.0, 0.3 }),
        "edge-on; a corner without a direction is left out", "exact", "area_edges" });
}

static void no_area(void)
{
    static const float corner[4][3] = {
        { 0.3F, 0.2F, 1.0F }, { 0.3F, -0.2F, 1.0F }, { 0.3F, -0.2F, 1.0F }, { 0.3F, 0.2F, 1.0F }
    };
    float sum[3];
    lambert(corner, sum);
    naive_print(
        &(naive_row){ "form factor of a line, times π", "Lambert's sum", (double)sum[2], 0.0L,
                      rectangle_cosine((vec3d){ 0.3, 0.0, 1.0 }, (vec3d){ 0.0, 0.2, 0.0 }, (vec3d){ 0.0, 0.0, 0.0 }),
                      "no light without an area", "exact", "area_edges" });
}

/* Facets whose half vector mirrors the normal somewhere above the horizon: those within 45 degrees of it. */
static wide facets_within_45_degrees(wide alpha)
{
    enum { STEPS = 200000 };
    const wide_lobe l = { 1, alpha, alpha };
    wide sum = 0.0L;
    for (int i = 0; i < STEPS; i++) {
        const wide theta = 0.25L * WIDE_PI * (i + 0.5L) / STEPS, h[3] = { sinl(theta), 0.0L, cosl(theta) };
        sum += wide_density(&l, h) * sinl(theta);
    }
    return sum * 2.0L * WIDE_PI * (0.25L * WIDE_PI / STEPS) / wide_total_area(1, alpha);
}

static void all_around(void)
{
    const float alpha = 0.1F, whole = 6.28318531F;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.surface.alpha_x = o.surface.alpha_y = alpha;
    o.area_light_method = GLINT_AREA_LIGHT_EXACT;
    glint_material *const m = material_or_exit(&o);
    const glint_area_light sky = { .kind = GLINT_AREA_SUN, .solid_angle_sr = whole, .center = { 0.0F, 0.0F, 1.0F } };
    const glint_footprint at = { .dudx = 1e-3F, .dvdy = 1e-3F };
    const float wo[3] = { 0.0F, 0.0F, 1.0F };
    glint_value v;
    glint_eval_area(m, NULL, &at, wo, &sky, &v);
    glint_material_destroy(m);
    const float total = (float)wide_total_area(1, (wide)alpha);
    naive_print(&(naive_row){ "chance that the whole sky lights a facet, from above, α = .1", "D Ω / (4 h·wi D_H)",
                              (double)(whole / (MATH_PI * alpha * alpha) / f(4.0F * total)),
                              facets_within_45_degrees((wide)alpha), (double)v.lit_probability,
                              "D integrated over the half vectors of the light", "1 %", "area_edges" });
}

/* The cosine's integral over a light whose corners a narrow lobe's matrix has moved. */
static void moved_light(void)
{
    const double half = 2e-5;
    const vec3d center = { 0.3, 0.4, 1.0 };
    const ltc lobe = ltc_find_base(NDF_GGX, 0.25, (vec3d){ 0.6, 0.0, 0.8 });
    static const double turn[4][2] = { { 1, 1 }, { -1, 1 }, { -1, -1 }, { 1, -1 } };
    float corner[4][3], sum[3];
    wide unit[4][3], share = 0.0L;
    for (int i = 0; i < 4; i++) {
        const vec3d from = { center.x + half * turn[i][0], center.y + half * turn[i][1], center.z };
        const vec3d at = ltc_transform(&lobe, from);
        const wide length = sqrtl((wide)at.x * (wide)at.x + (wide)at.y * (wide)at.y + (wide)at.z * (wide)at.z);
        const double of[3] = { at.x, at.y, at.z };
        for (int k = 0; k < 3; k++) {
            corner[i][k] = (float)of[k];
            unit[i][k] = (wide)of[k] / length;
        }
    }
    lambert(corner, sum);
    for (int i = 0; i < 4; i++) {
        const wide *const a = unit[i], *const b = unit[(i + 1) % 4];
        /* The angle over its sine is 1 to the square of the angle. */
        share += 0.5L * (a[0] * (b[1] - a[1]) - a[1] * (b[0] - a[0])) / WIDE_PI;
    }
    area_light l;
    ltc_light moved;
    area_make_rectangle(&l, center, (vec3d){ half, 0.0, 0.0 }, (vec3d){ 0.0, half, 0.0 }, 1);
    ltc_move_base(&lobe, &l, &moved);
    naive_print(&(naive_row){ "share of a lobe of α = .25 that a square of 4·10⁻⁵ radians takes in",
                              "Lambert's sum over moved corners, in float", (double)fabsf(sum[2] / MATH_PI),
                              fabsl(share), moved.share, "corners moved in double, a x (b - a)",
                              "3·10⁻⁹, and double roundings of the outline", "ltc_precision" });
}

void naive_lights(void)
{
    tiny_square();
    short_side();
    tiny_sun();
    long_ellipse();
    edge_on();
    below_the_floor();
    astride_the_horizon();
    on_the_point();
    no_area();
    all_around();
    moved_light();
}
