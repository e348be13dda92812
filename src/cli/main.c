/* The glint command: finds the subcommand and lets it do its work. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "cli/nearest.h"
#include "glint.h"

static const struct subcommand {
    const char *name, *summary;
    int (*run)(int argc, char **argv);
} subcommands[] = {
    { "render", "render a glTF scene to OpenEXR or PNG", command_render },
    { "merge", "put the tiles of a picture together", command_merge },
    { "plan", "say what a render would do, leave out and cost", command_plan },
    { "compare", "hold a picture against another, with a report", command_compare },
    { "eval", "evaluate a material for queries on standard input", command_eval },
    { "example", "write a built-in normal map of the example model", command_example },
    { "export", "write a scene for other programs: glTF, POV-Ray", command_export },
    { "inspect", "say what is in a glTF scene", command_inspect },
    { "validate", "check the glint materials of glTF files and presets", command_validate },
    { "materials", "list the material presets, or show one", command_materials },
    { "study", "measure what accuracy costs: tables, figures, a page", command_study },
};

enum { SUBCOMMAND_COUNT = sizeof subcommands / sizeof subcommands[0] };

static void print_help(FILE *out)
{
    fputs("usage: glint COMMAND [options]\n\nRenders glints: the sparkle of discrete microfacets.\n\n", out);
    for (int i = 0; i < SUBCOMMAND_COUNT; ++i)
        fprintf(out, "  %-12s%s\n", subcommands[i].name, subcommands[i].summary);
    fputs("\n  --version   print the version and exit\n  --help      print this and exit\n"
          "\n'glint COMMAND --help' lists the options of a command.\n",
          out);
}

static int refuse_unknown(const char *name)
{
    nearest near = nearest_begin(name);
    for (int i = 0; i < SUBCOMMAND_COUNT; ++i)
        nearest_consider(&near, subcommands[i].name);
    const char *what = name[0] == '-' ? "option" : "command";
    if (near.name)
        fprintf(stderr, "glint: unknown %s '%s'; did you mean '%s'?\n", what, name, near.name);
    else
        fprintf(stderr, "glint: unknown %s '%s'\n", what, name);
    fputs("Try 'glint --help'.\n", stderr);
    return COMMAND_WRONG_USAGE;
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        print_help(stderr);
        return COMMAND_WRONG_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        print_help(stdout);
        return COMMAND_DONE;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("glint %s\n", glint_version());
        return COMMAND_DONE;
    }
    for (int i = 0; i < SUBCOMMAND_COUNT; ++i)
        if (strcmp(argv[1], subcommands[i].name) == 0)
            return subcommands[i].run(argc - 1, argv + 1);
    return refuse_unknown(argv[1]);
}

int main(int argc, char **argv)
{
    /* A limit on file sizes shall end in an error that says so, as a full disk does. */
    signal(SIGXFSZ, SIG_IGN);
    const int code = run(argc, argv);
    /* A full disk behind standard output shows here at the latest. */
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout))
        return code;
    fprintf(stderr, "glint: standard output: %s\n", errno ? strerror(errno) : "could not be written");
    return code == COMMAND_DONE ? COMMAND_BAD_INPUT : code;
}
