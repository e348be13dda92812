/* Edit distance by rows, with swaps of neighbours (restricted Damerau-Levenshtein; Damerau 1964). */
#include "scene/edit_distance.h"

#include <string.h>

enum { LONGEST_NAME = 64 };

static size_t min3(size_t a, size_t b, size_t c)
{
    const size_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}

size_t edit_distance(const char *a, const char *b)
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
            const size_t replaced = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = min3(above[j] + 1, row[j - 1] + 1, above[j - 1] + replaced);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && above2[j - 2] + 1 < row[j])
                row[j] = above2[j - 2] + 1;
        }
    }
    return rows[a_length % 3][b_length];
}

size_t edit_distance_near(const char *wanted)
{
    const size_t third = strlen(wanted) / 3;
    if (third < 2)
        return 2;
    return third < LONGEST_NAME ? third : LONGEST_NAME;
}
