/* How time and memory grow with what a scene holds.
 *
 * bench/growth FILE.json: every size of every case, each in a process of its own, several times; the time is the median
 * of the processor's, the memory the largest that was resident. Beside FILE.json it writes growth.csv, which
 * growth*.gnuplot plot.
 * bench/growth --count: small sizes of all cases in one process, for callgrind; prints what they are.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "growth_cases.h"
#include "race.h"

/* Shorter work is repeated until it is so long; cheap sizes are measured more often. */
#define LEAST_S 0.05
enum { RUNS = 5, LONG_RUNS = 3 };
#define LONG_S 4.0

typedef struct measured {
    double seconds, peak_mib;
    growth_load load;
} measured;

/* What the child tells. Pictures and evaluations can be done again; files are read once. */
static double time_run(const growth_case *c)
{
    int times = 1;
    double start = race_now_all();
    growth_run(c);
    double seconds = race_now_all() - start;
    if (growth_loaded.all_s > 0.0 || seconds >= LEAST_S)
        return seconds;
    times = (int)ceil(LEAST_S / fmax(seconds, 1e-6));
    start = race_now_all();
    for (int i = 0; i < times; ++i)
        growth_run(c);
    seconds = race_now_all() - start;
    return seconds / times;
}

static measured measure_once(const growth_case *c, double size)
{
    int ends[2], status = 0;
    measured m = { 0 };
    struct rusage usage;
    if (pipe(ends) != 0)
        exit(1);
    const pid_t child = fork();
    if (child == 0) {
        c->prepare(size);
        m.seconds = time_run(c);
        m.load = growth_loaded;
        growth_clean();
        _exit(write(ends[1], &m, sizeof m) == (ssize_t)sizeof m ? 0 : 1);
    }
    close(ends[1]);
    const bool told = child > 0 && read(ends[0], &m, sizeof m) == (ssize_t)sizeof m;
    close(ends[0]);
    if (!told || wait4(child, &status, 0, &usage) != child || status != 0) {
        fprintf(stderr, "growth: %s of %g failed\n", c->name, size);
        exit(1);
    }
    m.peak_mib = (double)usage.ru_maxrss / 1024.0;
    return m;
}

static int by_time(const void *a, const void *b)
{
    const measured *const x = a, *const y = b;
    return (x->seconds > y->seconds) - (x->seconds < y->seconds);
}

static measured measure(const growth_case *c, double size)
{
    measured all[RUNS];
    int count = 0;
    do
        all[count++] = measure_once(c, size);
    while (count < (all[0].seconds > LONG_S ? LONG_RUNS : RUNS));
    qsort(all, (size_t)count, sizeof *all, by_time);
    return all[count / 2];
}

/* Of a straight line through logarithms; of the upper half, where set-up no longer hides what grows. */
static double slope(const double *x, const double *y, int count)
{
    const int first = count / 2;
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int i = first; i < count; ++i) {
        const double u = log(x[i]), v = log(y[i]);
        n += 1.0;
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

static void study(const growth_case *c, bool is_first, FILE *json, FILE *csv)
{
    double seconds[GROWTH_MOST_SIZES] = { 0 }, mib[GROWTH_MOST_SIZES] = { 0 }, least = (double)INFINITY, most = 0.0;
    growth_load load = { 0 };
    int count = 0;
    for (; count < GROWTH_MOST_SIZES && c->sizes[count] > 0.0; ++count) {
        const measured m = measure(c, c->sizes[count]);
        seconds[count] = m.seconds;
        mib[count] = m.peak_mib;
        load = m.load;
        least = fmin(least, m.seconds);
        most = fmax(most, m.seconds);
        fprintf(csv, "%s,%.10g,%.6g,%.6g,%.6g\n", c->name, c->sizes[count], m.seconds, m.peak_mib, load.trace_s);
        fflush(csv);
    }
    const double time = slope(c->sizes, seconds, count), memory = slope(c->sizes, mib, count);
    printf("%-11s %8.3g to %8.3g %-18s %9.4g to %9.4g s, slope %6.3f, largest over smallest %8.4g; %5.0f to %5.0f MiB, "
           "slope %6.3f\n",
           c->name, c->sizes[0], c->sizes[count - 1], c->size, seconds[0], seconds[count - 1], time, most / least,
           mib[0], mib[count - 1], memory);
    if (load.all_s > 0.0)
        printf("            of the largest: reading %.3g s, Embree's build %.3g s of %.3g s, a share of %.2f\n",
               load.read_s, load.trace_s, load.all_s, load.trace_s / load.all_s);
    fflush(stdout);
    fprintf(json,
            "%s\n  \"%s\": { \"slope\": %.4g, \"largest_over_smallest\": %.4g, \"memory_slope\": %.4g, "
            "\"seconds\": [%.6g, %.6g], \"peak_MiB\": [%.6g, %.6g], \"embree_share\": %.4g }",
            is_first ? "" : ",", c->name, time, most / least, memory, seconds[0], seconds[count - 1], mib[0],
            mib[count - 1], load.all_s > 0.0 ? load.trace_s / load.all_s : 0.0);
}

static void count_small(void)
{
    for (int k = 0; k < growth_case_count; ++k) {
        const growth_case *const c = &growth_cases[k];
        /* What is done once, such as the loading of what reads pictures, is no growth. */
        c->prepare(c->small[0]);
        c->run();
        for (int i = 0; i < GROWTH_MOST_SMALL && c->small[i] > 0.0; ++i) {
            c->prepare(c->small[i]);
            growth_run(c);
            printf("%s %s %g\n", c->name, c->is_flat ? "flat" : "linear", c->small[i]);
            fflush(stdout);
        }
    }
    growth_clean();
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--count") == 0) {
        count_small();
        return 0;
    }
    char path[4096] = "";
    const size_t length = argc > 1 ? strlen(argv[1]) : 0;
    if (length > 5 && length < sizeof path && strcmp(argv[1] + length - 5, ".json") == 0) {
        snprintf(path, sizeof path, "%.*s.csv", (int)(length - 5), argv[1]);
    }
    FILE *const json = path[0] != '\0' ? fopen(argv[1], "w") : NULL, *const csv =
                                                                         json != NULL ? fopen(path, "w") : NULL;
    if (csv == NULL) {
        fprintf(stderr, "usage: %s FILE.json [CASE]... | --count\n", argv[0]);
        return 2;
    }
    fprintf(csv, "case,size,seconds,peak_mib,embree_s\n");
    fprintf(json, "{");
    bool is_first = true;
    for (int k = 0; k < growth_case_count; ++k) {
        bool wanted = argc == 2;
        for (int i = 2; i < argc; ++i)
            wanted = wanted || strcmp(argv[i], growth_cases[k].name) == 0;
        if (!wanted)
            continue;
        study(&growth_cases[k], is_first, json, csv);
        is_first = false;
    }
    fprintf(json, "\n}\n");
    return fclose(json) != 0 || fclose(csv) != 0;
}
