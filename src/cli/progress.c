/* How far long work is: a bar on a terminal, a plain line every few seconds anywhere else. */
#include "cli/progress.h"

#include <math.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* Taste: a bar that moves smoothly, and a log that stays short. */
static const double bar_period_s = 0.1, line_period_s = 5.0;
enum { LONGEST_BAR = 40, SHORTEST_BAR = 5, USUAL_COLUMNS = 80 };

progress progress_begin(FILE *out)
{
    progress p = { .out = out };
    const int descriptor = fileno(out);
    if (!isatty(descriptor)) {
        p.next_s = line_period_s;
        return p;
    }
    struct winsize window = { 0 };
    const bool known = ioctl(descriptor, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
    p.columns = known ? window.ws_col : USUAL_COLUMNS;
    return p;
}

/* "0:07", "12:30", "1:02:03". */
static void format_time(char *text, size_t size, double seconds)
{
    const long whole = seconds < 1e9 ? lround(seconds) : 1000000000L;
    if (whole < 3600)
        snprintf(text, size, "%ld:%02ld", whole / 60, whole % 60);
    else
        snprintf(text, size, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
}

static void format_status(char *text, size_t size, int percent, double elapsed_s, double left_s)
{
    char elapsed[32], left[32];
    format_time(elapsed, sizeof elapsed, elapsed_s);
    if (!isfinite(left_s) || left_s < 0.0) {
        snprintf(text, size, "%3d %%, %s elapsed", percent, elapsed);
        return;
    }
    format_time(left, sizeof left, left_s);
    snprintf(text, size, "%3d %%, %s elapsed, %s left", percent, elapsed, left);
}

/* One column stays free: a terminal that wraps at its last column would break "\r". */
static void draw_bar(const progress *p, double fraction, const char *status)
{
    const int room = p->columns - 1 - (int)strlen(status) - (int)strlen("[] ");
    if (room < SHORTEST_BAR) {
        fprintf(p->out, "\r\033[K%.*s", p->columns - 1, status);
    } else {
        char bar[LONGEST_BAR + 1];
        const int length = room < LONGEST_BAR ? room : LONGEST_BAR;
        const int full = (int)(fraction * length);
        memset(bar, '#', (size_t)full);
        memset(bar + full, '.', (size_t)(length - full));
        bar[length] = '\0';
        fprintf(p->out, "\r\033[K[%s] %s", bar, status);
    }
    fflush(p->out);
}

void progress_update(double fraction, double elapsed_s, double left_s, void *user)
{
    progress *p = user;
    if (!(elapsed_s >= p->next_s))
        return;
    const double known = fraction > 0.0 ? fmin(fraction, 1.0) : 0.0;
    char status[96];
    format_status(status, sizeof status, (int)(known * 100.0), elapsed_s, left_s);
    if (p->columns > 0)
        draw_bar(p, known, status);
    else
        fprintf(p->out, "glint: %s\n", status + strspn(status, " "));
    p->next_s = elapsed_s + (p->columns > 0 ? bar_period_s : line_period_s);
}

void progress_end(progress *p)
{
    if (p->columns > 0) {
        fputs("\r\033[K", p->out);
        fflush(p->out);
    }
}
