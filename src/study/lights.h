/* The parts of the study of lights of real size. */
#ifndef STUDY_LIGHTS_H
#define STUDY_LIGHTS_H

#include "study/study.h"

/* What the truth about a light is known to, relative: below anything that is shown. */
#define LIGHTS_TOLERANCE 1e-9

/* Each goes on from `from` to `to`, shares of the whole study. */
void lights_measure_errors(study_run *run, double from, double to);
void lights_measure_parts(study_run *run, double from, double to);
void lights_measure_replacement(study_run *run, double from, double to);
void lights_measure_convergence(study_run *run, double from, double to);

#endif
