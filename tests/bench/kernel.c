/* The counting kernel at every width of this machine against the method as published.
 *
 * bench/kernel FILE.json [rounds]. Every contestant's mean is checked, so that nothing wins by doing less.
 * bench/kernel count LANES N: 1024 N points of the mix and nothing else, for batch_cost.sh to count instructions;
 * LANES alone: one point at a time; LANES lit: eight lanes, four lights at each point, 1024 N lights.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "published_count.h"
#include "race.h"
#include "workload.h"

enum { MOST_RACERS = 6 };

typedef struct runner {
    counting_kernel *kernel;
    workload *work;
} runner;

static void run(void *user)
{
    const runner *const r = user;
    r->kernel(&r->work->points, WORKLOAD_POINTS, r->work->factor, r->work->facets);
}

/* Mean of factor, weighted with the lit facets, so that rare bright points do not drown the rest: 1 for a binomial. */
static double weighted_mean(const workload *w)
{
    double sum = 0.0, weight = 0.0;
    for (int i = 0; i < WORKLOAD_POINTS; i++) {
        const double lit = fmin((double)w->facets[i] * (double)w->p[i], 100.0);
        sum += lit * (double)w->factor[i];
        weight += lit;
    }
    return sum / weight;
}

enum { LIGHTS = 4 }; /* at each point */

/* So many lights at each point, apart and together, at each width: what another light costs is the rest of four. */
static void race_lights(FILE *json, int rounds)
{
    static const char *const names[4] = { "8 lanes, apart", "8 lanes, together", "16 lanes, apart",
                                          "16 lanes, together" };
    static workload works[2];
    racer racers[4];
    runner runners[4];
    race_result result[4];
    const size_t widest = counting_widest(16).lanes, count = widest == 16 ? 4 : widest == 8 ? 2 : 0;
    for (int i = 0; i < 2; i++) {
        workload_fill(&works[i], &workload_kinds[0]);
        workload_add_lights(&works[i], LIGHTS, i);
    }
    for (size_t i = 0; i < count; i++) {
        runners[i] = (runner){ counting_widest(i < 2 ? 8 : 16).kernel, &works[i % 2] };
        racers[i] = (racer){ names[i], run, &runners[i] };
        run(&runners[i]);
    }
    for (int i = 0; i < WORKLOAD_POINTS; i++)
        if (works[0].factor[i] != works[1].factor[i]) {
            fprintf(stderr, "bench: lights together have other values than apart\n");
            exit(1);
        }
    if (count > 0)
        race(racers, count, WORKLOAD_POINTS, rounds, result);
    race_print("four lights a point", racers, count, result);
    race_write(json, "four lights a point", racers, count, result);
    for (size_t i = 0; i < count; i += 2)
        printf("  another light over the first, %.2s lanes: %.2f\n", names[i],
               (LIGHTS * result[i + 1].median_ns / result[i].median_ns - 1.0) / (LIGHTS - 1));
    printf("\n");
}

/* False: the machine has no such width. */
static int run_alone(const char *lanes, int thousands)
{
    static workload work;
    const int is_alone = strcmp(lanes, "alone") == 0, is_lit = strcmp(lanes, "lit") == 0;
    const size_t asked = is_lit ? 8 : (size_t)atoi(lanes);
    const counting_width width = is_alone ? counting_narrowest(16) : counting_widest(asked);
    if (!is_alone && width.lanes != asked)
        return 0;
    workload_fill(&work, &workload_kinds[0]);
    if (is_lit) {
        workload_add_lights(&work, LIGHTS, 1);
        for (int i = 0; i < thousands; i += WORKLOAD_POINTS / 1024)
            width.kernel(&work.points, WORKLOAD_POINTS, work.factor, work.facets);
        return 1;
    }
    for (int i = 0; i < thousands; i++) {
        const counting_points *const p = &work.points;
        const size_t at = (size_t)(i % (WORKLOAD_POINTS / 1024)) * 1024;
        const counting_points part = { p->u + at,    p->v + at,    p->dudx + at,    p->dudy + at,
                                       p->dvdx + at, p->dvdy + at, p->density + at, p->seed + at,
                                       p->hx + at,   p->hy + at,   p->cap + at,     p->p + at };
        width.kernel(&part, 1024, work.factor, work.facets);
    }
    return 1;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "count") == 0)
        return run_alone(argv[2], atoi(argv[3])) ? 0 : 1;
    if (argc < 2) {
        fprintf(stderr, "usage: %s FILE.json [ROUNDS]\n", argv[0]);
        return 2;
    }
    const int rounds = argc > 2 ? atoi(argv[2]) : 60;
    FILE *const json = fopen(argv[1], "w");
    if (json == NULL || rounds < 1) {
        fprintf(stderr, "bench: cannot write '%s', or the rounds are not a number above 0\n", argv[1]);
        return 2;
    }
    racer racers[MOST_RACERS] = { { "as published, scalar", run, NULL } };
    runner runners[MOST_RACERS] = { { published_count, NULL } };
    static const char *const names[] = { "ours, 1 lane", "ours, 4 lanes", "ours, 8 lanes", "ours, 16 lanes" };
    size_t count = 1, found = 0;
    for (size_t i = 0; i < 4; i++) {
        const counting_width width = counting_widest(i == 0 ? 1 : (size_t)2 << i);
        if (width.lanes == found)
            continue;
        found = width.lanes;
        racers[count].name = names[i];
        racers[count].run = run;
        runners[count++].kernel = width.kernel;
    }
    racers[count] = (racer){ "ours, one point in 4 lanes", run, NULL };
    runners[count++].kernel = counting_narrowest(16).kernel;
    static workload work;
    fprintf(json, "{\n");
    for (int k = 0; k < WORKLOAD_KINDS; k++) {
        race_result result[MOST_RACERS];
        workload_fill(&work, &workload_kinds[k]);
        for (size_t i = 0; i < count; i++) {
            runners[i].work = &work;
            racers[i].user = &runners[i];
        }
        race(racers, count, WORKLOAD_POINTS, rounds, result);
        race_print(work.name, racers, count, result);
        race_write(json, work.name, racers, count, result);
        fprintf(json, ",\n");
        printf("  mean of b / (N p):");
        for (size_t i = 0; i < count; i++) {
            run(&runners[i]);
            printf(" %.3f", weighted_mean(&work));
        }
        printf("\n\n");
    }
    race_lights(json, rounds);
    fprintf(json, "\n}\n");
    return fclose(json) != 0;
}
