/* The example model against the full sum of Gaussians over its explicitly exported normal map (Xing et al. 2024, Fig. 8
 * and Tables 2 and 3): pictures of both and of their difference, the exported map, memory, baking, error and speed.
 *
 * A picture is a flat piece of surface, its pixels 14 texels wide, whose half vector leans from one side to
 * the other by three times the map's own slope: what a lamp shows of a gently bent sheet.
 */
#include <string.h>

#include "example_picture.h"
#include "study.h"

typedef struct row {
    const char *name;
    glint_example_kind kind;
    uint32_t size;
    int is_scattered;
    double paper_mib, paper_s;
} row;

/* As the paper has them: its Tables 2 and 3. */
static const row rows[] = {
    { "scratches", GLINT_EXAMPLE_SCRATCHES, 32, 1, 85.25, 72.4 },
    { "brushed", GLINT_EXAMPLE_BRUSHED, 32, 0, 21.31, 49.7 },
    { "leather", GLINT_EXAMPLE_LEATHER, 16, 0, 5.32, 6.2 },
    { "structure", GLINT_EXAMPLE_STRUCTURE, 8, 0, 1.31, 2.3 },
    { "isotropic_noise", GLINT_EXAMPLE_ISOTROPIC_NOISE, 16, 1, 5.32, 6.2 },
    { "anisotropic_noise", GLINT_EXAMPLE_ANISOTROPIC_NOISE, 16, 1, 5.32, 6.1 },
};
enum { ROWS = sizeof(rows) / sizeof(rows[0]) };

static glint_example options_of(const row *r)
{
    glint_example o = GLINT_EXAMPLE_INIT;
    o.size = r->size;
    o.sigma_r = 0.02F;
    o.mirror = (uint32_t)r->is_scattered;
    if (r->is_scattered) {
        o.placement = GLINT_EXAMPLE_SCATTERED;
        o.jitter = 1.0F;
        o.scale_variation = 0.2F;
        o.rotation_variation_rad = r->kind == GLINT_EXAMPLE_ANISOTROPIC_NOISE ? 0.2F : 3.1415927F;
    }
    return o;
}

static const char *file_of(const study *s, const row *r, const char *what)
{
    char name[64];
    snprintf(name, sizeof(name), "example_%s_%s.png", r->name, what);
    return study_path(s, name);
}

static void compare_pictures(study *s, const row *r, FILE *table)
{
    const glint_example o = options_of(r);
    bench b;
    const double begin = bench_seconds();
    bench_make(&b, r->kind, &o);
    const double baked_s = bench_seconds() - begin;
    example_picture p;
    example_picture_make(&p, &b, s->is_short ? 24 : 96, s->is_short ? 16 : 64, 4.0);
    const example_difference d = example_picture_compare(&p);
    const double mib = (double)example_bytes(b.material.baked) / 1048576.0;
    fprintf(table, "%s,%u,%s,%.3f,%.2f,%.1f,%.4f,%.1f,%u,%u,%.4f,%.4f,%.1f,%.1f,%.1f\n", r->name, r->size,
            r->is_scattered ? "scattered" : "tiled", mib, r->paper_mib, p.truth_mib, baked_s, r->paper_s,
            (unsigned)p.width, (unsigned)p.height, d.rms, d.worst, 1e3 * p.own_s, 1e3 * p.sum_s, p.sum_s / p.own_s);
    printf(
        "%-18s %3u^2 %-9s  %5.2f MiB (paper %5.2f, exported %6.1f)  baked in %5.1f ms (paper %4.1f s)  rms %4.1f %% of "
        "the mean, worst %4.1f %% of the peak  %8.1f ms, the sum %8.1f ms: %5.1f times\n",
        r->name, r->size, r->is_scattered ? "scattered" : "tiled", mib, r->paper_mib, p.truth_mib, 1e3 * baked_s,
        r->paper_s, 100.0 * d.rms, 100.0 * d.worst, 1e3 * p.own_s, 1e3 * p.sum_s, p.sum_s / p.own_s);
    study_check(s, mib < r->paper_mib, "%s: %g MiB, expected less than the paper's %g", r->name, mib, r->paper_mib);
    study_check(s, d.worst < 0.1, "%s: differs by %g of the peak, expected less than 0.1", r->name, d.worst);
    const int written = example_picture_write(&p, p.sum, file_of(s, r, "sum")) &&
                        example_picture_write(&p, p.own, file_of(s, r, "own")) &&
                        example_picture_write_difference(&p, file_of(s, r, "difference")) &&
                        example_picture_write_map(&p, file_of(s, r, "map"));
    study_check(s, written, "%s: its pictures could not be written", r->name);
    example_picture_free(&p);
    bench_free(&b);
}

/* Footprints from a tenth of a texel to half a map. */
static void compare_footprints(study *s, int is_scattered, FILE *table)
{
    static const double sigmas[] = { 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0 };
    const row r = {
        "", is_scattered ? GLINT_EXAMPLE_SCRATCHES : GLINT_EXAMPLE_ISOTROPIC_NOISE, 32, is_scattered, 0, 0
    };
    const glint_example o = options_of(&r);
    bench b;
    bench_make(&b, r.kind, &o);
    const seed_surface all = seed_race_export(&b);
    fprintf(table,
            "# %s: pixel in texels, seeds under it; anywhere: us, us of the sum, times, times over the pruned sum; "
            "lit: the same; rms and worst of lit\n",
            is_scattered ? "scattered scratches" : "tiled noise");
    for (size_t k = 0; k < sizeof(sigmas) / sizeof(sigmas[0]); k++) {
        const int queries = (s->is_short ? 20 : 400) / (sigmas[k] > 4.0 ? 4 : 1);
        const seed_race dark = seed_race_run(&b, &all, sigmas[k], 0, queries);
        const seed_race lit = seed_race_run(&b, &all, sigmas[k], 1, queries);
        const double texels = sigmas[k] * sqrt(12.0);
        fprintf(table, "%.3f,%.0f,%.3f,%.3f,%.2f,%.2f,%.3f,%.3f,%.2f,%.2f,%.4f,%.4f\n", texels, lit.seeds, dark.own_us,
                dark.sum_us, dark.sum_us / dark.own_us, dark.pruned_us / dark.own_us, lit.own_us, lit.sum_us,
                lit.sum_us / lit.own_us, lit.pruned_us / lit.own_us, lit.rms, lit.worst);
        study_check(s, lit.worst < 0.1, "%s, pixel of %g texels: differs by %g of the peak, expected less than 0.1",
                    is_scattered ? "scattered" : "tiled", texels, lit.worst);
    }
    fprintf(table, "\n\n");
    free(all.seeds);
    bench_free(&b);
}

int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    FILE *table = study_open(&s, "example.csv");
    fprintf(table, "# map,texels,placement,MiB,paper MiB,exported MiB,baked s,paper s,width,height,rms of the mean,"
                   "worst of the peak,ms,ms of the sum,times\n");
    for (int i = 0; i < ROWS; i++)
        compare_pictures(&s, &rows[i], table);
    study_close(table);
    table = study_open(&s, "example_speed.csv");
    for (int is_scattered = 0; is_scattered < 2; is_scattered++)
        compare_footprints(&s, is_scattered, table);
    study_close(table);
    return study_end(&s);
}
