/* Inside the plan: the budget as it is shared out, and how decisions are written down. */
#ifndef PLAN_PLAN_H
#define PLAN_PLAN_H

#include "glint.h"
#include "plan/cost_table.h"

/* A pixel under box filter varies by up to so many times (1 - p) / (N p): docs/truth.md, single pixels, 16 samples. */
#define PLAN_PIXEL_VARIANCE 1.1
/* A drawn realisation varies by no more than so many 1 / (N p), as draw_deviation has it; model/counting_drawn.c shows
 * that it is less than 8. */
#define PLAN_DRAW_VARIANCE 9.0

/* What the plan says to the renderer. */
typedef struct plan_material {
    int is_smooth;
    float smooth_deviation, draw_deviation;
    glint_area_light_method method;
    double fit_variance, fit_evaluations; /* what the fit for lights with a shape would add, and per sample */
} plan_material;

struct glint_plan {
    glint_plan_summary summary; /* of its pointers none is followed after the plan is made */
    uint32_t fewest;            /* samples that may be taken; those of the summary are the plan's */
    glint_allocator allocator;
    glint_plan_outcome outcome;
    double budget;   /* that may be left out: all of the error budget, or what the noise leaves of it */
    double variance; /* of all errors so far */
    double excess;   /* of facets that flip, so much more over the picture's mean than over its root mean square */
    int is_strict;   /* the budget is for errors over the mean */
    plan_material *materials;
    uint32_t *first_pair, *pairs; /* indices of the summary's pairs, material by material; where each material begins */
    float *light_seen;            /* evaluations of each light per sample */
    float *light_shadows;         /* and shadow rays that something may block */
    int caps;                     /* entries of a pair's shapes for which a cap may stand, 0: none */
    glint_decision *decisions;
    uint32_t count, capacity;
};

/* Appends a decision; the reason is a format. error adds to the plan's. */
glint_decision *plan_decide(glint_plan *p, glint_decision d, const char *reason, ...)
    __attribute__((format(printf, 3, 4)));
/* The error that may still be spent, and its share of one in n. */
double plan_left(const glint_plan *p, int n);

/* The pairs of a material. */
static inline uint32_t plan_pair_count(const glint_plan *p, uint32_t material)
{
    return p->first_pair[material + 1] - p->first_pair[material];
}

static inline const glint_plan_pair *plan_pair(const glint_plan *p, uint32_t material, uint32_t index)
{
    return &p->summary.pairs[p->pairs[p->first_pair[material] + index]];
}

static inline const char *plan_light_name(const glint_plan_light *l)
{
    return l->name ? l->name : "a light";
}

/* N p in the middle of a bin. */
double plan_bin_middle(uint32_t bin);

/* plan_facets.c: FACETS, LOOKUPS and COLORS of a material. deviation: of a pixel, that each of the two may leave. */
void plan_facets(glint_plan *p, uint32_t material, double facets_error, double draws_error);
/* Whether a material has facets that fade into its smooth light where they are many, and whether single draws can stand
 * for them. */
int plan_fades(const glint_plan *p, uint32_t material);
int plan_draws(const glint_plan *p, uint32_t material);
/* Whether a light of this material is sampled and not evaluated. */
int plan_is_surrounded(const glint_plan *p, uint32_t material);

/* plan_lights.c: LIGHT. */
void plan_lights(glint_plan *p);

/* plan_shadows.c: SHADOWS. */
void plan_shadows(glint_plan *p);

/* plan_scene.c: everything else but the number of samples. */
void plan_surfaces(glint_plan *p);
void plan_bounces(glint_plan *p);

/* Decides everything anew, for so many samples and an error that may be left out. */
typedef void plan_decider(glint_plan *p, uint32_t samples, double budget);

/* plan_samples.c. The variance of a pixel of so many samples; the cheapest number of them; and what they come to. */
double plan_noise_variance(const glint_plan *p, double samples);
void plan_choose_samples(glint_plan *p, plan_decider *decide);
void plan_samples(glint_plan *p);

#endif
