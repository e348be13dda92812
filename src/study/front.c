/* Dials: settings by what they cost and how far off they are, and those of them that no other beats in both. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "study/outcome.h"

double study_cpu_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void study_sort(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, by_value);
}

double study_median(double *values, int count)
{
    study_sort(values, count);
    return values[count / 2];
}

static int by_cost(const void *a, const void *b)
{
    const study_setting *const x = a, *const y = b;
    const int cost = (x->cost > y->cost) - (x->cost < y->cost);
    return cost != 0 ? cost : (x->error > y->error) - (x->error < y->error);
}

/* Errors within a thousandth of each other are the same: what costs less stands for them. */
static void mark_front(study_setting *settings, int count)
{
    double nearest = (double)INFINITY;
    for (int i = 0; i < count; ++i) {
        settings[i].on_front = settings[i].error < 0.999 * nearest;
        nearest = fmin(nearest, settings[i].error);
    }
}

void study_front(study_run *run, const study_dial *dial, study_setting *settings, int count)
{
    char columns[256];
    qsort(settings, (size_t)count, sizeof *settings, by_cost);
    mark_front(settings, count);
    snprintf(columns, sizeof columns, "setting,%s,error,error_bar,on_front", dial->unit);
    study_table(run, dial->table, columns);
    for (int i = 0; i < count; ++i)
        study_row(run, "%s,%.6g,%.6g,%.3g,%d", settings[i].name, settings[i].cost, settings[i].error, settings[i].bar,
                  settings[i].on_front);
    study_end_table(run);
    outcome_add_front(run, dial, settings, count);
}
