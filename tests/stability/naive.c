/* Prints the table of docs/stability.md; page.sh holds the page to it. */
#include "naive.h"

#include <stdio.h>

static void number(char *text, size_t size, double x)
{
    if (isnan(x))
        snprintf(text, size, "NaN");
    else if (x == -(double)INFINITY)
        snprintf(text, size, "0 to 1");
    else if (isinf(x))
        snprintf(text, size, "infinite");
    else
        snprintf(text, size, "%.6g", x + 0.0); /* no -0 */
}

void naive_print(const naive_row *row)
{
    char number_of[3][32];
    number(number_of[0], sizeof(number_of[0]), row->naive);
    number(number_of[1], sizeof(number_of[1]), (double)row->truth);
    number(number_of[2], sizeof(number_of[2]), row->ours);
    printf("| %s | %s | **%s** | %s | %s | %s | %s | `%s` |\n", row->what, row->formula, number_of[0], number_of[1],
           number_of[2], row->done, row->bound, row->test);
}

static void section(const char *title, void (*rows)(void))
{
    printf("\n### %s\n\n| Case | Formula that one writes first | It gives | True | libglint | What is done | Error "
           "bound | "
           "Test |\n|---|---|---|---|---|---|---|---|\n",
           title);
    rows();
}

int main(void)
{
    section("Facets", naive_facets);
    section("Counts", naive_counts);
    section("Places", naive_places);
    section("Lights", naive_lights);
    return 0;
}
