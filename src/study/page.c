/* The report of the studies: one page that holds its figures, and names the tables beside it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "io/output_file.h"
#include "study/machine.h"
#include "study/number.h"
#include "study/study.h"

/* study_page.css, made into text by the build. */
extern const unsigned char study_page_css[];

/* Bytes of a figure that the page takes in. */
enum { MOST_CURVES = 400000, MOST_PIXELS = 4000000 };

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

/* Where the exponent ends that printf wrote behind this digit, "e-05"; NULL: there is none. */
static const char *exponent_at(const char *text, int *exponent)
{
    if (text[0] < '0' || text[0] > '9' || text[1] != 'e' || (text[2] != '-' && text[2] != '+'))
        return NULL;
    char *end;
    *exponent = (int)strtol(text + 2, &end, 10);
    return end > text + 3 ? end : NULL;
}

/* Escaped, and 6.1e-05 as people write it. */
static void put_sentence(output_file *f, const char *text)
{
    char power[64], one[2] = { '\0', '\0' };
    while (*text) {
        int exponent = 0;
        const char *const end = exponent_at(text, &exponent);
        one[0] = *text;
        put_escaped(f, one);
        snprintf(power, sizeof power, " · 10<sup>%s%d</sup>", exponent < 0 ? "−" : "", abs(exponent));
        if (exponent != 0)
            put(f, power);
        text = end ? end : text + 1;
    }
}

/* before, the text, after. */
static void put_between(output_file *f, const char *before, const char *text, const char *after)
{
    put(f, before);
    put_escaped(f, text);
    put(f, after);
}

/* The same for what is HTML already. */
static void put_all(output_file *f, const char *before, const char *html, const char *after)
{
    put(f, before);
    put(f, html);
    put(f, after);
}

/* The file FOLDER/NAME.ENDING if it has at most so many bytes, else NULL. */
static FILE *open_small(const char *folder, const char *name, const char *ending, long most)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.%s", folder, name, ending);
    FILE *const from = fopen(path, "rb");
    if (from && fseek(from, 0, SEEK_END) == 0 && ftell(from) <= most) {
        rewind(from);
        return from;
    }
    if (from)
        fclose(from);
    return NULL;
}

static void put_base64(output_file *f, FILE *from)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char in[3];
    for (size_t n = fread(in, 1, 3, from); n > 0; n = fread(in, 1, 3, from)) {
        const unsigned bits = (unsigned)in[0] << 16 | (n > 1 ? (unsigned)in[1] << 8 : 0U) | (n > 2 ? in[2] : 0U);
        const char out[4] = { digit[bits >> 18], digit[bits >> 12 & 63U], (char)(n > 1 ? digit[bits >> 6 & 63U] : '='),
                              (char)(n > 2 ? digit[bits & 63U] : '=') };
        output_file_write(f, out, sizeof out);
    }
}

/* The page holds its figures: as curves, or as pixels where the curves are too many. */
static void put_picture(output_file *f, const char *folder, const char *name)
{
    FILE *from = open_small(folder, name, "svg", MOST_CURVES);
    put(f, from ? "data:image/svg+xml;base64," : "data:image/png;base64,");
    if (!from)
        from = open_small(folder, name, "png", MOST_PIXELS);
    if (from) {
        put_base64(f, from);
        fclose(from);
    }
}

static void put_figures(output_file *f, const char *folder, const study_outcome *o)
{
    for (const study_figure *figure = o->study->figures; figure && figure->name && o->has_figures; ++figure) {
        put_between(f, "<figure><a href=\"", figure->name, ".svg\"><img src=\"");
        put_picture(f, folder, figure->name);
        put_between(f, "\" alt=\"", figure->caption, "\"></a>");
        put_between(f, "<figcaption>", figure->caption, "</figcaption></figure>\n");
    }
}

/* The settings of a dial; those on the front stand out. */
static void put_front(output_file *f, const study_front_table *t)
{
    char number[160];
    put_between(f, "<div class=\"wide\"><table class=\"dial\"><caption>", t->dial.title, "");
    put_between(f, " <strong>", t->dial.choose, "</strong></caption>\n<tr><th>Setting</th><th>");
    put_between(f, "", t->dial.cost, "</th><th>");
    put_between(f, "", t->dial.error, "</th></tr>\n");
    for (int i = 0; i < t->count; ++i) {
        const study_setting *const s = &t->settings[i];
        put_between(f, s->on_front ? "<tr class=\"front\"><td>" : "<tr><td>", s->name, "</td>");
        number_rounded(number, sizeof number, s->cost);
        put_all(f, "<td>", number, "</td><td>");
        number_measured(number, sizeof number, s->error, s->bar);
        put_all(f, "", number, "</td></tr>\n");
    }
    put(f, "</table></div>\n");
}

