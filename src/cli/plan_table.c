/* The plan as a table for people: what is done, to what, at which price; what nothing uses in one line at the end.
 *
 * A decision about every material under every light would fill pages. Those of one material (or of the whole picture)
 * that say the same are one row, which has the reason of the dearest and says how many more there are.
 */
#include "cli/plan_table.h"

#include <math.h>
#include <stdio.h>
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

static bool is_alike(const glint_decision *a, const glint_decision *b)
{
    return a->material == b->material && a->effect == b->effect && strcmp(a->choice, b->choice) == 0;
}

static bool is_first_of_its_kind(const glint_plan *plan, uint32_t index)
{
    for (uint32_t i = 0; i < index; ++i)
        if (is_alike(glint_plan_decision(plan, i), glint_plan_decision(plan, index)))
            return false;
    return true;
}

static void print_alike(const glint_plan *plan, uint32_t first)
{
    const glint_decision *dearest = glint_plan_decision(plan, first);
    double time = 0.0, variance = 0.0;
    int count = 0;
    for (uint32_t i = first; i < glint_plan_decision_count(plan); ++i) {
        const glint_decision *const d = glint_plan_decision(plan, i);
        if (!is_alike(d, dearest))
            continue;
        if (d->ns_per_sample > dearest->ns_per_sample)
            dearest = d;
        time += (double)d->time_share;
        variance += (double)d->error * (double)d->error;
        ++count;
    }
    print_row(glint_effect_name(dearest->effect), dearest->choice, time, sqrt(variance), dearest->reason);
    if (count > 1)
        printf("; %d more light%s like it", count - 1, count > 2 ? "s" : "");
    putchar('\n');
}

static int count_shown(const glint_plan *plan, int32_t material)
{
    int count = 0;
    for (uint32_t i = 0; i < glint_plan_decision_count(plan); ++i) {
        const glint_decision *const d = glint_plan_decision(plan, i);
        count += d->material == material && is_shown(d);
    }
    return count;
}

static void print_group(const glint_plan *plan, int32_t material)
{
    for (uint32_t i = 0; i < glint_plan_decision_count(plan); ++i) {
        const glint_decision *const d = glint_plan_decision(plan, i);
        if (d->material == material && is_shown(d) && is_first_of_its_kind(plan, i))
            print_alike(plan, i);
    }
}

/* ---- what is not there ---- */

static void print_plain(const glint_plan *plan, const scene *s)
{
    int count = 0;
    for (int32_t m = 0; m < s->material_count; ++m)
        if (count_shown(plan, m) == 0)
            printf("%s%s", count++ == 0 ? "nothing but a surface: " : ", ", material_name(s, m));
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
    printf("%-27s  %6s  %6s  %s\n", "", "time", "error", "why");
    puts("the picture");
    print_group(plan, -1);
    for (int32_t m = 0; m < s->material_count; ++m) {
        if (count_shown(plan, m) == 0)
            continue;
        puts(material_name(s, m));
        print_group(plan, m);
    }
    print_plain(plan, s);
    print_unused(plan);
}

/* ---- the whole ---- */

static void print_sum(const glint_plan *plan, const render_values *v)
{
    const glint_plan_outcome out = glint_plan_result(plan);
    const double samples = (double)v->size[0] * (double)v->size[1] * (double)v->spp;
    printf("\nabout %.3g us a sample, %.3g s of one core in all; error of what is left out %.2g, noise of %lld samples "
           "about %.2g\n",
           1e-3 * (double)out.ns_per_sample, 1e-9 * (double)out.ns_per_sample * samples, (double)out.error,
           (long long)v->spp, (double)out.noise);
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
