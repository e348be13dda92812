/* The report of a comparison: page.html with its style, its script and its data put in, one file that needs nothing
 * else. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/page_pixels.h"
#include "compare/pair.h"
#include "io/output_file.h"

/* page.html, page.css and page.js, made into text by the build. */
extern const unsigned char page_html[], page_css[], page_js[];

/* One {{NAME}} of the page. */
typedef struct insertion {
    const char *mark, *text;
} insertion;

/* A script element ends at the first "</": in JSON every < may be spelled \u003c. */
static void write_json(output_file *f, const char *json)
{
    while (*json) {
        const size_t plain = strcspn(json, "<");
        output_file_write(f, json, plain);
        json += plain;
        if (*json == '<') {
            output_file_write(f, "\\u003c", 6);
            ++json;
        }
    }
}

static const insertion *insertion_at(const insertion *list, size_t count, const char *at)
{
    for (size_t i = 0; i < count; ++i)
        if (strncmp(at, list[i].mark, strlen(list[i].mark)) == 0)
            return &list[i];
    return NULL;
}

static void fill_in(output_file *f, const insertion *list, size_t count)
{
    const char *at = (const char *)page_html;
    for (const char *mark = strstr(at, "{{"); mark; mark = strstr(at, "{{")) {
        const insertion *const found = insertion_at(list, count, mark);
        output_file_write(f, at, (size_t)(mark - at));
        at = mark + (found ? strlen(found->mark) : 2);
        if (!found)
            output_file_write(f, mark, 2);
        else if (strcmp(found->mark, "{{JSON}}") == 0)
            write_json(f, found->text);
        else
            output_file_write(f, found->text, strlen(found->text));
    }
    output_file_write(f, at, strlen(at));
}

bool compare_write_page(const char *path, const image *a, const image *b, const char *json, report *r)
{
    pair_colors colors[2];
    if (!pair_find_colors(a, path, &colors[PAIR_A], r) || !pair_find_colors(b, path, &colors[PAIR_B], r))
        return false;
    char *const pixels_a = page_pixels(a, &colors[PAIR_A]), *const pixels_b = page_pixels(b, &colors[PAIR_B]);
    bool done = false;
    if (!pixels_a || !pixels_b) {
        report_error(r, "%s: no memory for a page with two pictures of %d x %d pixels", path, a->width, a->height);
    } else {
        const insertion list[] = { { "{{CSS}}", (const char *)page_css },
                                   { "{{JS}}", (const char *)page_js },
                                   { "{{JSON}}", json },
                                   { "{{PIXELS_A}}", pixels_a },
                                   { "{{PIXELS_B}}", pixels_b } };
        output_file *const f = output_file_open(path, r);
        if (f) {
            fill_in(f, list, sizeof list / sizeof list[0]);
            done = output_file_commit(f, r);
        }
    }
    free(pixels_a);
    free(pixels_b);
    return done;
}
