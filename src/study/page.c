/* The report of the studies: one page beside the figures and tables that it shows. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/output_file.h"
#include "study/study.h"

/* study_page.css, made into text by the build. */
extern const unsigned char study_page_css[];

static void put(output_file *f, const char *text)
{
    output_file_write(f, text, strlen(text));
}

static void put_escaped(output_file *f, const char *text)
{
    while (*text) {
        const size_t plain = strcspn(text, "<>&\"");
        output_file_write(f, text, plain);
        text += plain;
        if (*text) {
            put(f, *text == '<' ? "&lt;" : *text == '>' ? "&gt;" : *text == '&' ? "&amp;" : "&quot;");
            ++text;
        }
    }
}

/* before, the text, after. */
static void put_between(output_file *f, const char *before, const char *text, const char *after)
{
    put(f, before);
    put_escaped(f, text);
    put(f, after);
}

static void put_figures(output_file *f, const study_outcome *o)
{
    for (const study_figure *figure = o->study->figures; figure && figure->name && o->has_figures; ++figure) {
        put_between(f, "<figure><a href=\"", figure->name, ".svg\">");
        put_between(f, "<img src=\"", figure->name, ".svg\" alt=\"");
        put_between(f, "", figure->caption, "\"></a>");
        put_between(f, "<figcaption>", figure->caption, "</figcaption></figure>\n");
    }
}

static void put_study(output_file *f, const study_outcome *o)
{
    char took[64];
    snprintf(took, sizeof took, " (%.1f s)", o->elapsed_s);
    put_between(f, "<section id=\"", o->study->name, "\">\n");
    put_between(f, "<h2>", o->study->title, "</h2>\n");
    put_between(f, "<p class=\"truth\">Held against: ", o->study->truth, "");
    put_between(f, "", took, "</p>\n<ul class=\"found\">\n");
    for (size_t i = 0; i < o->line_count; ++i) {
        const study_line *const line = &o->lines[i];
        put(f, !line->is_check ? "<li>" : line->holds ? "<li class=\"holds\">" : "<li class=\"fails\">");
        put_between(f, "", line->text, "</li>\n");
    }
    put(f, "</ul>\n");
    put_figures(f, o);
    put(f, "<p class=\"tables\">Tables:");
    for (size_t i = 0; i < o->table_count; ++i) {
        put_between(f, " <a href=\"", o->tables[i], "\">");
        put_between(f, "", o->tables[i], "</a>");
    }
    put(f, "</p>\n</section>\n");
}

bool study_write_page(const study_options *options, const study_outcome *outcomes, size_t count, report *r)
{
    const size_t size = strlen(options->folder) + sizeof "/report.html";
    char *const path = malloc(size);
    if (!path)
        return report_error(r, "%s: no memory for the report", options->folder);
    snprintf(path, size, "%s/report.html", options->folder);
    output_file *const f = output_file_open(path, r);
    free(path);
    if (!f)
        return false;
    put(f, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width\">\n<title>glint study</title>\n<style>\n");
    put(f, (const char *)study_page_css);
    put_between(f, "</style>\n</head>\n<body>\n<h1>What accuracy costs, and how far off it is</h1>\n<p>libglint ",
                glint_version(), options->quick ? ", a quick run: few samples, wide bounds.</p>\n" : ".</p>\n");
    for (size_t i = 0; i < count; ++i)
        put_study(f, &outcomes[i]);
    put(f, "</body>\n</html>\n");
    return output_file_commit(f, r);
}
