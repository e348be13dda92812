/* What the parts of the study's own machinery know of a run. */
#ifndef STUDY_OUTCOME_H
#define STUDY_OUTCOME_H

#include <stdio.h>

#include "study/study.h"

/* Copies the settings, but not their names. */
void outcome_add_front(study_run *run, const study_dial *dial, const study_setting *settings, int count);

#endif
