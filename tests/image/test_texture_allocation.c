/* The tile loop allocates nothing: this program counts what the allocator of the C library is asked for. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "texture_scene.h"

/* The names under which glibc keeps its own functions when a program replaces them. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

/* Visible, or the libraries would go on with those of the C library. */
#define REPLACES __attribute__((visibility("default")))

static atomic_long allocation_count;

REPLACES void *malloc(size_t size)
{
    allocation_count++;
    return __libc_malloc(size);
}

REPLACES void *calloc(size_t nmemb, size_t size)
{
    allocation_count++;
    return __libc_calloc(nmemb, size);
}

REPLACES void *realloc(void *ptr, size_t size)
{
    allocation_count++;
    return __libc_realloc(ptr, size);
}

REPLACES void *aligned_alloc(size_t alignment, size_t size)
{
    allocation_count++;
    return __libc_memalign(alignment, size);
}

static float look_around(const textures *t, int count)
{
    uint32_t random = 1;
    float sum = 0.0F;
    for (int i = 0; i < count; i++) {
        float q[6];
        for (int k = 0; k < 6; k++) {
            random = random * 1664525U + 1013904223U;
            q[k] = (float)(random >> 8) * 0x1p-24F * (k < 2 ? 3.0F : 0.3F);
        }
        scene_texture which = texture_plain(i % 2);
        which.nearest = i % 5 == 0;
        which.wrap_s = (scene_wrap)(i % 3);
        which.rotation = (float)(i % 7);
        float rgba[4];
        texture_lookup(t, &which, q[0], q[1], q[2], q[3], q[4], q[5], rgba);
        sum += rgba[0];
    }
    return sum;
}

static void lookups_allocate_nothing_after_the_first(void **state)
{
    (void)state;
    static uint8_t samples[200 * 100 * 3];
    for (size_t i = 0; i < sizeof samples; i++)
        samples[i] = (uint8_t)(i * i % 251);
    const bytes png = png_make(200, 100, 8, PNG_RGB, samples);
    report r = { 0 };
    textures *t = open_bytes(png, &r);
    assert_non_null(t);
    look_around(t, 1);
    const long before_copy = allocation_count;
    free(realpath("/", NULL)); /* libraries are seen, too */
    const long before = allocation_count;
    assert_true(before > before_copy);
    const float sum = look_around(t, 10000);
    assert_int_equal(allocation_count, before);
    assert_true(sum > 0.0F);
    textures_close(t);
    free(png.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lookups_allocate_nothing_after_the_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
