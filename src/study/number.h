/* Numbers as people read them in a report: as many digits as their error leaves, powers of ten where they are small,
 * groups of three where they are large. HTML in UTF-8. */
#ifndef STUDY_NUMBER_H
#define STUDY_NUMBER_H

#include <stddef.h>

/* "0.071 ± 0.011", "(6.2 ± 1.2) · 10<sup>−5</sup>". Without a bar (0) three digits: "0.0281". */
void number_measured(char *text, size_t size, double value, double bar);
/* "93.4", "630", "10 800": three digits, and all of a whole number below 10^5. */
void number_rounded(char *text, size_t size, double value);
/* "0.8 s", "42 s", "2 min 40 s", "1 h 5 min". */
void number_duration(char *text, size_t size, double seconds);

#endif
