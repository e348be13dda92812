/* How few points of a plain light know its integral (docs/lights.md): the rules of light/cubature.h beside 4096 points,
 * over how much the lobe bends over the light, as model/area_plain.h has it. Its limits are where these curves rise.
 *
 * Of a simple pole at the distance d from a light of half the width h, Gauss's n nodes leave r^-2n, with r = d/h +
 * sqrt(1 + (d/h)^2). Poles of densities are double, which is the derivative by d and at most 2n + 1 times as much;
 * there are two dimensions; and the area of a bent square takes one degree: 99 of 100 lights have to be within 2 (2n +
 * 1) r^-2n at the limit of each rule, polygons within 2 (2n + 1) r^(1-2n). Most stay far below it, for the density is
 * but one of three reasons to bend, and rarely the nearest. So 95 of 100 have to be within a thousandth, a third of
 * what 95 of 100 lights of all kinds were within before there was this rule (docs/lights.md).
 */
#include <math.h>
#include <stdlib.h>

#define GLINT_LANES 1
#include "area_cases.h"
#include "model/area_polygon.h"
#include "study.h"

enum { SQUARE, DISK, POLYGON, SHAPES };
static const char *const shape_name[SHAPES] = { "rectangle", "disk", "polygon" };
static const double limit[CUBATURE_LEVELS] = { (double)PLAIN_COARSE, (double)PLAIN_MIDDLE, (double)PLAIN_FINE,
                                               (double)PLAIN_FINEST };
static const int nodes[CUBATURE_LEVELS] = { 3, 4, 6, 8 }; /* of Gauss's rule of this degree */
static const int points_of[CUBATURE_LEVELS] = { 8, 16, 36, 64 };

/* A light as the sums see it. */
typedef struct subject {
    area_lobe lobe;
    int shape, quad_count;
    plain_light light;
    plain_quad quad[PLAIN_QUADS];
    double bend;
} subject;

static vfloat3 from(const float v[3])
{
    return (vfloat3){ v[0], v[1], v[2] };
}

static area_lobe lobe_of(const area_case *c)
{
    const ndf_kind kind = c->lobe.is_beckmann ? NDF_BECKMANN : NDF_GGX;
    const vfloat3 wo = from(c->wo);
    const float x = (float)c->lobe.alpha_x, y = (float)c->lobe.alpha_y;
    return area_lobe_of(kind == NDF_GGX, 1, wo, wo.z + ndf_masked_of(kind, x, y, wo), x, y);
}

static int take_round_or_square(const area_case *c, subject *s)
{
    const glint_area_light *l = &c->light;
    const plain_query q = { .lobe = { .wo = from(c->wo) },
                            .kind = (int)l->kind,
                            .two_sided = 1,
                            .center = from(l->center),
                            .half_x = from(l->half_x),
                            .half_y = from(l->half_y),
                            .size = l->kind == GLINT_AREA_SPHERE ? l->radius : l->solid_angle_sr };
    const plain_limits most = plain_limits_fast();
    s->light = plain_light_of(&s->lobe, &q, &most);
    s->shape = l->kind == GLINT_AREA_RECTANGLE ? SQUARE : DISK;
    const plain_light *p = &s->light;
    const float u2 = dot_3(p->u, p->u), v2 = dot_3(p->v, p->v);
    const plain_extent extent = plain_extent_of(p, -(s->shape == SQUARE));
    s->bend = (double)plain_bend(&s->lobe, p->middle, sqrtf(fmaxf(u2, v2)), &extent);
    return u2 > 0.0F && p->middle.z > extent.height;
}

/* From the first corner or from the middle. */
static int take_polygon(const area_case *c, int from_middle, subject *s)
{
    const int count = (int)c->light.corner_count;
    plain_corners corners = { .most = count + (count & 1), .count = count };
    for (int i = 0; i < corners.most; i++)
        corners.at[i] = from(c->light.corners[i < count ? i : 0]);
    const plain_shape shape = plain_shape_of(&corners);
    const int in_middle = from_middle && count > 4;
    s->shape = POLYGON;
    s->quad_count = plain_quads_of(&corners, &shape, shape.usable, -in_middle, s->quad);
    s->bend = (double)plain_bend(&s->lobe, shape.middle, (in_middle ? plain_slim : plain_wide)(&shape), &shape.extent);
    return shape.usable && shape.middle.z > shape.extent.height;
}

/* 0: it has no points, for it touches the horizon. */
static int take(const area_case *c, int from_middle, subject *s)
{
    s->lobe = lobe_of(c);
    return c->light.kind == GLINT_AREA_POLYGON ? take_polygon(c, from_middle, s) : take_round_or_square(c, s);
}

/* Reflected light, and lit facets. */
typedef struct sums {
    double reflected, facets;
} sums;

static void add_point(const subject *s, double x, double y, double weight, sums *sum)
{
    plain_sums terms;
    const int count = s->shape == POLYGON ? s->quad_count : 1;
    for (int k = 0; k < count; k++) {
        if (s->shape == POLYGON)
            plain_quad_terms_at(&s->lobe, &s->quad[k], (float)x, (float)y, 1.0F, 0, &terms);
        else
            plain_terms_at(&s->lobe, &s->light, (float)x, (float)y, 1.0F, 0, &terms);
        sum->reflected += weight * (double)terms.of.reflected;
        sum->facets += weight * (double)terms.of.facets;
    }
}

