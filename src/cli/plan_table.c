/* The plan as a table for people: what is done, to what, at which price; what nothing uses in one line at the end.
 *
 * A decision about every material under every light would fill pages. Those of one material (or of the whole picture)
 * that say the same are one row, which has the reason of the dearest and says how many more there are.
 */
#include "cli/plan_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- cells ---- */

static const char *material_name(const scene *s, int32_t index)
{
    const char *const name = s->materials[index].name;
    return name != NULL && name[0] != '\0' ? name : "(no name)";
}

static void print_percent(double share)
{
    if (!(share > 0.0))
        printf("%6s", "-");
    else if (share < 0.0005)
        printf("%6s", "<.1 %");
    else
        printf("%4.*f %%", share < 0.0995 ? 1 : 0, 100.0 * share);
}

static void print_row(const char *effect, const char *choice, double time, double error, const char *reason)
{
    printf("  %-12s  %-11s ", effect, choice);
    print_percent(time);
    printf("  ");
    print_percent(error);
    printf("  %s", reason);
}

/* ---- every decision ---- */

static void print_all(const glint_plan *plan, const scene *s)
{
    printf("%-16s    %-12s  %-11s %6s  %6s  %s\n", "material", "effect", "choice", "time", "error", "why");
    for (int on = 1; on >= 0; --on)
        for (uint32_t i = 0; i < glint_plan_decision_count(plan); ++i) {
            const glint_decision *const d = glint_plan_decision(plan, i);
            if ((d->is_on != 0) != (on != 0))
                continue;
            printf("%-16.16s%s", d->material < 0 ? "(picture)" : material_name(s, d->material), on ? "    " : " off");
            print_row(glint_effect_name(d->effect), d->choice, (double)d->time_share, (double)d->error, d->reason);
            putchar('\n');
        }
}

/* ---- what matters ---- */

/* What is on; and what the plan, not the scene, has switched off. */
static bool is_shown(const glint_decision *d)
{
    return d->is_on || d->error > 0.0F || d->effect == GLINT_EFFECT_FACETS || d->effect == GLINT_EFFECT_BOUNCES;
}

/* A decision, and where it stands among all. */
typedef struct entry {
    const glint_decision *decision;
    uint32_t index;
    uint32_t leader; /* of the first that says the same: rows come in that order */
} entry;

/* By material, and there those together that say the same. */
static int compare_sayings(const entry *a, const entry *b)
{
    const glint_decision *const x = a->decision, *const y = b->decision;
    if (x->material != y->material)
        return (x->material > y->material) - (x->material < y->material);
    if (x->effect != y->effect)
        return (x->effect > y->effect) - (x->effect < y->effect);
    return strcmp(x->choice, y->choice);
}

static int compare_entries(const void *a, const void *b)
{
    const entry *const x = a, *const y = b;
    const int order = compare_sayings(x, y);
    return order != 0 ? order : (x->index > y->index) - (x->index < y->index);
}

/* By material, and there as the plan has them. */
static int compare_rows(const void *a, const void *b)
{
    const entry *const x = a, *const y = b;
    if (x->decision->material != y->decision->material)
        return (x->decision->material > y->decision->material) - (x->decision->material < y->decision->material);
    if (x->leader != y->leader)
        return (x->leader > y->leader) - (x->leader < y->leader);
    return (x->index > y->index) - (x->index < y->index);
}

/* What is shown, row by row. NULL: there is no memory. */
static entry *sort_shown(const glint_plan *plan, uint32_t *count)
{
    const uint32_t all = glint_plan_decision_count(plan);
    entry *const list = malloc((all > 0 ? all : 1U) * sizeof *list);
    *count = 0;
    for (uint32_t i = 0; list != NULL && i < all; ++i)
        if (is_shown(glint_plan_decision(plan, i)))
            list[(*count)++] = (entry){ glint_plan_decision(plan, i), i, i };
    if (list == NULL)
        return NULL;
    qsort(list, *count, sizeof *list, compare_entries);
    for (uint32_t i = 1; i < *count; ++i)
        if (compare_sayings(&list[i - 1], &list[i]) == 0)
            list[i].leader = list[i - 1].leader;
    qsort(list, *count, sizeof *list, compare_rows);
    return list;
}