static void put_study(output_file *f, const char *folder, const study_outcome *o)
{
    put_between(f, "<section id=\"", o->study->name, "\">\n");
    put_between(f, "<h2>", o->study->title, "</h2>\n");
    put_between(f, "<p class=\"truth\">Held against: ", o->study->truth, ".</p>\n");
    put_between(f, "<p class=\"choose\"><strong>Choose</strong> ", study_outcome_choose(o),
                "</p>\n<ul class=\"found\">\n");
    for (size_t i = 0; i < o->line_count; ++i) {
        const study_line *const line = &o->lines[i];
        put(f, !line->is_check ? "<li>" : line->holds ? "<li class=\"holds\">" : "<li class=\"fails\">");
        put_sentence(f, line->text);
        put(f, "</li>\n");
    }
    put(f, "</ul>\n");
    put_figures(f, folder, o);
    for (size_t i = 0; i < o->front_count; ++i)
        put_front(f, &o->fronts[i]);
    put(f, "<p class=\"tables\">Tables:");
    for (size_t i = 0; i < o->table_count; ++i) {
        put_between(f, " <a href=\"", o->tables[i], "\">");
        put_between(f, "", o->tables[i], "</a>");
    }
    put(f, "</p>\n</section>\n");
}

/* Whole pictures come first, which whoever renders asks for; then what they are made of. */
static const study_outcome *in_order(const study_outcome *outcomes, size_t count, size_t i)
{
    for (size_t k = 0; k < count; ++k)
        if (outcomes[k].study == studies[STUDY_IMAGES])
            return i == 0 ? &outcomes[k] : &outcomes[i <= k ? i - 1 : i];
    return &outcomes[i];
}

/* What the whole says on its first page: for each study what to choose, and how it went. */
static void put_summary(output_file *f, const study_outcome *outcomes, size_t count)
{
    char number[64];
    put(f, "<div class=\"wide\"><table class=\"summary\">\n<tr><th>Study</th><th>Choose</th><th>Bounds that hold</th>"
           "<th>Took</th></tr>\n");
    for (size_t i = 0; i < count; ++i) {
        const study_outcome *const o = in_order(outcomes, count, i);
        put_between(f, "<tr><td><a href=\"#", o->study->name, "\">");
        put_between(f, "", o->study->title, "</a></td><td>");
        put_between(f, "", study_outcome_choose(o), o->failed ? "</td><td class=\"fails\">" : "</td><td>");
        snprintf(number, sizeof number, "%d of %d", o->checks - o->failed, o->checks);
        put_all(f, "", number, "</td><td>");
        number_duration(number, sizeof number, o->elapsed_s);
        put_all(f, "", number, "</td></tr>\n");
    }
    put(f, "</table></div>\n");
}

static void put_opening(output_file *f, bool is_quick)
{
    char text[256];
    const time_t now = time(NULL);
    struct tm date;
    put(f, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width\">\n<title>glint study</title>\n<style>\n");
    put(f, (const char *)study_page_css);
    put(f, "</style>\n</head>\n<body>\n<h1>What accuracy costs, and how far off it is</h1>\n");
    put_between(f, "<p>libglint ", glint_version(), is_quick ? ", a quick run (few samples, wide bounds)" : "");
    if (gmtime_r(&now, &date) && strftime(text, sizeof text, ", %Y-%m-%d", &date) > 0)
        put(f, text);
    machine_describe(text, sizeof text);
    put_between(
        f, ", on ", text,
        ".</p>\n<p>To render, choose two numbers: samples per pixel and --accuracy. The rest is what the library "
        "has chosen, and why. Times are those of one core: look at ratios. In tables, what nothing beats in both "
        "cost and error is bold.</p>\n");
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
    put_opening(f, options->quick);
    put_summary(f, outcomes, count);
    for (size_t i = 0; i < count; ++i)
        put_study(f, options->folder, in_order(outcomes, count, i));
    put(f, "</body>\n</html>\n");
    return output_file_commit(f, r);
}
