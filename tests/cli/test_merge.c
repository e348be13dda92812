/* glint merge as a user runs it: tiles become the very file that a whole render writes, and nothing else passes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "io/image.h"
#include "printed_document.h"
#include "workplace.h"

#define SMALL "--size", "40x30", "--spp", "4", "--material", "*=craft-glitter"

static void succeed(outcome o)
{
    assert_exit(&o, 0);
    outcome_free(&o);
}

#define render(...) succeed(glint_run(NULL, "render", "plane.gltf", SMALL, __VA_ARGS__))

/* Names a file that must not be there. */
static void assert_absent(const char *path)
{
    if (access(path, F_OK) == 0)
        fail_msg("%s is there", path);
}

static void tiles_make_the_file_of_a_whole_render(void **state)
{
    (void)state;
    render("-o", "whole.exr", "--aov");
    render("-o", "a.exr", "--aov", "--tile", "0,0,25,30");
    render("-o", "b.exr", "--aov", "--tile", "20,0,20,17", "--threads", "1"); /* five columns twice */
    render("-o", "c.exr", "--aov", "--tile", "25,17,15,13");
    succeed(glint_run(NULL, "merge", "c.exr", "a.exr", "b.exr", "-o", "merged.exr"));
    assert_same_files("whole.exr", "merged.exr");
    succeed(glint_run(NULL, "merge", "merged.exr", "-o", "again.exr"));
    assert_same_files("whole.exr", "again.exr");
    /* A tile may be replaced by the whole. */
    succeed(glint_run(NULL, "merge", "a.exr", "b.exr", "c.exr", "-o", "a.exr"));
    assert_same_files("whole.exr", "a.exr");
    assert_int_equal(folder_count("."), 8);
}

static void json_says_what_was_merged(void **state)
{
    (void)state;
    render("-o", "a.exr", "--tile", "0,0,40,10");
    render("-o", "b.exr", "--tile", "0,10,40,20");
    outcome o = glint_run(NULL, "merge", "a.exr", "b.exr", "-o", "whole.exr", "--json");
    json_t *d = printed_document(&o);
    assert_string_equal(json_string_value(json_object_get(d, "output")), "whole.exr");
    assert_int_equal(json_integer_value(json_array_get(json_object_get(d, "size"), 0)), 40);
    assert_int_equal(json_integer_value(json_object_get(d, "tiles")), 2);
    assert_int_equal(json_array_size(json_object_get(d, "channels")), 4);
    json_decref(d);
    outcome_free(&o);
}

static void gap_is_named_as_a_tile(void **state)
{
    (void)state;
    render("-o", "a.exr", "--tile", "0,0,40,10");
    render("-o", "b.exr", "--tile", "0,10,12,20");
    render("-o", "c.exr", "--tile", "30,10,10,20");
    file_write_text("old.exr", "old");
    assert_refused(glint_run(NULL, "merge", "a.exr", "b.exr", "c.exr", "-o", "old.exr"), 1,
                   "a.exr: 360 of the 40x30 pixels of its picture are in no tile, such as 12,10,18,20 (x, y, width, "
                   "height)");
    assert_file_holds("old.exr", "old");
    render("-o", "d.exr", "--tile", "12,10,18,20");
    succeed(glint_run(NULL, "merge", "a.exr", "b.exr", "c.exr", "d.exr", "-o", "old.exr"));
}

/* A part of a picture whose pixels all are value, but for the first. */
static void write_part(const char *path, int x, int width, float first, float value, const image_text *text)
{
    report r = { 0 };
    image i;
    assert_true(image_allocate(&i, width, 2, 1, &r));
    assert_true(image_name_channel(&i, 0, "Y", path, &r));
    for (int k = 0; k < 2 * width; ++k)
        i.pixels[k] = k == 0 ? first : value;
    i.x = x;
    i.full_width = 8;
    i.full_height = 2;
    if (!image_write_exr(path, &i, text, text ? 1 : 0, &r))
        fail_msg("%s", r.error);
    image_free(&i);
}

static void overlaps_agree_bit_by_bit(void **state)
{
    (void)state;
    write_part("left.exr", 0, 5, 1.0F, NAN, NULL);
    write_part("right.exr", 4, 4, NAN, NAN, NULL);
    succeed(glint_run(NULL, "merge", "left.exr", "right.exr", "-o", "out.exr")); /* both say NaN of pixel 4,0 */
    write_part("right.exr", 4, 4, 0.5F, NAN, NULL);
    assert_refused(glint_run(NULL, "merge", "left.exr", "right.exr", "-o", "none.exr"), 1,
                   "right.exr: Y of pixel 4,0 is 0.5, expected the nan of left.exr");
    write_part("left.exr", 0, 5, 1.0F, 0.0F, NULL);
    write_part("right.exr", 4, 4, -0.0F, 0.0F, NULL);
    assert_refused(glint_run(NULL, "merge", "left.exr", "right.exr", "-o", "none.exr"), 1, "Y of pixel 4,0 is -0");
    assert_absent("none.exr");
}

