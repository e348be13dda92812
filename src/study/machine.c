/* What machine a study ran on, as far as it says so itself. */
#include "study/machine.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ", X" where Linux on x86 has a line "model name : X", else nothing. */
static void add_name(char *name, size_t size)
{
    char line[256];
    FILE *const from = fopen("/proc/cpuinfo", "r");
    while (from && name[0] == '\0' && fgets(line, sizeof line, from)) {
        const char *const colon = strncmp(line, "model name", 10) == 0 ? strchr(line, ':') : NULL;
        if (colon)
            snprintf(name, size, ", %.*s", (int)strcspn(colon + 1 + strspn(colon + 1, " "), "\n"),
                     colon + 1 + strspn(colon + 1, " "));
    }
    if (from)
        fclose(from);
}

void machine_describe(char *text, size_t size)
{
    char name[200] = "";
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    add_name(name, sizeof name);
    snprintf(text, size, "%ld processor%s%s", processors, processors == 1 ? "" : "s", name);
}
