/* What machine a study ran on, as far as it says so itself. */
#ifndef STUDY_MACHINE_H
#define STUDY_MACHINE_H

#include <stddef.h>

/* "2 processors, AMD EPYC ...". */
void machine_describe(char *text, size_t size);

#endif
