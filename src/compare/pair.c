/* Two pictures side by side: which pixels are compared, their luminance, their background. */
#include "compare/pair.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Rec. 709, the primaries of scene-linear EXR and of sRGB. */
static const float LUMINANCE[3] = { 0.2126F, 0.7152F, 0.0722F };

/* The channel PREFIX + "R", "G" or "B", for all three. */
static bool find_three(const image *i, const char *prefix, size_t length, pair_colors *out)
{
    for (int c = 0; c < 3; ++c) {
        char name[sizeof *i->channel_names];
        if (length + 2 > sizeof name)
            return false;
        memcpy(name, prefix, length);
        name[length] = "RGB"[c];
        name[length + 1] = '\0';
        out->channel[c] = image_channel(i, name);
        if (out->channel[c] < 0)
            return false;
    }
    return true;
}

bool pair_find_colors(const image *i, const char *name, pair_colors *out, report *r)
{
    static const char combined[] = ".Combined.R";
    if (find_three(i, "", 0, out))
        return true;
    for (int c = 0; c < i->channel_count; ++c) {
        const char *const channel = i->channel_names[c];
        const size_t length = strlen(channel);
        if (length >= sizeof combined && strcmp(channel + length - strlen(combined), combined) == 0 &&
            find_three(i, channel, length - 1, out))
            return true;
    }
    const int grey = image_channel(i, "Y");
    if (grey >= 0) {
        out->channel[0] = out->channel[1] = out->channel[2] = grey;
        return true;
    }
    char list[256] = "";
    for (int c = 0; c < i->channel_count; ++c)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", c > 0 ? ", " : "", i->channel_names[c]);
    return report_error(r, "%s: found the channels %s; expected R, G and B, or Y", name, list);
}

/* ---- luminance ---- */

static float luminance_of(const image *i, const pair_colors *colors, size_t pixel)
{
    const float *const p = i->pixels + pixel * (size_t)i->channel_count;
    float sum = 0.0F;
    for (int c = 0; c < 3; ++c)
        sum += LUMINANCE[c] * p[colors->channel[c]];
    return sum;
}

/* Nothing is there, and the picture says so: no light and, where it has alpha, none of that. */
static bool is_empty(const pair *p, int which, size_t pixel)
{
    const image *const i = p->picture[which];
    const int alpha = image_channel(i, "A");
    if (alpha >= 0 && i->pixels[pixel * (size_t)i->channel_count + (size_t)alpha] != 0.0F)
        return false;
    for (int c = 0; c < 3; ++c)
        if (pair_color(p, which, pixel, c) != 0.0F)
            return false;
    return true;
}

static bool has_alpha(const pair *p)
{
    return image_channel(p->picture[PAIR_A], "A") >= 0 || image_channel(p->picture[PAIR_B], "A") >= 0;
}

static void measure_luminance(pair *p)
{
    const size_t count = (size_t)p->width * (size_t)p->height;
    const bool may_be_empty = has_alpha(p);
    for (size_t i = 0; i < count; ++i) {
        bool finite = true;
        for (int which = PAIR_A; which <= PAIR_B; ++which) {
            const float l = luminance_of(p->picture[which], &p->colors[which], i);
            p->luminance[which][i] = l;
            if (!isfinite(l)) {
                ++p->broken[which];
                finite = false;
            }
        }
        p->compared[i] = finite && !(may_be_empty && is_empty(p, PAIR_A, i) && is_empty(p, PAIR_B, i));
        if (!p->compared[i])
            p->luminance[PAIR_A][i] = p->luminance[PAIR_B][i] = 0.0F;
        p->pixels += p->compared[i];
    }
}

/* ---- background ---- */

/* NULL where the picture has no smooth part, or one that is not finite. */
static float *smooth_luminance(const image *i, size_t count)
{
    pair_colors colors;
    float *out = find_three(i, "smooth.", 7, &colors) ? malloc(count * sizeof *out) : NULL;
    for (size_t k = 0; out && k < count; ++k) {
        out[k] = luminance_of(i, &colors, k);
        if (!isfinite(out[k]))
            out[k] = 0.0F;
    }
    return out;
}

/* Each picture's own smooth part; a picture without one is held against the other's. */
static void find_background(pair *p)
{
    const size_t count = (size_t)p->width * (size_t)p->height;
    for (int which = PAIR_A; which <= PAIR_B; ++which) {
        p->background[which] = smooth_luminance(p->picture[which], count);
        if (!p->background[which])
            p->background[which] = smooth_luminance(p->picture[1 - which], count);
    }
    if (p->background[PAIR_A] && p->background[PAIR_B])
        return;
    free(p->background[PAIR_A]);
    free(p->background[PAIR_B]);
    p->background[PAIR_A] = p->background[PAIR_B] = NULL;
}

bool pair_make(pair *p, const image *a, const char *a_name, const image *b, const char *b_name, report *r)
{
    *p = (pair){ .width = a->width, .height = a->height, .picture = { a, b } };
    if (a->width != b->width || a->height != b->height)
        return report_error(r, "%s has %d x %d pixels, expected the %d x %d of %s", b_name, b->width, b->height,
                            a->width, a->height, a_name);
    if (!pair_find_colors(a, a_name, &p->colors[PAIR_A], r) || !pair_find_colors(b, b_name, &p->colors[PAIR_B], r))
        return false;
    const size_t count = (size_t)p->width * (size_t)p->height;
    p->compared = malloc(count * sizeof *p->compared);
    p->luminance[PAIR_A] = malloc(count * sizeof **p->luminance);
    p->luminance[PAIR_B] = malloc(count * sizeof **p->luminance);
    if (!p->compared || !p->luminance[PAIR_A] || !p->luminance[PAIR_B]) {
        pair_free(p);
        return report_error(r, "no memory to compare %d x %d pixels", a->width, a->height);
    }
    measure_luminance(p);
    if (p->pixels == 0) {
        pair_free(p);
        return report_error(r, "%s and %s have no pixel that is finite and not empty in both", a_name, b_name);
    }
    find_background(p);
    return true;
}

void pair_free(pair *p)
{
    free(p->compared);
    for (int which = PAIR_A; which <= PAIR_B; ++which) {
        free(p->luminance[which]);
        free(p->background[which]);
    }
    *p = (pair){ 0 };
}
