/* Gives the bytes of the fuzzer a file name, since the readers read files. */
#ifndef FUZZ_FILE_H
#define FUZZ_FILE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* Writes the bytes to a file called name in a folder of this process alone, and returns its path. */
static inline const char *fuzz_file(const char *name, const uint8_t *data, size_t size)
{
    static char folder[] = "/tmp/glint-fuzz-XXXXXX", path[128];
    if (path[0] == '\0') {
        if (!mkdtemp(folder))
            abort();
        snprintf(path, sizeof path, "%s/%s", folder, name);
    }
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file) != 0)
        abort();
    return path;
}

#endif
