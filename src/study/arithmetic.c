/* The study of arithmetic: the lobe in float against double, and the count with bits that are the same everywhere
 * against fused multiply-add, which is faster and differs from machine to machine. */
#include "study/arithmetic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "study/lobe_truth.h"
#include "study/statistics.h"
#include "study/study.h"

extern const unsigned char arithmetic_gnuplot[];

/* ---- float against double ---- */

enum { ANGLES = 12 };

/* Angles of the light to the ground, from 60 degrees to a ten-thousandth of one. */
static double elevation_of(int i)
{
    return 1.0 * pow(10.0, -0.5 * i);
}

typedef struct lobe_query {
    float alpha, wo[3], wi[3];
    wide truth;
} lobe_query;

static void random_query(uint64_t *random, double elevation, lobe_query *q)
{
    const double phi = random_between(random, 2.5, 3.8), other = random_between(random, 0.05, 1.5);
    q->alpha = (float)random_log_between(random, 1e-2, 1.0);
    const double o[3] = { cos(other), 0.0, sin(other) };
    const double i[3] = { cos(elevation) * cos(phi), cos(elevation) * sin(phi), sin(elevation) };
    for (int k = 0; k < 3; k++) {
        q->wo[k] = (float)o[k];
        q->wi[k] = (float)i[k];
    }
    const wide_lobe l = { 1, (wide)q->alpha, (wide)q->alpha };
    const wide_geometry g = wide_geometry_of(q->wo, q->wi);
    q->truth = wide_reflected(&l, &g);
}

static double in_double(const lobe_query *q)
{
    double wo[3], wi[3];
    for (int k = 0; k < 3; k++) {
        wo[k] = (double)q->wo[k];
        wi[k] = (double)q->wi[k];
    }
    return arithmetic_lobe((double)q->alpha, wo, wi);
}

static double in_float(const glint_material *m, const lobe_query *q)
{
    glint_surface s = glint_material_surface(m);
    s.alpha_x = s.alpha_y = q->alpha;
    float rgb[3];
    glint_eval(m, &s, NULL, q->wo, q->wi, NULL, rgb);
    return (double)rgb[0];
}

/* Worst relative error of each type, over all angles. */
static void compare_types(study_run *run, const glint_material *m, double worst[2])
{
    const int count = study_is_quick(run) ? 20000 : 1000000;
    uint64_t random = 91;
    study_table(run, "arithmetic.csv", "elevation_deg,float_rms,float_worst,double_rms,double_worst,queries");
    for (int a = 0; a < ANGLES && study_goes_on(run, 0.6 * a / ANGLES); a++) {
        double square[2] = { 0.0, 0.0 }, most[2] = { 0.0, 0.0 };
        for (int i = 0; i < count; i++) {
            lobe_query q;
            random_query(&random, elevation_of(a), &q);
            const double error[2] = { (double)relative_error(in_float(m, &q), q.truth),
                                      (double)relative_error(in_double(&q), q.truth) };
            for (int k = 0; k < 2; k++) {
                square[k] += error[k] * error[k];
                most[k] = fmax(most[k], error[k]);
            }
        }
        study_row(run, "%.4g,%.3g,%.3g,%.3g,%.3g,%d", elevation_of(a) * 57.29577951, sqrt(square[0] / count), most[0],
                  sqrt(square[1] / count), most[1], count);
        worst[0] = fmax(worst[0], most[0]);
        worst[1] = fmax(worst[1], most[1]);
    }
    study_end_table(run);
}

/* ---- bits ---- */

enum { POINTS = 4096, ROUNDS = 21 };

typedef struct points_store {
    double u[POINTS], v[POINTS];
    float dudx[POINTS], dudy[POINTS], dvdx[POINTS], dvdy[POINTS], density[POINTS], hx[POINTS], hy[POINTS], cap[POINTS],
        p[POINTS];
    uint32_t seed[POINTS];
    float factor[2][POINTS], facets[POINTS];
} points_store;

static void fill(points_store *s)
{
    uint64_t random = 92;
    for (int i = 0; i < POINTS; i++) {
        const double size = random_log_between(&random, 1e-4, 1e-2), turn = random_between(&random, 0.0, 6.3);
        const double minor = size * random_between(&random, 0.2, 1.0), p = random_log_between(&random, 1e-4, 0.1);
        s->u[i] = random_between(&random, -5.0, 5.0);
        s->v[i] = random_between(&random, -5.0, 5.0);
        s->dudx[i] = (float)(size * cos(turn));
        s->dvdx[i] = (float)(size * sin(turn));
        s->dudy[i] = (float)(-minor * sin(turn));
        s->dvdy[i] = (float)(minor * cos(turn));
        s->density[i] = (float)(random_log_between(&random, 0.01, 1e3) / p / (size * minor));
        s->hx[i] = (float)random_between(&random, -0.5, 0.5);
        s->hy[i] = (float)random_between(&random, -0.5, 0.5);
        s->cap[i] = 1e-4F;
        s->p[i] = (float)p;
        s->seed[i] = (uint32_t)random_bits(&random);
    }
}

