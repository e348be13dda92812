/* Wrong usage ends with exit code 2 before anything is read, names what was found and says what was expected. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "glint.h"
#include "run_glint.h"

static void no_command_prints_the_help_as_an_error(void **state)
{
    (void)state;
    const outcome o = glint_run_list(NULL, (const char *const[]){ "glint", NULL });
    assert_refused(o, 2, "usage: glint COMMAND");
}

static void unknown_command_names_the_nearest(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "rendr"), 2, "unknown command 'rendr'; did you mean 'render'?");
    assert_refused(glint_run(NULL, "xyzzy"), 2, "unknown command 'xyzzy'\n");
    assert_refused(glint_run(NULL, "--versoin"), 2, "unknown option '--versoin'");
}

static void help_goes_to_standard_output(void **state)
{
    (void)state;
    static const char *const commands[] = { "render", "eval", "inspect", "materials" };
    outcome o = glint_run(NULL, "--help");
    assert_exit(&o, 0);
    assert_string_equal(o.err, "");
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; ++i) {
        assert_says(o.out, commands[i]);
        outcome one = glint_run(NULL, commands[i], "--help");
        assert_exit(&one, 0);
        assert_string_equal(one.err, "");
        assert_says(one.out, "usage: glint ");
        assert_says(one.out, "--json");
        outcome_free(&one);
    }
    outcome_free(&o);
}

static void version_is_that_of_the_library(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "--version");
    assert_exit(&o, 0);
    assert_says(o.out, glint_version());
    outcome_free(&o);
}

static void unknown_option_names_the_nearest(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "a.gltf", "--spppp", "4"), 2,
                   "unknown option '--spppp'; did you mean '--spp'?");
    assert_refused(glint_run(NULL, "render", "a.gltf", "--sise=8x8"), 2,
                   "unknown option '--sise'; did you mean '--size'?");
    assert_refused(glint_run(NULL, "render", "a.gltf", "--json", "-zx"), 2, "unknown option '-z'");
    assert_refused(glint_run(NULL, "render", "a.gltf", "--xyzzyxyzzy"), 2, "unknown option '--xyzzyxyzzy'\n");
}

static void options_of_later_versions_are_unknown(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o", "a.exr", "--multiscatter", "1"), 2, "--multiscatter");
}

/* "--s" would be --size, --spp or --seed today and another option tomorrow. */
static void abbreviated_option_is_refused_with_its_full_name(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "a.gltf", "--bounc", "1"), 2, "did you mean '--bounces'?");
    assert_refused(glint_run(NULL, "render", "a.gltf", "--bounc=1"), 2, "did you mean '--bounces'?");
    assert_refused(glint_run(NULL, "render", "a.gltf", "--s", "1"), 2, "unknown option '--s'");
}

static void missing_value_is_named(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "a.gltf", "--size"), 2, "--size needs a value: WxH");
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o"), 2, "--output needs a value");
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o", ""), 2, "--output ''");
    assert_refused(glint_run(NULL, "inspect", "a.gltf", "--json=yes"), 2, "--json takes no value");
}

