/* Light that the command line brings to a scene: a set of lights, an environment. */
#include <math.h>

#include "cli/render.h"

#define PI 3.14159265358979323846

int render_light_check(const argument_syntax *syntax, const render_values *v)
{
    if (v->environment)
        return COMMAND_DONE;
    if (!isnan(v->environment_rotation_deg))
        return arguments_wrong(syntax, "--environment-rotation: there is no --environment to turn");
    if (!isnan(v->environment_exposure_ev))
        return arguments_wrong(syntax, "--environment-exposure: there is no --environment to brighten");
    return COMMAND_DONE;
}

const char *render_light_set(int index)
{
    return index == 0 ? "file" : preview_light_set_name(index - 1);
}

static bool use_light_set(const render_values *v, scene *s, render_light *light, preview_options *options, report *r)
{
    if (v->light_set == 0)
        return true;
    scene_camera view;
    if (options->camera)
        view = *options->camera;
    else
        view = s->camera_count > 0 ? s->cameras[0] : preview_framed_camera(s, options->width, options->height);
    options->sky = &light->sky;
    return preview_use_light_set(s, v->light_set - 1, &view, &light->sky, r);
}

static bool use_environment(const render_values *v, render_light *light, preview_options *options, report *r)
{
    if (!v->environment)
        return true;
    if (!environment_map_read(v->environment, &light->map, r))
        return false;
    const double half_turn = render_number_or(v->environment_rotation_deg, 0.0) * PI / 360.0;
    const double exposure_ev = render_number_or(v->environment_exposure_ev, 0.0);
    light->environment = (preview_environment){ &light->map,
                                                { 0.0F, (float)sin(half_turn), 0.0F, (float)cos(half_turn) },
                                                (float)exp2(exposure_ev) };
    options->environment = &light->environment;
    return true;
}

bool render_light_begin(const render_values *v, scene *s, render_light *light, preview_options *options, report *r)
{
    return use_environment(v, light, options, r) && use_light_set(v, s, light, options, r);
}

void render_light_end(render_light *light)
{
    environment_map_free(&light->map);
}
