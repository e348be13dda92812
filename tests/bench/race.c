/* Runs contestants in turn and takes medians of their quotients. */
#include "race.h"

#include <stdlib.h>
#include <time.h>

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double race_now(void)
{
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

double race_now_all(void)
{
    return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts. */
static double quantile(double *value, int count, double q)
{
    qsort(value, (size_t)count, sizeof *value, by_size);
    return value[(int)(q * (double)(count - 1) + 0.5)];
}

void race(const racer *racers, size_t count, double units, int rounds, race_result *result)
{
    double *const seconds = calloc(count * (size_t)rounds + (size_t)rounds, sizeof *seconds);
    if (seconds == NULL) {
        fprintf(stderr, "bench: no memory for %d rounds\n", rounds);
        exit(1);
    }
    double *const sorted = seconds + count * (size_t)rounds;
    for (int r = -1; r < rounds; r++)
        for (size_t i = 0; i < count; i++) {
            const double start = race_now();
            racers[i].run(racers[i].user);
            if (r >= 0)
                seconds[i * (size_t)rounds + (size_t)r] = race_now() - start;
        }
    for (size_t i = 0; i < count; i++) {
        const double *const mine = seconds + i * (size_t)rounds;
        for (int r = 0; r < rounds; r++)
            sorted[r] = mine[r];
        result[i].median_ns = quantile(sorted, rounds, 0.5) / units * 1e9;
        result[i].least_ns = sorted[0] / units * 1e9;
        for (int r = 0; r < rounds; r++)
            sorted[r] = seconds[r] / mine[r];
        result[i].faster = quantile(sorted, rounds, 0.5);
        result[i].faster_low = quantile(sorted, rounds, 0.25);
        result[i].faster_high = quantile(sorted, rounds, 0.75);
    }
    free(seconds);
}

void race_print(const char *title, const racer *racers, size_t count, const race_result *result)
{
    printf("%-34s %9s %9s %9s   %s\n", title, "least ns", "median", "times", "quartiles");
    for (size_t i = 0; i < count; i++)
        printf("  %-32s %9.2f %9.2f %9.2f   %.2f to %.2f\n", racers[i].name, result[i].least_ns, result[i].median_ns,
               result[i].faster, result[i].faster_low, result[i].faster_high);
}

void race_write(FILE *json, const char *title, const racer *racers, size_t count, const race_result *result)
{
    fprintf(json, "  \"%s\": [", title);
    for (size_t i = 0; i < count; i++)
        fprintf(json,
                "%s\n    { \"name\": \"%s\", \"least_ns\": %.6g, \"median_ns\": %.6g, \"faster\": %.6g, "
                "\"faster_quartiles\": [%.6g, %.6g] }",
                i ? "," : "", racers[i].name, result[i].least_ns, result[i].median_ns, result[i].faster,
                result[i].faster_low, result[i].faster_high);
    fprintf(json, "\n  ]");
}
