/* Renders with options that leave nothing to chance. */
#include "pictures.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "scenes.h"
#include "statistics.h"

const preview_sky pictures_black = { { 0 }, { 0 }, { 0 } };

preview_options pictures_options(const scene_camera *camera)
{
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.width = o.height = 16;
    o.spp = 4;
    o.bounces = 0;
    o.threads = 1;
    o.camera = camera;
    o.sky = &pictures_black;
    o.aov = true;
    return o;
}

image pictures_render(const scene *s, const preview_options *o)
{
    image i;
    report r = { 0 };
    if (!preview_render(s, o, &i, NULL, &r))
        fail_msg("no picture: %s", r.error);
    for (size_t k = 0; k < (size_t)i.width * (size_t)i.height * (size_t)i.channel_count; ++k)
        assert_true(isfinite(i.pixels[k]));
    return i;
}

double pictures_at(const image *i, const char *channel, int x, int y)
{
    const int c = image_channel(i, channel);
    assert_true(c >= 0);
    return (double)i->pixels[((size_t)y * (size_t)i->width + (size_t)x) * (size_t)i->channel_count + (size_t)c];
}

double pictures_mean(const image *i, const char *channel)
{
    double sum = 0.0;
    for (int y = 0; y < i->height; ++y)
        for (int x = 0; x < i->width; ++x)
            sum += pictures_at(i, channel, x, y);
    return sum / ((double)i->width * i->height);
}

void pictures_block_statistics(scene *s, const preview_options *o, int seeds, double *variance, double *mean)
{
    enum { ACROSS = 8, COUNT = ACROSS * ACROSS };
    moments blocks[COUNT] = { { 0 } };
    const int side = o->width / ACROSS;
    assert_true(o->width == o->height && side * ACROSS == o->width);
    for (int seed = 0; seed < seeds; ++seed) {
        s->materials[0].glint.seed = (uint32_t)seed;
        image i = pictures_render(s, o);
        for (int b = 0; b < COUNT; ++b) {
            double sum = 0.0;
            for (int k = 0; k < side * side; ++k)
                sum += pictures_at(&i, "R", b % ACROSS * side + k % side, b / ACROSS * side + k / side);
            moments_add(&blocks[b], sum / (side * side));
        }
        image_free(&i);
    }
    *variance = *mean = 0.0;
    for (int b = 0; b < COUNT; ++b) {
        *variance += moments_variance(&blocks[b]) / COUNT;
        *mean += blocks[b].mean / COUNT;
    }
}

scene_camera pictures_from_above(float half_size)
{
    const float eye[3] = { 0.0F, 10.0F, 0.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    return scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, half_size);
}

void pictures_assert_relative(double value, double expected, double bound)
{
    if (!(fabs(value - expected) <= bound * fabs(expected)))
        fail_msg("%.9g is not %.9g: off by %.3g, at most %.3g is allowed", value, expected,
                 (value - expected) / expected, bound);
}
