/* What things cost and how far they are off. Measured, and written, by tests/bench/costs.c:
 *
 *     ./dev bench costs && build/release/bench/costs > src/plan/cost_table.c && ./dev format
 */
#include "plan/cost_table.h"

const float plan_costs[PLAN_COST_COUNT] = {
    [PLAN_COST_CAMERA_RAY] = 166.8F, [PLAN_COST_BOUNCE_RAY] = 367.9F,     [PLAN_COST_SHADOW_RAY] = 35.2F,
    [PLAN_COST_SMOOTH] = 26.3F,      [PLAN_COST_COUNTED] = 61.9F,         [PLAN_COST_COUNTED_COLORS] = 89.1F,
    [PLAN_COST_DRAWN] = 47.6F,       [PLAN_COST_FADED] = 32.3F,           [PLAN_COST_DICTIONARY] = 2321.7F,
    [PLAN_COST_EXAMPLE] = 4271.1F,   [PLAN_COST_EXPLICIT_FACET] = 458.9F, [PLAN_COST_POINTS] = 81.0F,
    [PLAN_COST_LTC] = 594.0F,        [PLAN_COST_QUADRATURE] = 12697.4F,   [PLAN_COST_COAT] = 239.6F,
    [PLAN_COST_TEXTURE] = 206.2F,    [PLAN_COST_NORMAL_MAP] = 242.6F,     [PLAN_COST_ALPHA] = 163.9F,
    [PLAN_COST_ANISOTROPY] = 1.7F,
};

const float plan_ltc_errors[2] = { 0.00053F, 0.0052F };
const float plan_ltc_flips[2] = { 0.00032F, 0.0024F };
