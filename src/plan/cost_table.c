/* What things cost and how far they are off. Measured, and written, by tests/bench/costs.c:
 *
 *     ./dev bench costs && build/release/bench/costs > src/plan/cost_table.c && ./dev format
 */
#include "plan/cost_table.h"

const float plan_costs[PLAN_COST_COUNT] = {
    [PLAN_COST_CAMERA_RAY] = 168.8F, [PLAN_COST_BOUNCE_RAY] = 350.1F,     [PLAN_COST_SHADOW_RAY] = 36.7F,
    [PLAN_COST_SMOOTH] = 26.3F,      [PLAN_COST_COUNTED] = 63.0F,         [PLAN_COST_COUNTED_COLORS] = 88.2F,
    [PLAN_COST_DRAWN] = 47.9F,       [PLAN_COST_FADED] = 32.4F,           [PLAN_COST_DICTIONARY] = 2333.5F,
    [PLAN_COST_EXAMPLE] = 4256.2F,   [PLAN_COST_EXPLICIT_FACET] = 450.9F, [PLAN_COST_POINTS] = 82.6F,
    [PLAN_COST_LTC] = 793.7F,        [PLAN_COST_QUADRATURE] = 11350.9F,   [PLAN_COST_COAT] = 238.0F,
    [PLAN_COST_TEXTURE] = 201.5F,    [PLAN_COST_NORMAL_MAP] = 239.8F,     [PLAN_COST_ALPHA] = 166.0F,
    [PLAN_COST_ANISOTROPY] = 5.7F,
};

const float plan_ltc_errors[2] = { 0.00096F, 0.0052F };
const float plan_ltc_flips[2] = { 0.00036F, 0.0022F };
