/* pays_nothing MODULE KIND RENDERER [MODULE KIND RENDERER]...: has each module render in turn, see pays_nothing.c. In
 * one process, since to start one takes longer than to render. */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

typedef int render(const char *kind, const char *renderer);

int main(int argc, char **argv)
{
    int failed = argc < 4 || argc % 3 != 1;
    for (int i = 1; !failed && i < argc; i += 3) {
        void *const module = dlopen(argv[i], RTLD_NOW | RTLD_LOCAL);
        void *const symbol = module != NULL ? dlsym(module, "pays_nothing") : NULL;
        render *function = NULL;
        memcpy(&function, &symbol, sizeof function); /* ISO C has no cast for it, POSIX means it */
        failed = function == NULL || function(argv[i + 1], argv[i + 2]) != 0;
        if (failed)
            fprintf(stderr, "pays_nothing: %s %s %s failed%s%s\n", argv[i], argv[i + 1], argv[i + 2],
                    symbol == NULL ? ": " : "", symbol == NULL ? dlerror() : "");
    }
    return failed;
}
