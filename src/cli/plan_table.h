/* The plan as a table for people. */
#ifndef CLI_PLAN_TABLE_H
#define CLI_PLAN_TABLE_H

#include "cli/render.h"

/* On standard output: what is done and what it costs; with --all every decision in a row of its own. */
void plan_print_table(const glint_plan *plan, const scene *s, const render_values *v);

#endif