typedef struct kernel_race {
    double cost_ns[2], differs, differs_visibly;
} kernel_race;

static void race(points_store *s, counting_kernel *const kernels[2], kernel_race *out)
{
    const counting_points points = { s->u,       s->v,    s->dudx, s->dudy, s->dvdx, s->dvdy,
                                     s->density, s->seed, s->hx,   s->hy,   s->cap,  s->p };
    static double times[2][ROUNDS];
    for (int round = 0; round < ROUNDS; round++)
        for (int k = 0; k < 2; k++) {
            const double start = study_cpu_s();
            kernels[k](&points, POINTS, s->factor[k], s->facets);
            times[k][round] = (study_cpu_s() - start) * 1e9 / POINTS;
        }
    for (int k = 0; k < 2; k++)
        out->cost_ns[k] = study_median(times[k], ROUNDS);
    for (int i = 0; i < POINTS; i++) {
        const float a = s->factor[0][i], b = s->factor[1][i];
        /* Neither is negative or no number, so other bits are another number. */
        out->differs += a < b || b < a ? 1.0 / POINTS : 0.0;
        out->differs_visibly += fabsf(a - b) > 0.01F * fmaxf(a, b) ? 1.0 / POINTS : 0.0;
    }
}

/* False: this machine cannot fuse. */
static bool find_kernels(counting_kernel *kernels[2])
{
    kernels[0] = counting_kernel_1;
    kernels[1] = NULL;
#if defined(ARITHMETIC_FUSED)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        kernels[0] = counting_kernel_8;
        kernels[1] = fused_kernel_8;
    }
#endif
    return kernels[1] != NULL;
}

static void compare_bits(study_run *run)
{
    counting_kernel *kernels[2];
    if (!find_kernels(kernels)) {
        study_note(run, "This machine or this build has no fused multiply-add in eight lanes: left out");
        return;
    }
    points_store *const s = calloc(1, sizeof *s);
    if (!s) {
        report_error(study_report(run), "arithmetic: no memory for points");
        return;
    }
    kernel_race r = { { 0.0 }, 0.0, 0.0 };
    fill(s);
    race(s, kernels, &r);
    free(s);
    study_setting settings[2] = { { "the same bits everywhere", r.cost_ns[0], 0.0, 0.0, false },
                                  { "fused multiply-add", r.cost_ns[1], r.differs_visibly,
                                    sqrt(r.differs_visibly * (1.0 - r.differs_visibly) / POINTS), false } };
    static const study_dial dial = {
        "arithmetic_front.csv",
        "Arithmetic of the count, in eight lanes.",
        "ns a count",
        "cost_ns",
        "share of 4096 counts that differ by more than 1 %",
        "Keep the same bits: what fusing saves is less than a picture that no other machine repeats costs."
    };
    study_front(run, &dial, settings, 2);
    study_note(run,
               "Fused multiply-add takes %.2f of the time; %.1f %% of the counts have other bits, %.2f %% differ by "
               "more than 1 %%",
               r.cost_ns[1] / r.cost_ns[0], 100.0 * r.differs, 100.0 * r.differs_visibly);
    study_check(run, r.differs_visibly < 0.02, "%.2f %% of the counts differ visibly, at most 2 %%",
                100.0 * r.differs_visibly);
}

static void measure(study_run *run)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_SMOOTH;
    glint_material *const m = study_material(run, &o);
    if (!m)
        return;
    double worst[2] = { 0.0, 0.0 };
    compare_types(run, m, worst);
    glint_material_destroy(m);
    compare_bits(run);
    if (!study_goes_on(run, 1.0))
        return;
    /* 64 roundings of float, as tests/stability derives. */
    study_check(run, worst[0] < 64.0 * 0x1p-24, "the lobe in float is within %.1e at every angle, at most 3.8e-6",
                worst[0]);
    study_check(run, worst[1] < worst[0] / 1e6, "in double within %.1e: float is enough for a picture of 8 or 16 bits",
                worst[1]);
}

static const study_figure figures[] = {
    { "arithmetic", "Error of the smooth lobe in float and in double, by the elevation of the light.",
      arithmetic_gnuplot },
    { NULL, NULL, NULL },
};

extern const study arithmetic_study;

const study arithmetic_study = {
    .name = "arithmetic",
    .title = "Arithmetic: float and double, exact bits and fused",
    .truth = "textbook formulas in long double; and the count in one lane",
    .choose = "float, and the same bits everywhere.",
    .share = 0.04,
    .run = measure,
    .figures = figures,
};
