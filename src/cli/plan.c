/* glint plan: what a render would do, what it would leave out, why, and what each costs. */
#include "cli/plan_table.h"

static const argument_syntax syntax = {
    .command = "glint plan",
    .operands = "SCENE",
    .summary = "Says what glint render would do with these options, what it would leave out, and what each costs.",
    .operands_min = 1,
    .operands_max = 1,
    .rules = render_rules + RENDER_OWN_RULES,
    .rule_count = RENDER_RULE_COUNT - RENDER_OWN_RULES + PLAN_OWN_RULES,
};

/* ---- for programs ---- */

static document *decision_document(const glint_decision *d, const scene *s)
{
    document *const o = document_object();
    document_set_text(o, "effect", glint_effect_name(d->effect));
    if (d->material >= 0) {
        document_set_integer(o, "material", (uint64_t)d->material);
        document_set_text(o, "material_name", s->materials[d->material].name ? s->materials[d->material].name : "");
    }
    if (d->light >= 0)
        document_set_integer(o, "light", (uint64_t)d->light);
    document_set_boolean(o, "on", d->is_on != 0);
    document_set_text(o, "choice", d->choice);
    document_set_text(o, "reason", d->reason);
    document_set_number(o, "ns_per_sample", (double)d->ns_per_sample);
    document_set_number(o, "time_share", (double)d->time_share);
    document_set_number(o, "error", (double)d->error);
    return o;
}

document *plan_document(const glint_plan *plan, const scene *s)
{
    const glint_plan_outcome out = glint_plan_result(plan);
    document *const o = document_object(), *const list = document_array();
    document_set_number(o, "error", (double)out.error);
    document_set_number(o, "error_of_mean", (double)out.error_of_mean);
    document_set_number(o, "noise", (double)out.noise);
    document_set_boolean(o, "met", out.is_met != 0);
    document_set_integer(o, "enough_samples", out.enough_samples);
    document_set_number(o, "ns_per_sample", (double)out.ns_per_sample);
    document_set_integer(o, "samples", out.samples);
    document_set_integer(o, "bounces", out.bounces);
    document_set_number(o, "cap_error", (double)out.cap_error);
    for (uint32_t i = 0; i < glint_plan_decision_count(plan); ++i)
        document_append(list, decision_document(glint_plan_decision(plan, i), s));
    document_set(o, "decisions", list);
    return o;
}

/* ---- for people ---- */

bool plan_warn(const glint_plan *plan, double budget, report *r)
{
    const glint_plan_outcome out = glint_plan_result(plan);
    if (out.is_met || !(budget > 0.0))
        return false;
    if (out.enough_samples > 0)
        report_warning(r,
                       "--accuracy %g is not met: %u samples a pixel leave noise of about %.2g, what is left out adds "
                       "%.2g; --spp %u would do",
                       budget, out.samples, (double)out.noise, (double)out.error, out.enough_samples);
    else
        report_warning(r, "--accuracy %g is not met: what is left out comes to %.2g", budget, (double)out.error);
    return true;
}

static int print_plan_document(const glint_plan *plan, const scene *s, const char *path, const render_values *v,
                               document *warnings)
{
    document *const o = document_object();
    document_set_text(o, "file", path);
    document_set_number(o, "accuracy", render_accuracy(v));
    document_set_integer(o, "spp", glint_plan_result(plan).samples);
    document_set(o, "plan", plan_document(plan, s));
    document_set(o, "warnings", warnings);
    return print_document(o);
}

static glint_plan *make_plan(const char *path, const render_values *v, scene *s, report *r)
{
    glint_plan *plan = NULL;
    preview_options options;
    render_light light = { 0 };
    if (!render_read_scene(path, v, s, r))
        return NULL;
    if (render_options(v, s, &light, &options, r))
        preview_plan(s, &options, &plan, r);
    render_light_end(&light);
    return plan;
}

static int plan(const char *path, const render_values *v)
{
    messages m;
    scene s = { 0 };
    messages_begin(&m, v->json);
    int code = COMMAND_DONE;
    glint_plan *const made = make_plan(path, v, &s, &m.report);
    if (made == NULL) {
        code = messages_fail(&m);
    } else if (v->json) {
        code = print_plan_document(made, &s, path, v, m.warnings);
    } else {
        plan_print_table(made, &s, v);
        messages_end(&m);
    }
    glint_plan_destroy(made);
    scene_free(&s);
    return code;
}

int command_plan(int argc, char **argv)
{
    render_values values = render_defaults();
    const char *path;
    int code = COMMAND_DONE;
    switch (arguments_parse(&syntax, argc, argv, &values, &path)) {
    case ARGUMENTS_HELP:
        break;
    case ARGUMENTS_WRONG:
        code = COMMAND_WRONG_USAGE;
        break;
    case ARGUMENTS_OK:
        code = render_light_check(&syntax, &values);
        if (code == COMMAND_DONE)
            code = plan(path, &values);
        break;
    }
    assignments_free(&values.materials);
    return code;
}
