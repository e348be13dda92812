/* What the contract tests have shown of every model, as rows of the table in docs/contract.md.
 *
 * Each row is a file in the folder that the environment names; table.sh puts them together. A test that fails leaves
 * none.
 */
#ifndef TESTS_CONTRACT_H
#define TESTS_CONTRACT_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "configurations.h"

typedef struct contract_exception {
    glint_model model;
    const char *instead; /* what the table says in place of "yes" */
} contract_exception;

static inline FILE *contract_open(const char *name)
{
    const char *folder = getenv("GLINT_CONTRACT");
    char path[4096];
    snprintf(path, sizeof(path), "%s/%s", folder ? folder : "", name);
    return folder ? fopen(path, "w") : NULL;
}

/* Row number `place`: the promise was kept by every model, but for the exceptions (the last one has no text). test:
 * where. */
static inline void contract_kept(int place, const char *promise, const char *test, const contract_exception *except)
{
    char name[32];
    snprintf(name, sizeof(name), "%02d", place);
    FILE *file = contract_open("head");
    if (!file)
        return;
    fputs("| Promise |", file);
    for (size_t i = 0; i < sizeof(MODELS) / sizeof(MODELS[0]); i++)
        fprintf(file, " %s |", glint_model_name(MODELS[i].model));
    fputs(" Test |\n|---|", file);
    for (size_t i = 0; i < sizeof(MODELS) / sizeof(MODELS[0]); i++)
        fputs("---|", file);
    fputs("---|\n", file);
    fclose(file);
    file = contract_open(name);
    if (!file)
        fail_msg("cannot write row %d of the contract", place);
    fprintf(file, "| %s |", promise);
    for (size_t i = 0; i < sizeof(MODELS) / sizeof(MODELS[0]); i++) {
        const char *cell = "yes";
        for (const contract_exception *e = except; e && e->instead; e++)
            if (e->model == MODELS[i].model)
                cell = e->instead;
        fprintf(file, " %s |", cell);
    }
    fprintf(file, " `%s` |\n", test);
    fclose(file);
}

#endif
