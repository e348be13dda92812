/* Written by tests/bench/costs.c: build/release/tests/bench_costs > src/plan/cost_table.c */
#include "plan/cost_table.h"

const float plan_costs[PLAN_COST_COUNT] = {
    [PLAN_COST_CAMERA_RAY] = 2000.0F,  [PLAN_COST_BOUNCE_RAY] = 2000.0F,   [PLAN_COST_SHADOW_RAY] = 500.0F,
    [PLAN_COST_SMOOTH] = 150.0F,       [PLAN_COST_COUNTED] = 500.0F,       [PLAN_COST_COUNTED_COLORS] = 900.0F,
    [PLAN_COST_DRAWN] = 300.0F,        [PLAN_COST_FADED] = 160.0F,         [PLAN_COST_DICTIONARY] = 3000.0F,
    [PLAN_COST_EXAMPLE] = 5000.0F,     [PLAN_COST_EXPLICIT_FACET] = 50.0F, [PLAN_COST_LTC] = 1500.0F,
    [PLAN_COST_QUADRATURE] = 20000.0F, [PLAN_COST_COAT] = 400.0F,          [PLAN_COST_TEXTURE] = 300.0F,
    [PLAN_COST_NORMAL_MAP] = 400.0F,   [PLAN_COST_ALPHA] = 500.0F,         [PLAN_COST_ANISOTROPY] = 50.0F,
};

const float plan_ltc_errors[2] = { 0.01F, 0.02F };
