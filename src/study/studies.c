/* Every study there is: one row each. */
#include "study/study.h"

extern const study lights_study;

const study *const studies[STUDY_COUNT] = {
    [STUDY_LIGHTS] = &lights_study,
};
