/* glint export: finds the format and lets it do its work. */
#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "cli/nearest.h"

static const struct format {
    const char *name, *summary;
    int (*run)(int argc, char **argv);
} formats[] = {
    { "gltf", "a glTF 2.0 file with the extension GLINT_materials_glint", command_export_gltf },
    { "povray", "a folder that POV-Ray 3.7 renders", command_export_povray },
};

enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

static void print_help(FILE *out)
{
    fputs("usage: glint export FORMAT SCENE -o OUT [options]\n\nWrites a scene for other programs.\n\n", out);
    for (int i = 0; i < FORMAT_COUNT; ++i)
        fprintf(out, "  %-12s%s\n", formats[i].name, formats[i].summary);
    fputs("\n'glint export FORMAT --help' lists the options of a format.\n", out);
}

static int refuse_unknown(const char *name)
{
    nearest near = nearest_begin(name);
    for (int i = 0; i < FORMAT_COUNT; ++i)
        nearest_consider(&near, formats[i].name);
    fprintf(stderr, "glint export: unknown format '%s'", name);
    if (near.name)
        fprintf(stderr, "; did you mean '%s'?", near.name);
    fputs("\nTry 'glint export --help'.\n", stderr);
    return COMMAND_WRONG_USAGE;
}

int command_export(int argc, char **argv)
{
    if (argc < 2) {
        print_help(stderr);
        return COMMAND_WRONG_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        print_help(stdout);
        return COMMAND_DONE;
    }
    for (int i = 0; i < FORMAT_COUNT; ++i)
        if (strcmp(argv[1], formats[i].name) == 0)
            return formats[i].run(argc - 1, argv + 1);
    return refuse_unknown(argv[1]);
}
