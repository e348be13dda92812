/* The page of a comparison: one file in which nothing from outside can end a script or be taken for a mark. */
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pictures.h"

static int enter(void **state)
{
    static char path[64];
    snprintf(path, sizeof path, "/tmp/glint_page_XXXXXX");
    *state = path;
    return mkdtemp(path) && chdir(path) == 0 ? 0 : -1;
}

static int leave(void **state)
{
    unlink("page.html");
    return chdir("/") == 0 && rmdir(*state) == 0 ? 0 : -1;
}

static char *read_page(void)
{
    struct stat status;
    assert_int_equal(stat("page.html", &status), 0);
    char *text = malloc((size_t)status.st_size + 1);
    FILE *in = fopen("page.html", "rb");
    assert_true(text && in && fread(text, 1, (size_t)status.st_size, in) == (size_t)status.st_size);
    fclose(in);
    text[status.st_size] = '\0';
    return text;
}

static int occurrences(const char *text, const char *wanted)
{
    int count = 0;
    for (const char *at = strstr(text, wanted); at; at = strstr(at + 1, wanted))
        ++count;
    return count;
}

static void page_is_whole_and_safe(void **state)
{
    (void)state;
    image a = noise(40, 1.0, 0.1, 1);
    report r = { 0 };
    assert_true(compare_write_page("page.html", &a, &a, "{\"a\": \"</script><b>{{JS}}\"}", &r));
    char *page = read_page();
    assert_int_equal(occurrences(page, "</script>"), 4);
    assert_int_equal(occurrences(page, "<script"), 4);
    assert_int_equal(occurrences(page, "\\u003c/script>\\u003cb>{{JS}}"), 1);
    assert_int_equal(occurrences(page, "{{"), 1);
    /* Nothing is fetched. */
    assert_int_equal(occurrences(page, "src="), 0);
    assert_int_equal(occurrences(page, "href="), 0);
    assert_int_equal(occurrences(page, "@import"), 0);
    free(page);
    image_free(&a);
}

static void page_that_cannot_be_written_is_an_error(void **state)
{
    (void)state;
    image a = noise(8, 1.0, 0.1, 1);
    report r = { 0 };
    assert_false(compare_write_page("no/such/folder/page.html", &a, &a, "{}", &r));
    assert_non_null(strstr(r.error, "no/such/folder"));
    image_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(page_is_whole_and_safe, enter, leave),
        cmocka_unit_test_setup_teardown(page_that_cannot_be_written_is_an_error, enter, leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
