/* Where the counting kernel stands between what the processor computes and what memory brings.
 *
 * bench/roofline FILE.json. Loops of nothing but arithmetic, a sum over more memory than any cache holds, and the
 * kernel at each width run in turn. Instructions are counted by stepping through them one by one, which knows every
 * width; each counts as one operation a lane, be it arithmetic, a move or a jump. Beside FILE.json it writes
 * roofline.csv and roofline_roof.csv for the picture.
 */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include "race.h"
#include "roofline_peak.h"
#include "workload.h"

enum { WIDTHS = 3, STREAM_BYTES = 1 << 28, ROUNDS = 40 };

/* What an evaluation reads and writes: two doubles, ten floats or integers, two results. */
#define BYTES_EACH (2.0 * 8.0 + 10.0 * 4.0 + 2.0 * 4.0)

static const int lanes_of[WIDTHS] = { 4, 8, 16 };
static volatile unsigned sink;
static workload work;
static uint64_t *stream;

static void run_loop(void *user)
{
    roofline_loop *const *const loop = user;
    sink += (*loop)();
}

static void run_kernel(void *user)
{
    counting_kernel *const *const kernel = user;
    (*kernel)(&work.points, WORKLOAD_POINTS, work.factor, work.facets);
}

static void run_stream(void *user)
{
    (void)user;
    uint64_t sum[8] = { 0 };
    for (size_t i = 0; i < STREAM_BYTES / sizeof *stream; i += 8)
        for (size_t k = 0; k < 8; ++k)
            sum[k] += stream[i + k];
    for (size_t k = 0; k < 8; ++k)
        sink += (unsigned)sum[k];
}

typedef struct width {
    roofline_loop *integer, *real;
    counting_kernel *kernel;
    double operations;                           /* of an evaluation */
    double integer_rate, real_rate, kernel_rate; /* operations of lanes a second */
} width;

/* In the order of lanes_of; those that the machine runs. */
static int find_widths(width *w)
{
    static roofline_loop *const integers[WIDTHS] = { roofline_integer_4, roofline_integer_8, roofline_integer_16 };
    static roofline_loop *const reals[WIDTHS] = { roofline_float_4, roofline_float_8, roofline_float_16 };
    int count = 0;
    for (int i = 0; i < WIDTHS; ++i) {
        const counting_width found = counting_widest((size_t)lanes_of[i]);
        if (found.lanes == (size_t)lanes_of[i])
            w[count++] = (width){ .integer = integers[i], .real = reals[i], .kernel = found.kernel };
    }
    return count;
}

static double bandwidth(void)
{
    race_result result;
    const racer one = { "memory", run_stream, NULL };
    stream = malloc(STREAM_BYTES);
    if (stream == NULL)
        exit(1);
    memset(stream, 1, STREAM_BYTES);
    race(&one, 1, 1.0, 12, &result);
    free(stream);
    return STREAM_BYTES / (result.median_ns * 1e-9);
}

/* Instructions of a process that evaluates count points and ends. */
static double steps_of(counting_kernel *kernel, size_t count)
{
    const pid_t child = fork();
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, NULL, NULL);
        raise(SIGSTOP);
        kernel(&work.points, count, work.factor, work.facets);
        _exit(0);
    }
    int status = 0;
    double steps = 0.0;
    while (child > 0 && waitpid(child, &status, 0) == child && WIFSTOPPED(status)) {
        if (ptrace(PTRACE_SINGLESTEP, child, NULL, NULL) != 0)
            break;
        steps += 1.0;
    }
    return steps;
}

/* What is apart from the points cancels. */
static double operations_of(counting_kernel *kernel, int lanes)
{
    enum { FEW = 0, MANY = 1024 };
    return lanes * (steps_of(kernel, MANY) - steps_of(kernel, FEW)) / (MANY - FEW);
}

static void measure(width *w, int count)
{
    racer racers[3 * WIDTHS];
    race_result result[3 * WIDTHS];
    for (int i = 0; i < count; ++i) {
        racers[3 * i] = (racer){ "integers", run_loop, &w[i].integer };
        racers[3 * i + 1] = (racer){ "floats", run_loop, &w[i].real };
        racers[3 * i + 2] = (racer){ "kernel", run_kernel, &w[i].kernel };
    }
    race(racers, 3 * (size_t)count, 1.0, ROUNDS, result);
    for (int i = 0; i < count; ++i) {
        const double each = (double)lanes_of[i] * ROOFLINE_OPERATIONS_PER_LANE;
        w[i].integer_rate = each / (result[3 * i].median_ns * 1e-9);
        w[i].real_rate = each / (result[3 * i + 1].median_ns * 1e-9);
        w[i].operations = operations_of(w[i].kernel, lanes_of[i]);
        w[i].kernel_rate = w[i].operations * WORKLOAD_POINTS / (result[3 * i + 2].median_ns * 1e-9);
    }
}

static FILE *open_beside(const char *json, const char *name)
{
    char path[4096];
    const char *const slash = strrchr(json, '/');
    snprintf(path, sizeof path, "%.*s%s", slash != NULL ? (int)(slash - json + 1) : 0, json, name);
    return fopen(path, "w");
}

int main(int argc, char **argv)
{
    FILE *const json = argc == 2 ? fopen(argv[1], "w") : NULL;
    FILE *const points = json != NULL ? open_beside(argv[1], "roofline.csv") : NULL;
    FILE *const roof = json != NULL ? open_beside(argv[1], "roofline_roof.csv") : NULL;
    if (points == NULL || roof == NULL) {
        fprintf(stderr, "usage: %s FILE.json\n", argv[0]);
        return 2;
    }
    width w[WIDTHS];
    const int count = find_widths(w);
    workload_fill(&work, &workload_kinds[0]);
    measure(w, count);
    const double memory = bandwidth();
    printf("memory %.1f GB/s\n", memory * 1e-9);
    fprintf(json, "{\n  \"memory_GB_s\": %.4g,\n  \"widths\": [", memory * 1e-9);
    for (int i = 0; i < count; ++i) {
        const double peak = fmax(w[i].integer_rate, w[i].real_rate), intensity = w[i].operations / BYTES_EACH;
        printf("%2d lanes: %.0f instructions an evaluation, %.1f operations a byte; billion operations a second: "
               "integers %.0f, floats %.0f, kernel %.0f, %.2f of the peak\n",
               lanes_of[i], w[i].operations / lanes_of[i], intensity, w[i].integer_rate * 1e-9, w[i].real_rate * 1e-9,
               w[i].kernel_rate * 1e-9, w[i].kernel_rate / peak);
        fprintf(
            json,
            "%s\n    { \"lanes\": %d, \"instructions\": %.0f, \"operations_per_byte\": %.4g, \"integer_G_s\": %.4g, "
            "\"float_G_s\": %.4g, \"kernel_G_s\": %.4g, \"of_peak\": %.4g }",
            i ? "," : "", lanes_of[i], w[i].operations / lanes_of[i], intensity, w[i].integer_rate * 1e-9,
            w[i].real_rate * 1e-9, w[i].kernel_rate * 1e-9, w[i].kernel_rate / peak);
        fprintf(points, "%d,%.6g,%.6g\n", lanes_of[i], intensity, w[i].kernel_rate * 1e-9);
        for (double x = 1.0 / 16.0; x <= 1024.0; x *= 1.1)
            fprintf(roof, "%.6g,%.6g\n", x, fmin(x * memory, peak) * 1e-9);
        fprintf(roof, "\n\n");
    }
    fprintf(json, "\n  ]\n}\n");
    return fclose(json) != 0 || fclose(points) != 0 || fclose(roof) != 0;
}
