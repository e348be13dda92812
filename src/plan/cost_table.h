/* What things cost and how far they are off, measured: cost_table.c is written by tests/bench/costs.c. */
#ifndef PLAN_COST_TABLE_H
#define PLAN_COST_TABLE_H

typedef enum plan_cost {
    PLAN_COST_CAMERA_RAY, /* a ray, its hit, and a plain surface made ready */
    PLAN_COST_BOUNCE_RAY, /* the same for a ray that was drawn from a surface */
    PLAN_COST_SHADOW_RAY,
    PLAN_COST_SMOOTH, /* an evaluation without facets */
    PLAN_COST_COUNTED,
    PLAN_COST_COUNTED_COLORS,
    PLAN_COST_DRAWN, /* one realisation for all 36 */
    PLAN_COST_FADED, /* nothing counted, but found out at the point */
    PLAN_COST_DICTIONARY,
    PLAN_COST_EXAMPLE,
    PLAN_COST_EXPLICIT_FACET, /* one facet */
    PLAN_COST_POINTS,         /* a few of a light over which the lobe hardly bends */
    PLAN_COST_LTC,            /* of any other */
    PLAN_COST_QUADRATURE,
    PLAN_COST_COAT, /* a second layer */
    PLAN_COST_TEXTURE,
    PLAN_COST_NORMAL_MAP,
    PLAN_COST_ALPHA, /* a surface that rays may pass */
    PLAN_COST_ANISOTROPY,
    PLAN_COST_COUNT
} plan_cost;

/* ns on one core; only their ratios last. */
extern const float plan_costs[PLAN_COST_COUNT];
/* Over lights and surfaces, weighted by light, of GGX and of Beckmann: the root mean square of what linearly
 * transformed cosines are off, relative; and the share of the lit facets that they turn on or off. */
extern const float plan_ltc_errors[2], plan_ltc_flips[2];

#endif
