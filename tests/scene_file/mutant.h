/* Files that differ from a good one by a few bytes: the parts that tests of hostile input share. Mutants follow from
 * their number, so that a failure can be repeated. */
#ifndef SCENE_FILE_MUTANT_H
#define SCENE_FILE_MUTANT_H

#include <stddef.h>
#include <stdint.h>

typedef struct bytes {
    uint8_t *data; /* to be freed */
    size_t size;
} bytes;

/* Fails the test where the file cannot be read. */
bytes bytes_read(const char *path);

/* Replaces length bytes at a place by others. */
bytes bytes_splice(bytes from, size_t at, size_t length, const void *by, size_t by_size);

/* A random number below a limit; mutant_start sets where they come from. */
void mutant_start(uint64_t number);
size_t mutant_below(size_t limit);

/* One to three changes, one after another. */
bytes mutant_of(bytes seed, unsigned number, bytes (*change)(bytes));

/* Of this thread. */
double cpu_seconds(void);

#endif
