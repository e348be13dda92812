/* What things cost and how far they are off. Measured, and written, by tests/bench/costs.c:
 *
 *     ./dev bench costs && build/release/bench/costs > src/plan/cost_table.c && ./dev format
 */
#include "plan/cost_table.h"

const float plan_costs[PLAN_COST_COUNT] = {
    [PLAN_COST_CAMERA_RAY] = 390.0F,   [PLAN_COST_BOUNCE_RAY] = 408.1F,     [PLAN_COST_SHADOW_RAY] = 99.8F,
    [PLAN_COST_SMOOTH] = 64.9F,        [PLAN_COST_COUNTED] = 222.9F,        [PLAN_COST_COUNTED_COLORS] = 320.4F,
    [PLAN_COST_DRAWN] = 199.3F,        [PLAN_COST_FADED] = 82.5F,           [PLAN_COST_DICTIONARY] = 2289.5F,
    [PLAN_COST_EXAMPLE] = 5399.8F,     [PLAN_COST_EXPLICIT_FACET] = 458.9F, [PLAN_COST_LTC] = 409.5F,
    [PLAN_COST_QUADRATURE] = 12910.6F, [PLAN_COST_COAT] = 969.5F,           [PLAN_COST_TEXTURE] = 210.5F,
    [PLAN_COST_NORMAL_MAP] = 265.1F,   [PLAN_COST_ALPHA] = 176.1F,          [PLAN_COST_ANISOTROPY] = 4.2F,
};

const float plan_ltc_errors[2] = { 0.00035F, 0.003F };
const float plan_ltc_flips[2] = { 0.00026F, 0.0015F };
