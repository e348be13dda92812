/* What things cost and how far they are off. Measured, and written, by tests/bench/costs.c:
 *
 *     ./dev bench costs && build/release/bench/costs > src/plan/cost_table.c && ./dev format
 */
#include "plan/cost_table.h"

const float plan_costs[PLAN_COST_COUNT] = {
    [PLAN_COST_CAMERA_RAY] = 329.8F,   [PLAN_COST_BOUNCE_RAY] = 370.7F,     [PLAN_COST_SHADOW_RAY] = 73.5F,
    [PLAN_COST_SMOOTH] = 67.5F,        [PLAN_COST_COUNTED] = 224.7F,        [PLAN_COST_COUNTED_COLORS] = 299.0F,
    [PLAN_COST_DRAWN] = 205.8F,        [PLAN_COST_FADED] = 81.7F,           [PLAN_COST_DICTIONARY] = 2297.6F,
    [PLAN_COST_EXAMPLE] = 4232.7F,     [PLAN_COST_EXPLICIT_FACET] = 465.0F, [PLAN_COST_LTC] = 163.0F,
    [PLAN_COST_QUADRATURE] = 13108.1F, [PLAN_COST_COAT] = 967.4F,           [PLAN_COST_TEXTURE] = 223.4F,
    [PLAN_COST_NORMAL_MAP] = 257.2F,   [PLAN_COST_ALPHA] = 163.5F,          [PLAN_COST_ANISOTROPY] = 8.1F,
};

const float plan_ltc_errors[2] = { 0.00035F, 0.003F };
const float plan_ltc_flips[2] = { 0.00026F, 0.0015F };
