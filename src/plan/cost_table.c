/* What things cost and how far they are off. Measured, and written, by tests/bench/costs.c:
 *
 *     ./dev bench && build/release/bench/costs > src/plan/cost_table.c && ./dev format
 */
#include "plan/cost_table.h"

const float plan_costs[PLAN_COST_COUNT] = {
    [PLAN_COST_CAMERA_RAY] = 511.1F,   [PLAN_COST_BOUNCE_RAY] = 423.0F,     [PLAN_COST_SHADOW_RAY] = 197.2F,
    [PLAN_COST_SMOOTH] = 60.6F,        [PLAN_COST_COUNTED] = 248.6F,        [PLAN_COST_COUNTED_COLORS] = 328.6F,
    [PLAN_COST_DRAWN] = 188.8F,        [PLAN_COST_FADED] = 76.0F,           [PLAN_COST_DICTIONARY] = 12444.7F,
    [PLAN_COST_EXAMPLE] = 6553.9F,     [PLAN_COST_EXPLICIT_FACET] = 459.9F, [PLAN_COST_LTC] = 870.9F,
    [PLAN_COST_QUADRATURE] = 11399.4F, [PLAN_COST_COAT] = 537.7F,           [PLAN_COST_TEXTURE] = 233.4F,
    [PLAN_COST_NORMAL_MAP] = 279.8F,   [PLAN_COST_ALPHA] = 185.7F,          [PLAN_COST_ANISOTROPY] = 9.9F,
};

const float plan_ltc_errors[2] = { 0.0092F, 0.011F };
