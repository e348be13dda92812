/* One query of glint eval: a line of fourteen numbers. */
#ifndef CLI_EVAL_QUERY_H
#define CLI_EVAL_QUERY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "glint.h"
#include "scene/report.h"

typedef struct eval_query {
    glint_footprint footprint;
    float wo[3], wi[3]; /* unit */
    glint_light light;
} eval_query;

typedef enum eval_query_result {
    EVAL_QUERY_READ,
    EVAL_QUERY_END,  /* of the input */
    EVAL_QUERY_WRONG /* the report says what */
} eval_query_result;

/* Reads up to the next query. Blank lines are skipped, and so is everything from '#' to the end of a line. Columns are
 * parted by white space: u v  dudx dudy dvdx dvdy  wox woy woz  wix wiy wiz  solid_angle seed.
 *
 * line_number  of the last line read, from 1; start with 0
 */
eval_query_result eval_query_read(FILE *in, size_t *line_number, eval_query *query, report *r);

#endif
