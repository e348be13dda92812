/* One query of glint eval: a line of fourteen numbers, each checked for its range. */
#include "cli/eval_query.h"

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Fourteen numbers of twenty-five characters take 350; a longer line is no query. */
enum { LINE_SIZE = 4096, COLUMN_COUNT = 14, COLUMN_WO = 6, COLUMN_WI = 9, COLUMN_LIGHT = 12, COLUMN_SEED = 13 };

static const struct column {
    const char *name, *expected;
    double min, max;
    bool whole;
} columns[COLUMN_COUNT] = {
    { "u", "a finite number", -DBL_MAX, DBL_MAX, false },
    { "v", "a finite number", -DBL_MAX, DBL_MAX, false },
    { "dudx", "a finite float", -(double)FLT_MAX, (double)FLT_MAX, false },
    { "dudy", "a finite float", -(double)FLT_MAX, (double)FLT_MAX, false },
    { "dvdx", "a finite float", -(double)FLT_MAX, (double)FLT_MAX, false },
    { "dvdy", "a finite float", -(double)FLT_MAX, (double)FLT_MAX, false },
    { "wox", "a number from -1 to 1", -1.001, 1.001, false },
    { "woy", "a number from -1 to 1", -1.001, 1.001, false },
    { "woz", "a number from -1 to 1", -1.001, 1.001, false },
    { "wix", "a number from -1 to 1", -1.001, 1.001, false },
    { "wiy", "a number from -1 to 1", -1.001, 1.001, false },
    { "wiz", "a number from -1 to 1", -1.001, 1.001, false },
    /* 2 pi rounded up to float is 6.2831855. */
    { "solid_angle", "a number from 0 to 2 pi", 0.0, 6.2831855, false },
    { "seed", "a whole number from 0 to 4294967295", 0.0, 4294967295.0, true },
};

/* A direction as people type it has rounded digits; one further off is a mistake, not rounding. */
static const double unit_tolerance = 1e-3;

/* Reads a line without its end. False at the end of the input, and where the line cannot be: then the report says why.
 */
static bool read_line(FILE *in, char *line, size_t *line_number, report *r)
{
    size_t length = 0;
    int c;
    errno = 0;
    while ((c = getc(in)) != EOF && c != '\n') {
        if (c == '\0')
            return report_error(r, "standard input: line %zu: found a zero byte, expected text", *line_number + 1);
        if (length + 1 == LINE_SIZE)
            return report_error(r, "standard input: line %zu: longer than %d characters, expected %d numbers",
                                *line_number + 1, LINE_SIZE - 1, COLUMN_COUNT);
        line[length++] = (char)c;
    }
    if (ferror(in))
        return report_error(r, "standard input: line %zu: %s", *line_number + 1, strerror(errno));
    if (c == EOF && length == 0)
        return false;
    line[length] = '\0';
    line[strcspn(line, "#")] = '\0';
    ++*line_number;
    return true;
}

/* The word as a message may show it: short, and without control characters. */
static void printable(const char *word, char *shown, size_t size)
{
    size_t i = 0;
    for (; word[i] && i + 1 < size; ++i)
        shown[i] = isprint((unsigned char)word[i]) ? word[i] : '?';
    shown[i] = '\0';
}

static bool refuse(size_t line_number, int column, const char *word, report *r)
{
    char shown[40];
    printable(word, shown, sizeof shown);
    return report_error(r, "standard input: line %zu, column %d (%s): found '%s', expected %s", line_number, column + 1,
                        columns[column].name, shown, columns[column].expected);
}

static bool parse_columns(char *line, size_t line_number, double *values, report *r)
{
    static const char blanks[] = " \t\r\v\f";
    int count = 0;
    char *rest = line;
    for (char *word; (word = strtok_r(rest, blanks, &rest)) != NULL; ++count) {
        if (count == COLUMN_COUNT)
            return report_error(r, "standard input: line %zu: more than %d numbers", line_number, COLUMN_COUNT);
        const struct column *column = &columns[count];
        char *end;
        const double value = strtod(word, &end);
        if (end == word || *end != '\0' || !(value >= column->min && value <= column->max) ||
            (column->whole && value != floor(value)))
            return refuse(line_number, count, word, r);
        values[count] = value;
    }
    if (count == COLUMN_COUNT)
        return true;
    return report_error(r, "standard input: line %zu, column %d (%s): the line ends, expected %d numbers", line_number,
                        count + 1, columns[count].name, COLUMN_COUNT);
}

static bool parse_direction(const double *values, int column, size_t line_number, float *direction, report *r)
{
    const double *d = values + column;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(fabs(length - 1.0) <= unit_tolerance))
        return report_error(r,
                            "standard input: line %zu, columns %d to %d (%s %s %s): a direction of length %.6g, "
                            "expected 1 within %g",
                            line_number, column + 1, column + 3, columns[column].name, columns[column + 1].name,
                            columns[column + 2].name, length, unit_tolerance);
    for (int i = 0; i < 3; ++i)
        direction[i] = (float)(d[i] / length);
    return true;
}

static bool is_blank(const char *line)
{
    return line[strspn(line, " \t\r\v\f")] == '\0';
}

eval_query_result eval_query_read(FILE *in, size_t *line_number, eval_query *query, report *r)
{
    char line[LINE_SIZE];
    do {
        if (!read_line(in, line, line_number, r))
            return r->error[0] ? EVAL_QUERY_WRONG : EVAL_QUERY_END;
    } while (is_blank(line));
    double values[COLUMN_COUNT];
    if (!parse_columns(line, *line_number, values, r) ||
        !parse_direction(values, COLUMN_WO, *line_number, query->wo, r) ||
        !parse_direction(values, COLUMN_WI, *line_number, query->wi, r))
        return EVAL_QUERY_WRONG;
    query->footprint = (glint_footprint){
        .u = values[0],
        .v = values[1],
        .dudx = (float)values[2],
        .dudy = (float)values[3],
        .dvdx = (float)values[4],
        .dvdy = (float)values[5],
        .seed = (uint32_t)values[COLUMN_SEED],
    };
    query->light = (glint_light){ .kind = GLINT_LIGHT_CAP, .solid_angle_sr = (float)values[COLUMN_LIGHT] };
    return EVAL_QUERY_READ;
}
