/* One size of a task that grows: prepared apart, then done once. */
#ifndef BENCH_GROWTH_CASES_H
#define BENCH_GROWTH_CASES_H

#include <stdbool.h>

enum { GROWTH_MOST_SIZES = 16, GROWTH_MOST_SMALL = 4 };

typedef struct growth_case {
    const char *name;                /* of the columns and of the plot */
    const char *size;                /* what grows */
    double sizes[GROWTH_MOST_SIZES]; /* 0 behind the last */
    double small[GROWTH_MOST_SMALL]; /* for counting instructions; none where they need no count */
    bool is_flat;                    /* more of it is no more work */
    /* What is done before the clock runs; run then does the work, once. They may leave memory to the end of the
     * process, of which each case has its own. */
    void (*prepare)(double size);
    void (*run)(void);
} growth_case;

extern const growth_case growth_cases[];
extern const int growth_case_count;

/* run, under a name that callgrind can be told. */
void growth_run(const growth_case *c);
/* Removes what a case left in /tmp. */
void growth_clean(void);

/* Of the last run of triangles: seconds of reading, of Embree's build, of the whole set-up. */
typedef struct growth_load {
    double read_s, trace_s, all_s;
} growth_load;
extern growth_load growth_loaded;

#endif
