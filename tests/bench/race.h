/* Times several ways of doing the same work against each other, in one program.
 *
 * A machine that others use makes every time wrong, but all of them alike: so the contestants run in turn, a few
 * milliseconds each, and what counts is the quotient of two times of one round. Its median and quartiles over the
 * rounds are what may be quoted.
 */
#ifndef BENCH_RACE_H
#define BENCH_RACE_H

#include <stddef.h>
#include <stdio.h>

typedef struct racer {
    const char *name;
    void (*run)(void *user); /* the whole work once, 0.2 to 20 ms */
    void *user;
} racer;

typedef struct race_result {
    double least_ns, median_ns;             /* per unit of work */
    double faster, faster_low, faster_high; /* time of the first racer over this one's: median and quartiles */
} race_result;

/* units: how much work one run does. Every racer runs once before it counts. */
void race(const racer *racers, size_t count, double units, int rounds, race_result *result);

/* A table for people; title names the work. */
void race_print(const char *title, const racer *racers, size_t count, const race_result *result);
/* The same as one member of a JSON object. */
void race_write(FILE *json, const char *title, const racer *racers, size_t count, const race_result *result);

/* Seconds of this thread's own time on a processor. */
double race_now(void);
/* Of all threads of this process. */
double race_now_all(void);

#endif