static void tiles_of_different_pictures_are_refused(void **state)
{
    (void)state;
    render("-o", "a.exr", "--tile", "0,0,40,10");
    static const struct {
        const char *const option[2], *says;
    } other[] = {
        { { "--size", "40x31" }, "b.exr: is part of a picture of 40x31 pixels, expected the 40x30 of a.exr" },
        { { "--aov", "--aov" }, "b.exr: has a channel \"albedo.R\", expected the channels of a.exr" },
        { { "--seed", "1" }, "b.exr: was rendered with glint:seed \"1\", expected \"0\" as in a.exr" },
        { { "--camera", "1" }, "b.exr: was rendered with glint:camera \"1\", expected \"\" as in a.exr" },
    };
    for (size_t i = 0; i < sizeof other / sizeof other[0]; ++i) {
        render("-o", "b.exr", "--tile", "0,10,40,20", other[i].option[0], other[i].option[1]);
        assert_refused(glint_run(NULL, "merge", "a.exr", "b.exr", "-o", "out.exr"), 1, other[i].says);
    }
    render("-o", "b.exr", "--tile", "0,10,40,20", "--aov");
    assert_refused(glint_run(NULL, "merge", "b.exr", "a.exr", "-o", "out.exr"), 1,
                   "a.exr: has no channel \"albedo.R\", expected the channels of b.exr");
    write_part("left.exr", 0, 5, 0.0F, 0.0F, &(image_text){ "glint:seed", "1" });
    write_part("right.exr", 5, 3, 0.0F, 0.0F, NULL);
    assert_refused(glint_run(NULL, "merge", "left.exr", "right.exr", "-o", "out.exr"), 1,
                   "right.exr: lacks metadata of glint that left.exr has");
    assert_refused(glint_run(NULL, "merge", "right.exr", "left.exr", "-o", "out.exr"), 1,
                   "left.exr: was rendered with glint:seed \"1\", which right.exr does not have");
    assert_absent("out.exr");
}

static void what_is_no_tile_is_refused(void **state)
{
    (void)state;
    render("-o", "a.exr", "--tile", "0,0,40,10");
    render("-o", "b.png", "--tile", "0,10,40,20");
    assert_refused(glint_run(NULL, "merge", "a.exr", "b.png", "-o", "out.exr"), 1,
                   "b.png: found a picture of the format png, which does not say where it lies, expected an OpenEXR");
    assert_refused(glint_run(NULL, "merge", "a.exr", "c.exr", "-o", "out.exr"), 1, "c.exr: cannot be read: No such");
    size_t size;
    char *content = file_read("a.exr", &size);
    file_write("cut.exr", content, size / 2);
    free(content);
    assert_refused(glint_run(NULL, "merge", "cut.exr", "-o", "out.exr"), 1, "cut.exr: is broken");
    /* Pixels outside the picture that they are a part of. */
    write_part("far.exr", 4, 5, 0.0F, 0.0F, NULL);
    assert_refused(glint_run(NULL, "merge", "far.exr", "-o", "out.exr"), 1,
                   "far.exr: found 5x2 pixels from 4,0 on, expected a part of its 8x2 pixels");
    assert_absent("out.exr");
    assert_refused(glint_run(NULL, "merge", "a.exr", "-o", "none/out.exr"), 1, "none/out.exr");
}

static void usage_is_checked_before_anything_is_read(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "merge", "a.exr"), 2, "-o OUT.exr is missing");
    assert_refused(glint_run(NULL, "merge", "-o", "a.exr"), 2, "TILE.exr");
    assert_refused(glint_run(NULL, "merge", "a.exr", "-o", "a.png"), 2, "expected a name that ends in .exr");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, workplace_enter_plane, workplace_leave)
    const struct CMUnitTest tests[] = {
        TEST(tiles_make_the_file_of_a_whole_render),
        TEST(json_says_what_was_merged),
        TEST(gap_is_named_as_a_tile),
        TEST(overlaps_agree_bit_by_bit),
        TEST(tiles_of_different_pictures_are_refused),
        TEST(what_is_no_tile_is_refused),
        TEST(usage_is_checked_before_anything_is_read),
    };
    return cmocka_run_group_tests_name("merge", tests, NULL, NULL);
}