static sums sums_by_rule(const subject *s, int level)
{
    const cubature *rule = &cubatures[s->shape == DISK ? CUBATURE_DISK : CUBATURE_SQUARE][level];
    sums sum = { 0.0, 0.0 };
    for (int i = 0; i < rule->row_count; i++)
        for (int k = 0; k < CUBATURE_ROW; k++)
            add_point(s, (double)rule->row[i][0][k], (double)rule->row[i][1][k], (double)rule->row[i][2][k], &sum);
    return sum;
}

/* Gauss's eight nodes in each of eight parts of [-1, 1], and their weights. */
static void fine_nodes(double at[64], double weight[64])
{
    const float(*const row)[CUBATURE_ROW] = cubatures[CUBATURE_SQUARE][CUBATURE_FINEST].row[0];
    double all = 0.0;
    for (int k = 0; k < 8; k++)
        all += (double)row[2][k];
    for (int part = 0; part < 8; part++)
        for (int k = 0; k < 8; k++) {
            at[8 * part + k] = ((double)row[0][k] + 2 * part - 7) / 8.0;
            weight[8 * part + k] = (double)row[2][k] / all / 8.0;
        }
}

static sums sums_of_many(const subject *s)
{
    double at[64], weight[64];
    sums sum = { 0.0, 0.0 };
    fine_nodes(at, weight);
    for (int i = 0; i < 64; i++)
        for (int j = 0; j < 64; j++) {
            /* Even in the square of the radius, and around. */
            const double r = sqrt(0.5 + 0.5 * at[i]), turn = 2.0 * AREA_PI * j / 64.0;
            if (s->shape == DISK)
                add_point(s, r * cos(turn), r * sin(turn), weight[i] / 64.0, &sum);
            else
                add_point(s, at[i], at[j], weight[i] * weight[j], &sum);
        }
    return sum;
}

/* ---- what comes out ---- */

/* Errors of lights that a rule is only just good for. */
#define NEAR_LIMIT 0.75
typedef struct crowd {
    double *error;
    int count;
} crowd;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void measure(const subject *s, FILE *table, crowd crowds[SHAPES][CUBATURE_LEVELS])
{
    const sums truth = sums_of_many(s);
    if (!(truth.reflected > 1e-12) || !(truth.facets > 1e-12))
        return;
    fprintf(table, "%s,%.4g", shape_name[s->shape], s->bend);
    for (int level = 0; level < CUBATURE_LEVELS; level++) {
        const sums found = sums_by_rule(s, level);
        const double error =
            fmax(fabs(found.reflected / truth.reflected - 1.0), fabs(found.facets / truth.facets - 1.0));
        crowd *c = &crowds[s->shape][level];
        fprintf(table, ",%.3e", error);
        if (s->bend < limit[level] && s->bend >= NEAR_LIMIT * limit[level])
            c->error[c->count++] = error;
    }
    fprintf(table, "\n");
}

static void judge(study *all, int shape, int level, crowd *c)
{
    if (c->count < 30)
        return;
    qsort(c->error, (size_t)c->count, sizeof(double), compare);
    const double d = 1.0 / limit[level], r = d + sqrt(1.0 + d * d), n = nodes[level];
    const double most = 2.0 * (2.0 * n + 1.0) * pow(r, (shape == POLYGON) - 2.0 * n);
    const double of_95 = c->error[c->count * 95 / 100], of_99 = c->error[c->count * 99 / 100];
    printf(
        "%s, %d points, bent by %.2f to %.2f: %d lights within %.5f in the median, %.5f for 95 %%, %.5f for 99 %% (at "
        "most %.5f), %.5f at worst\n",
        shape_name[shape], points_of[level], NEAR_LIMIT * limit[level], limit[level], c->count, c->error[c->count / 2],
        of_95, of_99, most, c->error[c->count - 1]);
    study_check(all, of_99 <= most, "%s, level %d: 99 %% of %d lights within %.5f, expected %.5f", shape_name[shape],
                level, c->count, of_99, most);
    study_check(all, of_95 <= 1e-3, "%s, level %d: 95 %% of %d lights within %.5f, expected .001", shape_name[shape],
                level, c->count, of_95);
}

int main(int argc, char **argv)
{
    study all = study_start(argc, argv);
    const int count = all.is_short ? 12000 : 120000;
    crowd crowds[SHAPES][CUBATURE_LEVELS];
    double *const errors = malloc((size_t)count * SHAPES * CUBATURE_LEVELS * sizeof(double));
    if (!errors)
        return 1;
    for (int k = 0; k < SHAPES * CUBATURE_LEVELS; k++)
        crowds[k / CUBATURE_LEVELS][k % CUBATURE_LEVELS] = (crowd){ errors + (size_t)k * (size_t)count, 0 };
    FILE *table = study_open(&all, "plain_lights.csv");
    fprintf(table, "shape,bend,of_8,of_16,of_36,of_64\n");
    uint64_t random = 91;
    for (int i = 0; i < count; i++) {
        const area_case c = area_case_of(&random, i % 2);
        subject s;
        if (take(&c, i % 4 > 1, &s) && s.bend > 0.1 && s.bend < 5.0)
            measure(&s, table, crowds);
    }
    study_close(table);
    for (int k = 0; k < SHAPES * CUBATURE_LEVELS; k++)
        judge(&all, k / CUBATURE_LEVELS, k % CUBATURE_LEVELS, &crowds[k / CUBATURE_LEVELS][k % CUBATURE_LEVELS]);
    free(errors);
    return study_end(&all);
}
