/* Every study there is: one row each. */
#include "study/study.h"

extern const study law_study, lights_study, integrals_study, look_ups_study, models_study, images_study,
    arithmetic_study, memory_study;

const study *const studies[STUDY_COUNT] = {
    [STUDY_LAW] = &law_study,
    [STUDY_LIGHTS] = &lights_study,
    [STUDY_INTEGRALS] = &integrals_study,
    [STUDY_LOOK_UPS] = &look_ups_study,
    [STUDY_MODELS] = &models_study,
    [STUDY_IMAGES] = &images_study,
    [STUDY_ARITHMETIC] = &arithmetic_study,
    [STUDY_MEMORY] = &memory_study,
};
