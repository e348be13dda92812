/* A camera that recedes and a light that turns: counting changes from frame to frame no more than the facets themselves
 * do.
 *
 * The measure, for k x k blocks of pixels and a lag of t frames: S(t) = E (B(f + t) - B(f))^2 / (2 Var B), with the
 * variance of explicit's blocks for all, is 0 for a picture that stands still and 1 for frames that know nothing of
 * each other. Popping shows as an S(1) above explicit's, and as a frame that changes more than the others.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "facet_truth.h"
#include "png_file.h"
#include "statistics.h"
#include "study.h"

#define PI 3.14159265358979323846

enum { FRAMES = 120, SIDE = 32, SIZES = 4, LAGS = 6, MODELS = 3 };
static const int LAG[LAGS] = { 1, 2, 4, 8, 16, 32 };

typedef enum motion { RECEDING, TURNING, MOTIONS } motion;
static const char *const MOTION_NAMES[MOTIONS] = { "receding", "turning" };
static const glint_model WHICH[MODELS] = { GLINT_MODEL_EXPLICIT, GLINT_MODEL_COUNTING, GLINT_MODEL_DICTIONARY };

static const glint_light LIGHT = { GLINT_LIGHT_CAP, 0.06F };

/* What one frame sees: the size of a pixel and where the light is. */
typedef struct view {
    double pixel_m;
    float wo[3], wi[3];
    uint32_t seed;
} view;

/* Eight times further away in 120 frames, 2 to 128 facets a pixel; or a light that turns by .6 rad, so that the half
 * vector passes four lit caps one after another. */
static view view_of(motion m, int frame, uint32_t seed)
{
    const double t = (double)frame / (FRAMES - 1);
    view v = { .pixel_m = m == RECEDING ? 1e-3 * pow(8.0, t) : 2e-3, .seed = seed };
    const double o = 0.3, i = m == RECEDING ? 0.25 : 0.6 * t;
    v.wo[0] = (float)sin(o);
    v.wo[2] = (float)cos(o);
    v.wi[0] = (float)-sin(i);
    v.wi[2] = (float)cos(i);
    return v;
}

static void render(const glint_material *m, const view *v, int side, double *pixels)
{
    for (int n = 0; n < side * side; n++) {
        const double x = n % side + 0.5 - 0.5 * side, y = n / side + 0.5 - 0.5 * side;
        const glint_footprint f = {
            0.37 + x * v->pixel_m, 0.61 + y * v->pixel_m, (float)v->pixel_m, 0.0F, 0.0F, (float)v->pixel_m, v->seed
        };
        glint_value value;
        glint_eval_value(m, NULL, &f, v->wo, v->wi, &LIGHT, &value);
        pixels[n] = (double)(value.rgb[0] / value.smooth[0]);
    }
}

static glint_material_options options_of(glint_model model)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model;
    o.surface.alpha_x = o.surface.alpha_y = 0.5F;
    o.surface.facets_per_m2 = 2e6F;
    return o;
}

/* ---- the measure ---- */

/* Variance of the explicit model's blocks in every frame, in closed form: the unit of all changes. */
static void variances_of(motion which, double variance[SIZES][FRAMES])
{
    glint_material_options o = options_of(GLINT_MODEL_EXPLICIT);
    for (int f = 0; f < FRAMES; f++) {
        const view v = view_of(which, f, 0U);
        const facet_moments facet = facet_moments_of(&o, v.wo, v.wi, (double)LIGHT.solid_angle_sr);
        const double cells = v.pixel_m * sqrt((double)o.surface.facets_per_m2), j[4] = { cells, 0.0, 0.0, cells };
        for (int s = 0; s < SIZES; s++)
            variance[s][f] = (facet.square - facet.mean * facet.mean) * facet_overlap(FACET_BOX, 1 << s, j);
    }
}

/* Means of k x k blocks of one frame. */
static void average(const double *pixels, int k, double *blocks)
{
    const int side = SIDE / k;
    memset(blocks, 0, sizeof(*blocks) * (size_t)(side * side));
    for (int n = 0; n < SIDE * SIDE; n++)
        blocks[n / SIDE / k * side + n % SIDE / k] += pixels[n] / (k * k);
}

typedef struct changes {
    moments square[SIZES][LAGS]; /* one value a seed */
    double frame[FRAMES];        /* sum over pixels and seeds, lag 1 */
} changes;

static double (*film_of(const glint_material *m, motion which, uint32_t seed))[SIDE * SIDE]
{
    static double film[FRAMES][SIDE * SIDE];
    for (int f = 0; f < FRAMES; f++) {
        const view v = view_of(which, f, seed);
        render(m, &v, SIDE, film[f]);
    }
    return film;
}

static void add_changes(double (*film)[SIDE * SIDE], double variance[SIZES][FRAMES], changes *c)
{
    static double blocks[FRAMES][SIDE * SIDE];
    for (int s = 0; s < SIZES; s++) {
        const int k = 1 << s, count = SIDE / k * (SIDE / k);
        for (int f = 0; f < FRAMES; f++)
            average(film[f], k, blocks[f]);
        for (int l = 0; l < LAGS; l++) {
            double sum = 0.0;
            for (int f = 0; f + LAG[l] < FRAMES; f++)
                for (int n = 0; n < count; n++) {
                    const double d = blocks[f + LAG[l]][n] - blocks[f][n];
                    const double unit = 0.5 * (variance[s][f] + variance[s][f + LAG[l]]);
                    sum += 0.5 * d * d / unit;
                    if (s == 0 && l == 0)
                        c->frame[f] += d * d / unit;
                }
            moments_add(&c->square[s][l], sum / count / (FRAMES - LAG[l]));
        }
    }
}