/* Each value is wrong in one way: too few, too many, a rest, a blank, a sign, out of range, not a number. */
static void values_are_read_to_the_last_character(void **state)
{
    (void)state;
    static const struct {
        const char *option, *value, *expected;
    } wrong[] = {
        { "--size", "12", "WxH" },
        { "--size", "12x", "WxH" },
        { "--size", "x12", "WxH" },
        { "--size", "12x8 ", "WxH" },
        { "--size", " 12x8", "WxH" },
        { "--size", "12X8", "WxH" },
        { "--size", "12x8x4", "WxH" },
        { "--size", "0x8", "from 1 to 65536" },
        { "--size", "12x-8", "from 1 to 65536" },
        { "--size", "12x65537", "from 1 to 65536" },
        { "--size", "99999999999999999999x8", "from 1 to 65536" },
        { "--spp", "0", "from 1 to 65536" },
        { "--spp", "4.5", "a whole number" },
        { "--spp", "four", "a whole number" },
        { "--spp", "+4", "a whole number" },
        { "--spp", "0x10", "a whole number" },
        { "--seed", "-1", "from 0 to 4294967295" },
        { "--seed", "4294967296", "from 0 to 4294967295" },
        { "--seed", "18446744073709551616", "from 0 to 4294967295" },
        { "--bounces", "65", "from 0 to 64" },
        { "--threads", "1025", "from 0 to 1024" },
        { "--exposure", "nan", "a number from -64 to 64" },
        { "--exposure", "inf", "a number from -64 to 64" },
        { "--exposure", "1e999", "a number from -64 to 64" },
        { "--exposure", "0x1p3", "a number from -64 to 64" },
        { "--exposure", "1.5ev", "a number from -64 to 64" },
        { "--exposure", "", "a number from -64 to 64" },
        { "--tile", "0,0,8", "X,Y,W,H" },
        { "--tile", "0,0,8,8,8", "X,Y,W,H" },
        { "--tile", "-1,0,8,8", "X,Y,W,H" },
        { "--model", "countng", "did you mean 'counting'?" },
        { "--model", "Smooth", "did you mean 'smooth'?" },
        { "--model", "7", "auto, smooth, counting" },
        { "--material", "panel", "NAME=PRESET" },
        { "--material", "panel=", "NAME=PRESET" },
        { "--material", "=sand", "NAME=PRESET" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        outcome o = glint_run(NULL, "render", "a.gltf", "-o", "a.png", wrong[i].option, wrong[i].value);
        assert_exit(&o, 2);
        assert_says(o.err, wrong[i].option);
        assert_says(o.err, wrong[i].value);
        assert_says(o.err, wrong[i].expected);
        outcome_free(&o);
    }
}

static void output_must_be_a_picture_that_we_write(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "a.gltf"), 2, "-o OUT is missing");
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o", "a.jpg"), 2,
                   "'a.jpg': expected a name that ends in .exr or .png");
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o", ".png"), 2, "expected a name that ends in .exr or .png");
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o", "folder/"), 2,
                   "expected a name that ends in .exr or .png");
}

static void options_that_the_format_cannot_hold_are_refused(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o", "a.png", "--aov"), 2, "--aov");
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o", "a.exr", "--exposure", "0"), 2, "--exposure");
}

static void tile_must_lie_in_the_picture(void **state)
{
    (void)state;
    static const char *const outside[] = { "60,0,8,8", "0,44,8,8", "0,0,65,8", "0,0,0,8", "8,8,8,0" };
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; ++i)
        assert_refused(glint_run(NULL, "render", "a.gltf", "-o", "a.exr", "--size", "64x48", "--tile", outside[i]), 2,
                       "expected a part of the 64x48 pixels");
}

static void operands_are_counted(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "-o", "a.exr"), 2, "SCENE");
    assert_refused(glint_run(NULL, "render", "a.gltf", "b.gltf", "-o", "a.exr"), 2,
                   "unexpected 'b.gltf' after 'a.gltf'");
    assert_refused(glint_run(NULL, "render", "a.gltf", "-o", "a.exr", "--", "a.gltf"), 2, "unexpected 'a.gltf'");
    assert_refused(glint_run(NULL, "inspect"), 2, "FILE is missing");
    assert_refused(glint_run(NULL, "inspect", ""), 2, "an empty text");
    assert_refused(glint_run(NULL, "materials", "sand", "snow"), 2, "unexpected 'snow'");
    assert_refused(glint_run(NULL, "eval", "sand"), 2, "unexpected 'sand'");
    assert_refused(glint_run(NULL, "eval"), 2, "--material PRESET is missing");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_command_prints_the_help_as_an_error),
        cmocka_unit_test(unknown_command_names_the_nearest),
        cmocka_unit_test(help_goes_to_standard_output),
        cmocka_unit_test(version_is_that_of_the_library),
        cmocka_unit_test(unknown_option_names_the_nearest),
        cmocka_unit_test(options_of_later_versions_are_unknown),
        cmocka_unit_test(abbreviated_option_is_refused_with_its_full_name),
        cmocka_unit_test(missing_value_is_named),
        cmocka_unit_test(values_are_read_to_the_last_character),
        cmocka_unit_test(output_must_be_a_picture_that_we_write),
        cmocka_unit_test(options_that_the_format_cannot_hold_are_refused),
        cmocka_unit_test(tile_must_lie_in_the_picture),
        cmocka_unit_test(operands_are_counted),
    };
    return cmocka_run_group_tests_name("usage", tests, NULL, NULL);
}
