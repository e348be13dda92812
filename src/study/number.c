/* Numbers as people read them in a report: as many digits as their error leaves, powers of ten where they are small,
 * groups of three where they are large. */
#include "study/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The place of the first digit: 0 for 1 to 9, -1 for .1 to .9; of zero it is 0. */
static int place_of(double x)
{
    return x > 0.0 ? (int)floor(log10(x)) : 0;
}

/* Digits behind the point that show `digits` of x. */
static int decimals_for(double x, int digits)
{
    const int decimals = digits - 1 - place_of(x);
    return decimals > 0 ? decimals : 0;
}

/* Two digits of a bar that begins with 1, one of any other: what is left out is less than a fifth of it. */
static int digits_of_bar(double bar)
{
    return bar < 2.0 * pow(10.0, place_of(bar)) ? 2 : 1;
}

/* A narrow space, which does not break, before every third digit from the right. */
static void put_groups(char *text, size_t size, const char *plain)
{
    const size_t whole = strcspn(plain, "."), first = plain[0] == '-' ? 1 : 0;
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; plain[i] != '\0' && length + 5 < size; ++i) {
        if (whole - first > 4 && i > first && i < whole && (whole - i) % 3 == 0)
            length += (size_t)snprintf(text + length, size - length, "\u202f");
        text[length++] = plain[i];
        text[length] = '\0';
    }
}

void number_rounded(char *text, size_t size, double value)
{
    char plain[64];
    const double unit = pow(10.0, place_of(fabs(value)) - 2);
    /* What is whole was counted and not measured: bytes. */
    if (fabs(value) < 1e5 && fabs(value - round(value)) <= 0.0)
        snprintf(plain, sizeof plain, "%.0f", value);
    else
        snprintf(plain, sizeof plain, "%.*f", decimals_for(fabs(value), 3), round(value / unit) * unit);
    put_groups(text, size, plain);
}

void number_measured(char *text, size_t size, double value, double bar)
{
    const double most = fmax(fabs(value), bar);
    const int exponent = most > 0.0 && most < 1e-3 ? place_of(most) : 0;
    const double scale = pow(10.0, -exponent), v = value * scale, b = bar * scale;
    const int decimals = bar > 0.0 ? decimals_for(b, digits_of_bar(b)) : decimals_for(fabs(v), 3);
    char number[128];
    if (bar > 0.0)
        snprintf(number, sizeof number, exponent ? "(%.*f ± %.*f)" : "%.*f ± %.*f", decimals, v, decimals, b);
    else
        snprintf(number, sizeof number, "%.*f", value > 0.0 || value < 0.0 ? decimals : 0, v);
    if (exponent)
        snprintf(text, size, "%s · 10<sup>−%d</sup>", number, -exponent);
    else
        snprintf(text, size, "%s", number);
}

void number_duration(char *text, size_t size, double seconds)
{
    const long whole = lround(fmin(fmax(seconds, 0.0), 1e9));
    if (seconds < 9.95)
        snprintf(text, size, "%.1f s", fmax(seconds, 0.0));
    else if (whole < 60)
        snprintf(text, size, "%ld s", whole);
    else if (whole < 3600)
        snprintf(text, size, "%ld min %ld s", whole / 60, whole % 60);
    else
        snprintf(text, size, "%ld h %ld min", whole / 3600, whole / 60 % 60);
}
