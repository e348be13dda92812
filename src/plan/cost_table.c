/* What things cost and how far they are off. Measured, and written, by tests/bench/costs.c:
 *
 *     ./dev bench costs && build/release/bench/costs > src/plan/cost_table.c && ./dev format
 */
#include "plan/cost_table.h"

const float plan_costs[PLAN_COST_COUNT] = {
    [PLAN_COST_CAMERA_RAY] = 165.9F,   [PLAN_COST_BOUNCE_RAY] = 364.6F,     [PLAN_COST_SHADOW_RAY] = 35.8F,
    [PLAN_COST_SMOOTH] = 25.4F,        [PLAN_COST_COUNTED] = 60.5F,         [PLAN_COST_COUNTED_COLORS] = 88.2F,
    [PLAN_COST_DRAWN] = 46.7F,         [PLAN_COST_FADED] = 31.4F,           [PLAN_COST_DICTIONARY] = 2320.1F,
    [PLAN_COST_EXAMPLE] = 4258.7F,     [PLAN_COST_EXPLICIT_FACET] = 450.1F, [PLAN_COST_LTC] = 82.6F,
    [PLAN_COST_QUADRATURE] = 12723.0F, [PLAN_COST_COAT] = 237.6F,           [PLAN_COST_TEXTURE] = 206.4F,
    [PLAN_COST_NORMAL_MAP] = 238.6F,   [PLAN_COST_ALPHA] = 160.1F,          [PLAN_COST_ANISOTROPY] = 0.6F,
};

const float plan_ltc_errors[2] = { 0.00053F, 0.0052F };
const float plan_ltc_flips[2] = { 0.00032F, 0.0024F };
