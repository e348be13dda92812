/* What a comparison leaves: one JSON document, or lines for people. */
#include "cli/compare_record.h"

#include <inttypes.h>
#include <math.h>

static const char *const outcomes[] = {
    [COMPARE_PASS] = "pass", [COMPARE_UNCLEAR] = "unclear", [COMPARE_FAIL] = "fail"
};

static document *ratio_document(const compare_ratio *ratio)
{
    document *d = document_object();
    document_set_number(d, "a", ratio->a);
    document_set_number(d, "b", ratio->b);
    document_set_number(d, "ratio", ratio->ratio);
    document_set_number(d, "standard_error", ratio->standard_error);
    return d;
}

static document *checks_of(const compare_result *result)
{
    document *list = document_array();
    for (int i = 0; i < result->check_count; ++i) {
        const compare_check *const c = &result->check[i];
        document *d = document_object();
        document_set_text(d, "name", c->name);
        document_set_number(d, "value", c->value);
        document_set_number(d, "expected", c->expected);
        document_set_number(d, "tolerance", c->tolerance);
        document_set_number(d, "standard_error", c->standard_error);
        document_set_text(d, "outcome", outcomes[c->outcome]);
        document_append(list, d);
    }
    return list;
}

static document *means_of(const compare_result *result)
{
    static const char *const names[COMPARE_CHANNELS] = { "R", "G", "B", "luminance" };
    document *d = document_object();
    for (int c = 0; c < COMPARE_CHANNELS; ++c)
        document_set(d, names[c], ratio_document(&result->mean[c]));
    return d;
}

static document *blocks_of(const compare_result *result)
{
    document *list = document_array();
    for (int i = 0; i < result->block_count; ++i) {
        const compare_block *const b = &result->block[i];
        document *d = document_object();
        document_set_integer(d, "side", (uint64_t)b->side);
        document_set_integer(d, "count", b->count);
        document_set(d, "variance", ratio_document(&b->variance));
        document_set_number(d, "correlation", b->correlation);
        document_append(list, d);
    }
    return list;
}

static document *quantiles_of(const compare_result *result)
{
    document *list = document_array();
    for (int i = 0; i < COMPARE_QUANTILES; ++i) {
        document *d = document_object();
        document_set_number(d, "share", compare_quantile_shares[i]);
        document_set_number(d, "a", result->a_quantile[i]);
        document_set_number(d, "b", result->b_quantile[i]);
        document_append(list, d);
    }
    return list;
}

/* "from" is relative to A's mean; the first bin holds all below it too, and what is not positive. */
static document *histogram_of(const compare_result *result)
{
    const int middle = COMPARE_BINS / 2;
    document *list = document_array();
    for (int i = 0; i < COMPARE_BINS; ++i) {
        document *d = document_object();
        document_set_number(d, "from", exp2(0.5 * (i - middle)));
        document_set_integer(d, "a", result->a_bin[i]);
        document_set_integer(d, "b", result->b_bin[i]);
        document_append(list, d);
    }
    return list;
}

static document *sparks_of(const compare_result *result)
{
    document *list = document_array();
    for (int i = 0; i < COMPARE_SPOTS; ++i) {
        const compare_spot *const s = &result->spot[i];
        document *d = document_object();
        document_set_number(d, "threshold", s->threshold);
        document_set_number(d, "a_per_megapixel", s->a_per_megapixel);
        document_set_number(d, "b_per_megapixel", s->b_per_megapixel);
        document_set_number(d, "a_area", s->a_area_share);
        document_set_number(d, "b_area", s->b_area_share);
        document_append(list, d);
    }
    return list;
}

static document *spectrum_of(const compare_result *result)
{
    document *list = document_array();
    for (int i = 0; i < result->ring_count; ++i) {
        document *d = document_object();
        document_set_number(d, "frequency", result->frequency[i]);
        document_set_number(d, "a", result->a_power[i]);
        document_set_number(d, "b", result->b_power[i]);
        document_append(list, d);
    }
    return list;
}

static document *largest_difference_of(const compare_result *result)
{
    document *d = document_object(), *at = document_array();
    document_append_integer(at, (uint64_t)result->most_x);
    document_append_integer(at, (uint64_t)result->most_y);
    document_set_number(d, "value", result->most_difference);
    document_set(d, "at", at);
    return d;
}

document *compare_document(const compare_result *result, const char *a, const char *b)
{
    document *d = document_object(), *size = document_array();
    document_append_integer(size, (uint64_t)result->width);
    document_append_integer(size, (uint64_t)result->height);
    document_set_text(d, "a", a);
    document_set_text(d, "b", b);
    document_set(d, "size", size);
    document_set_text(d, "verdict", outcomes[result->outcome]);
    document_set(d, "checks", checks_of(result));
    document_set_boolean(d, "same_facets", result->exact);
    document_set_integer(d, "pixels", result->pixels);
    document_set_integer(d, "a_not_finite", result->a_broken);
    document_set_integer(d, "b_not_finite", result->b_broken);
    document_set_text(d, "background", result->has_smooth ? "smooth" : "local mean");
    document_set(d, "mean", means_of(result));
    document_set_number(d, "rms_difference", result->rms_difference);
    document_set_number(d, "correlation", result->correlation);
    document_set(d, "largest_difference", largest_difference_of(result));
    document_set(d, "blocks", blocks_of(result));
    document_set(d, "quantiles", quantiles_of(result));
    document_set_number(d, "distribution_distance", result->distance);
    document_set(d, "histogram", histogram_of(result));
    document_set(d, "sparks", sparks_of(result));
    document_set(d, "spectrum", spectrum_of(result));
    return d;
}

void compare_print_lines(const compare_result *result, const char *a, const char *b)
{
    static const char *const verdicts[] = {
        [COMPARE_PASS] = "agrees with",
        [COMPARE_UNCLEAR] = "may agree with",
        [COMPARE_FAIL] = "does not agree with",
    };
    printf("%s %s %s%s\n", b, verdicts[result->outcome], a,
           result->exact ? " (the same facets, held against each other pixel by pixel)" : "");
    for (int i = 0; i < result->check_count; ++i) {
        const compare_check *const c = &result->check[i];
        printf("  %-8s%-28s%10.5g  expected %g +- %g", outcomes[c->outcome], c->name, c->value, c->expected,
               c->tolerance);
        if (c->standard_error > 0.0)
            printf("  (standard error %.2g)", c->standard_error);
        putchar('\n');
    }
}
