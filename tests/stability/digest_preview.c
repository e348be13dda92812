/* The hashes of what the previewer computes, part by part. It asks libm, which differs from machine to machine and not
 * from compiler to compiler. */
#include <stdio.h>
#include <string.h>

#include "digest_preview.h"
#include "exact_inputs.h"
#include "preview_sweep.h"

static void hash_numbers(void *user, const char *what, const double *numbers, size_t count)
{
    uint64_t *const hash = user;
    (void)what;
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        *hash = (*hash ^ bits) * 0x100000001b3U;
    }
}

void digest_print_preview(void)
{
    uint64_t hash = HASH_START;
    preview_sweep(20000, 0, hash_numbers, &hash);
    printf("preview      %016llx\n", (unsigned long long)hash);
}
