/* The known name that a mistyped one most likely meant: the fewest letters added, dropped, replaced or swapped. */
#include "cli/nearest.h"

#include <string.h>

enum { LONGEST_NAME = 64 };

static size_t min3(size_t a, size_t b, size_t c)
{
    const size_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}

/* Restricted Damerau-Levenshtein distance by rows: a swap of two neighbours counts as one change. */
static size_t edit_distance(const char *a, const char *b)
{
    const size_t a_length = strlen(a), b_length = strlen(b);
    if (a_length > LONGEST_NAME || b_length > LONGEST_NAME)
        return strcmp(a, b) == 0 ? 0 : LONGEST_NAME + 1;
    size_t rows[3][LONGEST_NAME + 1];
    for (size_t j = 0; j <= b_length; ++j)
        rows[0][j] = j;
    for (size_t i = 1; i <= a_length; ++i) {
        const size_t *above2 = rows[(i + 1) % 3], *above = rows[(i + 2) % 3];
        size_t *row = rows[i % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; ++j) {
            const size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = min3(above[j] + 1, row[j - 1] + 1, above[j - 1] + changed);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && above2[j - 2] + 1 < row[j])
                row[j] = above2[j - 2] + 1;
        }
    }
    return rows[a_length % 3][b_length];
}

nearest nearest_begin(const char *wanted)
{
    const size_t third = strlen(wanted) / 3;
    const size_t allowed = third > 2 ? third : 2;
    return (nearest){ .wanted = wanted, .name = NULL, .distance = allowed + 1 };
}

void nearest_consider(nearest *n, const char *candidate)
{
    const size_t distance = edit_distance(n->wanted, candidate);
    if (distance < n->distance) {
        n->name = candidate;
        n->distance = distance;
    }
}
