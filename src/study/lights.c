/* The study of lights of real size: where the fast integral is off and by how much, parts of a light against the whole
 * (Appendix C and Fig. 9 of Kneiphof and Klein 2024), integrals replaced one by one (Fig. 7), and how counts converge
 * to the smooth surface (Fig. 10). */
#include "study/lights.h"

extern const unsigned char lights_error_gnuplot[], lights_parts_gnuplot[], lights_replaced_gnuplot[],
    lights_convergence_gnuplot[];

static void measure(study_run *run)
{
    lights_measure_errors(run, 0.0, 0.8);
    lights_measure_parts(run, 0.8, 0.9);
    lights_measure_replacement(run, 0.9, 0.91);
    lights_measure_convergence(run, 0.91, 1.0);
}

static const study_figure figures[] = {
    { "lights_error",
      "Error of the fast integral, one point a random light; and the share of lights that each integral is further off "
      "for",
      lights_error_gnuplot },
    { "lights_parts",
      "The parts of a rectangle against the true whole: what the integrals are off by, and no more for being cut",
      lights_parts_gnuplot },
    { "lights_replaced",
      "Along the floor in front of a panel: the radiance, and what a single glint sends, over what they are in truth",
      lights_replaced_gnuplot },
    { "lights_convergence",
      "The deviation of a pixel falls with the root of the number of facets: points are measured, lines the binomial "
      "law",
      lights_convergence_gnuplot },
    { NULL, NULL, NULL },
};

extern const study lights_study;

const study lights_study = {
    .name = "lights",
    .title = "Lights of real size: where the fast integral is off",
    .truth =
        "adaptive quadrature over directions, in double, written without the library, with an error of its own; for "
        "counts the binomial law",
    .choose = "the fast integral for pictures; the exact one where all of a light must add up to a few thousandths.",
    .share = 0.01,
    .run = measure,
    .figures = figures,
};