/* Decisions that say the same, as one row. Returns how many they are. */
static uint32_t print_alike(const entry *first, uint32_t most)
{
    const glint_decision *dearest = first->decision;
    double time = 0.0, variance = 0.0;
    uint32_t count = 0;
    for (; count < most && first[count].leader == first->leader; ++count) {
        const glint_decision *const d = first[count].decision;
        if (d->ns_per_sample > dearest->ns_per_sample)
            dearest = d;
        time += (double)d->time_share;
        variance += (double)d->error * (double)d->error;
    }
    print_row(glint_effect_name(dearest->effect), dearest->choice, time, sqrt(variance), dearest->reason);
    if (count > 1)
        printf("; %u more light%s like it", count - 1, count > 2 ? "s" : "");
    putchar('\n');
    return count;
}

/* The rows of one material, from its first decision on; -1: of the picture. Returns the place behind them. */
static uint32_t print_group(const entry *list, uint32_t count, uint32_t at, int32_t material)
{
    while (at < count && list[at].decision->material == material)
        at += print_alike(&list[at], count - at);
    return at;
}

/* ---- what is not there ---- */

static void print_plain(const entry *list, uint32_t entry_count, const scene *s)
{
    int count = 0;
    uint32_t at = 0;
    for (int32_t m = 0; m < s->material_count; ++m) {
        while (at < entry_count && list[at].decision->material < m)
            ++at;
        if (at == entry_count || list[at].decision->material != m)
            printf("%s%s", count++ == 0 ? "nothing but a surface: " : ", ", material_name(s, m));
    }
    if (count > 0)
        putchar('\n');
}

/* Effects that some decision is about, and that no material or light has on. */
static void print_unused(const glint_plan *plan)
{
    int count = 0;
    for (int effect = 0; glint_effect_name((glint_effect)effect) != NULL; ++effect) {
        bool asked = false, on = false;
        for (uint32_t i = 0; i < glint_plan_decision_count(plan); ++i) {
            const glint_decision *const d = glint_plan_decision(plan, i);
            asked = asked || (int)d->effect == effect;
            on = on || ((int)d->effect == effect && is_shown(d));
        }
        if (asked && !on)
            printf("%s%s", count++ == 0 ? "off everywhere: " : ", ", glint_effect_name((glint_effect)effect));
    }
    if (count > 0)
        puts(" (not called, and free)");
}

static void print_short(const glint_plan *plan, const scene *s)
{
    uint32_t count;
    entry *const list = sort_shown(plan, &count);
    if (list == NULL) {
        print_all(plan, s);
        return;
    }
    printf("%-27s  %6s  %6s  %s\n", "", "time", "error", "why");
    puts("the picture");
    for (uint32_t at = print_group(list, count, 0, -1); at < count;) {
        const int32_t material = list[at].decision->material;
        puts(material_name(s, material));
        at = print_group(list, count, at, material);
    }
    print_plain(list, count, s);
    print_unused(plan);
    free(list);
}

/* ---- the whole ---- */

static void print_sum(const glint_plan *plan, const render_values *v)
{
    const glint_plan_outcome out = glint_plan_result(plan);
    const double samples = (double)v->size[0] * (double)v->size[1] * (double)out.samples;
    printf("\nabout %.3g us a sample, %.3g s of one core in all; error of what is left out %.2g, noise of %u samples "
           "about %.2g\n",
           1e-3 * (double)out.ns_per_sample, 1e-9 * (double)out.ns_per_sample * samples, (double)out.error, out.samples,
           (double)out.noise);
    if (out.error_of_mean > 1.05F * out.error)
        printf("few facets are lit, and some flip: that is %.2g of the picture's root mean square, %.2g of its mean\n",
               (double)out.error, (double)out.error_of_mean);
    if (!(render_accuracy(v) > 0.0))
        puts("nothing is left out");
    else if (out.is_met)
        printf("the budget of %g is met\n", render_accuracy(v));
    else if (out.enough_samples > 0)
        printf("the budget of %g is not met; --spp %u would do\n", render_accuracy(v), out.enough_samples);
    else
        printf("the budget of %g cannot be met\n", render_accuracy(v));
}

void plan_print_table(const glint_plan *plan, const scene *s, const render_values *v)
{
    if (v->all)
        print_all(plan, s);
    else
        print_short(plan, s);
    print_sum(plan, v);
}
