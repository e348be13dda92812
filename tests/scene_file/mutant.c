/* Files that differ from a good one by a few bytes. */
#include "mutant.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

static uint64_t random_state;

void mutant_start(uint64_t number)
{
    random_state = number;
}

/* Marsaglia's xorshift64. */
size_t mutant_below(size_t limit)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (size_t)(random_state % limit);
}

bytes bytes_read(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s cannot be opened", path);
    fseek(file, 0, SEEK_END);
    bytes b = { NULL, (size_t)ftell(file) };
    rewind(file);
    b.data = malloc(b.size + 1);
    assert_non_null(b.data);
    assert_int_equal(fread(b.data, 1, b.size, file), b.size);
    fclose(file);
    return b;
}

bytes bytes_splice(bytes from, size_t at, size_t length, const void *by, size_t by_size)
{
    bytes out = { malloc(from.size - length + by_size + 1), from.size - length + by_size };
    assert_non_null(out.data);
    memcpy(out.data, from.data, at);
    memcpy(out.data + at, by, by_size);
    memcpy(out.data + at + by_size, from.data + at + length, from.size - at - length);
    return out;
}

bytes mutant_of(bytes seed, unsigned number, bytes (*change)(bytes))
{
    mutant_start(0x9E3779B97F4A7C15U * ((uint64_t)number + 1));
    bytes mutant = change(seed);
    for (size_t more = mutant_below(3); more > 0 && mutant.size > 1; more--) {
        const bytes next = change(mutant);
        free(mutant.data);
        mutant = next;
    }
    return mutant;
}

double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
