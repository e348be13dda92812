/* Builds what trace.h needs, and nothing that shades. */
#include "traced_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static float opaque(const void *user, const trace_hit *at)
{
    (void)user;
    (void)at;
    return 1.0F;
}

static void count_warning(const char *text, void *user)
{
    (void)text;
    ++((traced_scene *)user)->warnings;
}

void traced_open_in(traced_scene *t, const scene *s, trace_trees trees, trace_opacity opacity)
{
    *t = (traced_scene){ 0 };
    report r = { .warn = count_warning, .user = t };
    if (!geometry_make(s, &t->geometry, &r) ||
        !trace_build(&t->geometry, trees, opacity != NULL ? opacity : opaque, t, &t->trace, &r))
        fail_msg("%s", r.error);
}

void traced_open(traced_scene *t, const scene *s, trace_opacity opacity)
{
    traced_open_in(t, s, TRACE_TREES_FINE, opacity);
}

void traced_close(traced_scene *t)
{
    trace_free(t->trace);
    geometry_free(&t->geometry);
}

trace_ray traced_ray(vec3 from, vec3 through)
{
    return (trace_ray){ .origin = from, .direction = v3_normalize(v3_sub(through, from)), .far = (double)INFINITY };
}

bool traced_hit_step(const traced_scene *t, const trace_ray *ray, const differential *d, hit *out, hit_step *step)
{
    trace_hit found;
    const hit_task task = { ray, d, &found, out, step };
    if (!trace_closest(t->trace, ray, TRACE_BLEND_SOLID, &found))
        return false;
    hit_resolve(&t->geometry, &task);
    return true;
}

bool traced_hit(const traced_scene *t, const trace_ray *ray, hit *out)
{
    const differential still = { { 0.0, 0.0, 0.0 } };
    hit_step step;
    return traced_hit_step(t, ray, &still, out, &step);
}