/* S(1) of single pixels in the frame that changes most. */
static double busiest(const changes *c, int seeds)
{
    double most = 0.0;
    for (int f = 0; f + 1 < FRAMES; f++)
        most = fmax(most, c->frame[f]);
    return 0.5 * most / ((double)seeds * SIDE * SIDE);
}

static changes changes_of(glint_model model, motion which, int seeds, double variance[SIZES][FRAMES])
{
    const glint_material_options o = options_of(model);
    glint_material *m = material_or_exit(&o);
    changes c = { .frame = { 0.0 } };
    for (int i = 0; i < seeds; i++)
        add_changes(film_of(m, which, (uint32_t)i + 1U), variance, &c);
    glint_material_destroy(m);
    return c;
}

/* Counting may change by no more than the facets do, give or take the 15 % by which its blocks vary more; and while the
 * camera recedes, by what its grids are replaced: all of their facets where the pixel's area doubles, one by one. */
static double replaced(motion which)
{
    return which == RECEDING ? log2(8.0 * 8.0) / (FRAMES - 1) : 0.0;
}

static void check(study *s, motion which, int size, int seeds, const changes *truth, const changes *counting)
{
    const moments *a = &counting->square[size][0], *b = &truth->square[size][0];
    const double noise = hypot(moments_standard_error(a), moments_standard_error(b) * 1.15);
    study_check(s, a->mean < 1.15 * (b->mean + replaced(which)) + 3.0 * noise,
                "%s, k = %d: counting changes by %.3f a frame, explicit by %.3f", MOTION_NAMES[which], 1 << size,
                a->mean, b->mean);
    /* A pop is a frame in which much changes at once. */
    if (size == 0)
        study_check(s, busiest(counting, seeds) < 1.15 * (busiest(truth, seeds) + replaced(which)),
                    "%s: counting's busiest frame changes by %.3f, explicit's by %.3f", MOTION_NAMES[which],
                    busiest(counting, seeds), busiest(truth, seeds));
}

static void measure(study *s, motion which, FILE *table)
{
    static double variance[SIZES][FRAMES];
    variances_of(which, variance);
    const int seeds = s->is_short ? 3 : 32;
    changes c[MODELS];
    for (int i = 0; i < MODELS; i++)
        c[i] = changes_of(WHICH[i], which, seeds, variance);
    for (int i = 0; i < MODELS; i++)
        for (int size = 0; size < SIZES; size++) {
            printf("%-9s %-10s k = %d: S", MOTION_NAMES[which], glint_model_name(WHICH[i]), 1 << size);
            for (int l = 0; l < LAGS; l++) {
                const moments *m = &c[i].square[size][l];
                printf("  %.3f", m->mean);
                fprintf(table, "%s,%s,%d,%d,%.5f,%.5f\n", MOTION_NAMES[which], glint_model_name(WHICH[i]), 1 << size,
                        LAG[l], m->mean, moments_standard_error(m));
            }
            if (size == 0)
                printf("  busiest frame %.3f", busiest(&c[i], seeds));
            printf("\n");
            fprintf(table, "\n\n");
        }
    for (int size = 0; size < SIZES; size++)
        check(s, which, size, seeds, &c[0], &c[1]);
}

/* ---- the pictures ---- */

enum { SHOWN = 8, SHOWN_SIDE = 64, ZOOM = 2, GAP = 4, CELL = SHOWN_SIDE * ZOOM + GAP };

/* Eight frames of each motion, explicit above counting: receding, then turning. */
static void show(const study *s)
{
    enum { WIDTH = SHOWN * CELL + GAP, HEIGHT = 2 * MOTIONS * CELL + GAP };
    static uint8_t sheet[HEIGHT * WIDTH * 3];
    static double pixels[SHOWN_SIDE * SHOWN_SIDE];
    for (int row = 0; row < 2 * MOTIONS; row++) {
        const glint_material_options o = options_of(WHICH[row % 2]);
        glint_material *m = material_or_exit(&o);
        for (int i = 0; i < SHOWN; i++) {
            const view v = view_of((motion)(row / 2), i * (FRAMES - 1) / (SHOWN - 1), 1U);
            render(m, &v, SHOWN_SIDE, pixels);
            for (int n = 0; n < SHOWN_SIDE * ZOOM * SHOWN_SIDE * ZOOM; n++) {
                const int x = n % (SHOWN_SIDE * ZOOM), y = n / (SHOWN_SIDE * ZOOM);
                /* A fifth of the screen's range is the smooth value. */
                const double shown = fmin(1.0, 0.2 * pixels[y / ZOOM * SHOWN_SIDE + x / ZOOM]);
                uint8_t *to = &sheet[3 * ((GAP + row * CELL + y) * WIDTH + GAP + i * CELL + x)];
                to[0] = to[1] = to[2] = (uint8_t)(255.0 * pow(shown, 1.0 / 2.2) + 0.5);
            }
        }
        glint_material_destroy(m);
    }
    const bytes png = png_make(WIDTH, HEIGHT, 8, PNG_RGB, sheet);
    FILE *file = study_open(s, "motion_frames.png");
    if (fwrite(png.data, 1, png.size, file) != png.size)
        perror("motion_frames.png");
    study_close(file);
    free(png.data);
}

int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    FILE *table = study_open(&s, "motion.csv");
    fprintf(table, "motion,model,k,lag,change,sigma\n");
    for (int i = 0; i < MOTIONS; i++)
        measure(&s, (motion)i, table);
    study_close(table);
    show(&s);
    return study_end(&s);
}
