/* Command lines by table, on getopt_long: it splits words, this file checks names and values. */
#include "cli/arguments.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cli/nearest.h"
#include "glint.h"

enum {
    RULES_MAX = 32,
    HELP_COLUMN = 30,
    /* What getopt_long returns: 1 is an operand, as its manual says; ours lie above every letter. */
    FOUND_OPERAND = 1,
    FOUND_HELP = 256,
    FOUND_RULE
};

void assignments_free(assignments *a)
{
    for (size_t i = 0; i < a->count; ++i)
        free(a->items[i].name);
    free(a->items);
    *a = (assignments){ 0 };
}

const char *arguments_model_choice(int index)
{
    if (index == 0)
        return "auto";
    /* The layered model is what a clear coat makes of the others: its layers have the model that is chosen. */
    const glint_model model = (glint_model)(index - 1);
    return model == GLINT_MODEL_LAYERED ? NULL : glint_model_name(model);
}

static int wrong(const argument_syntax *syntax, const char *format, va_list list)
{
    fprintf(stderr, "%s: ", syntax->command);
    vfprintf(stderr, format, list);
    fprintf(stderr, "\nTry '%s --help'.\n", syntax->command);
    return 2;
}

int arguments_wrong(const argument_syntax *syntax, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int code = wrong(syntax, format, list);
    va_end(list);
    return code;
}

static bool refuse(const argument_syntax *syntax, const char *format, ...) __attribute__((format(printf, 2, 3)));

static bool refuse(const argument_syntax *syntax, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    wrong(syntax, format, list);
    va_end(list);
    return false;
}

/* ---- help ---- */

static void print_value_hint(FILE *out, const argument_rule *rule, size_t *width)
{
    if (rule->kind == ARGUMENT_CHOICE) {
        for (int i = 0; rule->choice(i); ++i)
            *width += (size_t)fprintf(out, "%c%s", i == 0 ? ' ' : '|', rule->choice(i));
    } else if (rule->value) {
        *width += (size_t)fprintf(out, " %s", rule->value);
    }
}

static void print_option(FILE *out, const char *name, char letter, const argument_rule *rule, const char *help)
{
    size_t width =
        letter ? (size_t)fprintf(out, "  -%c, --%s", letter, name) : (size_t)fprintf(out, "      --%s", name);
    if (rule)
        print_value_hint(out, rule, &width);
    if (width + 2 > HELP_COLUMN) {
        putc('\n', out);
        width = 0;
    }
    fprintf(out, "%*s%s\n", HELP_COLUMN - (int)width, "", help);
}

static void print_help(const argument_syntax *syntax)
{
    printf("usage: %s %s%s[options]\n\n%s\n\n", syntax->command, syntax->operands, *syntax->operands ? " " : "",
           syntax->summary);
    for (size_t i = 0; i < syntax->rule_count; ++i) {
        const argument_rule *rule = &syntax->rules[i];
        print_option(stdout, rule->name, rule->letter, rule, rule->help);
    }
    print_option(stdout, "help", 'h', NULL, "print this and exit");
}

/* ---- values ---- */

/* Decimal digits with an optional minus; strtoll alone would also take blanks, a plus and what does not fit. */
static bool scan_integer(const char **text, int64_t *value)
{
    const char *first = **text == '-' ? *text + 1 : *text;
    if (*first < '0' || *first > '9')
        return false;
    char *end;
    errno = 0;
    *value = strtoll(*text, &end, 10);
    *text = end;
    return errno == 0;
}

static bool set_integers(const argument_syntax *syntax, const argument_rule *rule, const char *text, int64_t *target)
{
    const char *rest = text;
    bool good = true;
    for (int i = 0; good && i < rule->count; ++i) {
        good = scan_integer(&rest, &target[i]) && (double)target[i] >= rule->min && (double)target[i] <= rule->max;
        if (good && i + 1 < rule->count)
            good = *rest++ == rule->separator;
    }
    if (good && *rest == '\0')
        return true;
    if (rule->count == 1)
        return refuse(syntax, "--%s '%s': expected a whole number from %.0f to %.0f", rule->name, text, rule->min,
                      rule->max);
    return refuse(syntax, "--%s '%s': expected %s, whole numbers from %.0f to %.0f", rule->name, text, rule->value,
                  rule->min, rule->max);
}

static bool set_range(const argument_syntax *syntax, const argument_rule *rule, const char *text, int64_t *target)
{
    const char *rest = text;
    bool good = scan_integer(&rest, &target[0]);
    target[1] = target[0];
    if (good && *rest == '-') {
        ++rest;
        good = scan_integer(&rest, &target[1]);
    }
    if (good && *rest == '\0' && target[0] <= target[1] && (double)target[0] >= rule->min &&
        (double)target[1] <= rule->max)
        return true;
    return refuse(syntax, "--%s '%s': expected %s, whole numbers from %.0f to %.0f, the first not above the last",
                  rule->name, text, rule->value, rule->min, rule->max);
}

static bool set_number(const argument_syntax *syntax, const argument_rule *rule, const char *text, double *target)
{
    /* strtod alone would also take leading blanks, hexadecimal, "inf" and "nan". */
    if (*text != '\0' && text[strspn(text, "+-.0123456789eE")] == '\0') {
        char *end;
        *target = strtod(text, &end);
        if (*end == '\0' && *target >= rule->min && *target <= rule->max)
            return true;
    }
    return refuse(syntax, "--%s '%s': expected a number from %g to %g", rule->name, text, rule->min, rule->max);
}

static bool set_choice(const argument_syntax *syntax, const argument_rule *rule, const char *text, int *target)
{
    char names[256] = "";
    size_t used = 0;
    nearest near = nearest_begin(text);
    for (int i = 0; rule->choice(i); ++i) {
        const char *name = rule->choice(i);
        if (strcmp(name, text) == 0) {
            *target = i;
            return true;
        }
        nearest_consider(&near, name);
        if (used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i == 0 ? "" : ", ", name);
    }
    if (near.name)
        return refuse(syntax, "--%s '%s' is unknown; did you mean '%s'? (there are: %s)", rule->name, text, near.name,
                      names);
    return refuse(syntax, "--%s '%s' is unknown; expected one of: %s", rule->name, text, names);
}

static bool add_assignment(const argument_syntax *syntax, const argument_rule *rule, const char *text,
                           assignments *target)
{
    const char *equals = strchr(text, '=');
    if (!equals || equals == text || equals[1] == '\0')
        return refuse(syntax, "--%s '%s': expected %s", rule->name, text, rule->value);
    struct assignment *items = realloc(target->items, (target->count + 1) * sizeof *items);
    if (items)
        target->items = items;
    char *name = items ? strndup(text, (size_t)(equals - text)) : NULL;
    if (!name)
        return refuse(syntax, "--%s '%s': out of memory", rule->name, text);
    items[target->count++] = (struct assignment){ .name = name, .value = equals + 1 };
    return true;
}

static bool set_value(const argument_syntax *syntax, const argument_rule *rule, const char *text, void *values)
{
    void *target = (char *)values + rule->target;
    switch (rule->kind) {
    case ARGUMENT_FLAG:
        *(bool *)target = true;
        return true;
    case ARGUMENT_TEXT:
        if (*text == '\0')
            return refuse(syntax, "--%s '': expected %s, not an empty text", rule->name, rule->value);
        *(const char **)target = text;
        return true;
    case ARGUMENT_NUMBER:
        return set_number(syntax, rule, text, target);
    case ARGUMENT_INTEGERS:
        return set_integers(syntax, rule, text, target);
    case ARGUMENT_RANGE:
        return set_range(syntax, rule, text, target);
    case ARGUMENT_CHOICE:
        return set_choice(syntax, rule, text, target);
    case ARGUMENT_ASSIGNMENT:
        return add_assignment(syntax, rule, text, target);
    }
    return false;
}

/* ---- words ---- */

typedef struct option_tables {
    struct option names[RULES_MAX + 2];
    char letters[2 * RULES_MAX + 5];
} option_tables;

/* The leading '-' makes getopt_long hand over operands in order, whatever POSIXLY_CORRECT says; ':' tells a missing
 * value from an unknown name. */
static option_tables build_tables(const argument_syntax *syntax)
{
    option_tables tables = { .letters = "-:h" };
    size_t used = strlen(tables.letters);
    for (size_t i = 0; i < syntax->rule_count; ++i) {
        const argument_rule *rule = &syntax->rules[i];
        const int has_value = rule->kind == ARGUMENT_FLAG ? no_argument : required_argument;
        tables.names[i] = (struct option){ rule->name, has_value, NULL, FOUND_RULE + (int)i };
        if (rule->letter) {
            tables.letters[used++] = rule->letter;
            if (has_value == required_argument)
                tables.letters[used++] = ':';
        }
    }
    tables.names[syntax->rule_count] = (struct option){ "help", no_argument, NULL, FOUND_HELP };
    return tables;
}

static const argument_rule *rule_of(const argument_syntax *syntax, int found)
{
    if (found >= FOUND_RULE)
        return &syntax->rules[found - FOUND_RULE];
    if (found == FOUND_HELP)
        return NULL;
    for (size_t i = 0; i < syntax->rule_count; ++i)
        if (syntax->rules[i].letter == found)
            return &syntax->rules[i];
    return NULL;
}

/* The word that getopt_long has just read an option from: "--size=8x8", or "--size" with its value in the next word. */
static const char *word_read(char **argv)
{
    const bool value_is_a_word = optarg && optarg == argv[optind - 1];
    return argv[optind - (value_is_a_word ? 2 : 1)];
}

static bool abbreviated(const char *word, const char *name)
{
    return strncmp(word, "--", 2) == 0 && strcspn(word + 2, "=") != strlen(name);
}

/* A name that begins a known one is nearest to that one, however much is left out. */
static bool refuse_unknown(const argument_syntax *syntax, const char *word)
{
    char name[128];
    const size_t length = strcspn(word + 2, "=");
    snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1), word + 2);
    nearest near = nearest_begin(name);
    for (size_t i = 0; i < syntax->rule_count; ++i) {
        const char *known = syntax->rules[i].name;
        if (length > 0 && strncmp(known, name, length) == 0)
            near = (nearest){ .wanted = name, .name = known, .distance = 0 };
        nearest_consider(&near, known);
    }
    if (near.name)
        return refuse(syntax, "unknown option '--%s'; did you mean '--%s'?", name, near.name);
    return refuse(syntax, "unknown option '--%s'", name);
}

static bool refuse_word(const argument_syntax *syntax, int found, char **argv)
{
    if (optopt == 0)
        return refuse_unknown(syntax, argv[optind - 1]);
    const argument_rule *rule = rule_of(syntax, optopt);
    if (found == ':')
        return refuse(syntax, "--%s needs a value: %s", rule->name, rule->value ? rule->value : "a name");
    if (optopt < FOUND_HELP)
        return refuse(syntax, "unknown option '-%c'", optopt);
    return refuse(syntax, "--%s takes no value: '%s'", rule ? rule->name : "help", argv[optind - 1]);
}

static bool add_operand(const argument_syntax *syntax, const char *text, const char **operands, int *count)
{
    if (*count == syntax->operands_max) {
        if (syntax->operands_max == 0)
            return refuse(syntax, "unexpected '%s': no file or name is expected here", text);
        return refuse(syntax, "unexpected '%s' after '%s'", text, operands[*count - 1]);
    }
    if (*text == '\0')
        return refuse(syntax, "an empty text stands where %s is expected", syntax->operands);
    operands[(*count)++] = text;
    return true;
}

static bool take_option(const argument_syntax *syntax, int found, char **argv, void *values)
{
    const argument_rule *rule = rule_of(syntax, found);
    if (abbreviated(word_read(argv), rule->name))
        return refuse_unknown(syntax, word_read(argv));
    return set_value(syntax, rule, optarg, values);
}

arguments_result arguments_parse(const argument_syntax *syntax, int argc, char **argv, void *values,
                                 const char **operands)
{
    const option_tables tables = build_tables(syntax);
    int operand_count = 0, found;
    for (int i = 0; i < syntax->operands_max; ++i)
        operands[i] = NULL;
    opterr = 0;
    optind = 0; /* GNU: start afresh */
    while ((found = getopt_long(argc, argv, tables.letters, tables.names, NULL)) != -1) {
        bool good = true;
        if (found == 'h' || found == FOUND_HELP) {
            print_help(syntax);
            return ARGUMENTS_HELP;
        }
        if (found == '?' || found == ':')
            good = refuse_word(syntax, found, argv);
        else if (found == FOUND_OPERAND)
            good = add_operand(syntax, optarg, operands, &operand_count);
        else
            good = take_option(syntax, found, argv, values);
        if (!good)
            return ARGUMENTS_WRONG;
    }
    for (; optind < argc; ++optind)
        if (!add_operand(syntax, argv[optind], operands, &operand_count))
            return ARGUMENTS_WRONG;
    if (operand_count < syntax->operands_min) {
        arguments_wrong(syntax, "%s is missing", syntax->operands);
        return ARGUMENTS_WRONG;
    }
    return ARGUMENTS_OK;
}
