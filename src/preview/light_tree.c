/* Builds the tree of lights from above: halves of as many lights, cut where the lights lie farthest apart. */
#include "preview/light_tree.h"

#include <stdlib.h>

/* Cones are wider by this angle, so that rounding cuts off no light. */
#define CONE_MARGIN 1e-3

typedef struct sorted_light {
    double key;
    int index;
} sorted_light;

typedef struct builder {
    const light *lights;
    light_tree *tree;
    sorted_light *order; /* the lights that are not black; keys are scratch */
    int node_count;
} builder;

static bool is_distant(const light *l)
{
    return l->kind == SCENE_LIGHT_DIRECTIONAL;
}

/* Where it is among its like. */
static vec3 place_of(const light *l)
{
    return is_distant(l) ? l->axis : l->position;
}

static double power_of(const light *l)
{
    const double mean = ((double)l->intensity[0] + (double)l->intensity[1] + (double)l->intensity[2]) / 3.0;
    return light_is_area(l) ? mean * light_area_m2(l) : mean;
}

/* How far from its axis it may be seen shining; radians. */
static double spread_of(const light *l)
{
    if (light_is_area(l))
        return 0.5 * PREVIEW_PI;
    if (l->kind != SCENE_LIGHT_SPOT)
        return PREVIEW_PI;
    return acos(fmin(fmax(-l->cone_offset / l->cone_scale, -1.0), 1.0));
}

/* ---- one node ---- */

static vec3 v3_min(vec3 a, vec3 b)
{
    return v3(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z));
}

static vec3 v3_max(vec3 a, vec3 b)
{
    return v3(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z));
}

static vec3 v3_magnitudes(vec3 a)
{
    return v3(fabs(a.x), fabs(a.y), fabs(a.z));
}

static void bound_cone(const builder *b, light_node *n)
{
    vec3 sum = v3(0.0, 0.0, 0.0);
    double angle = 0.0;
    for (int i = n->first; i < n->first + n->count; ++i)
        sum = v3_add(sum, b->lights[b->order[i].index].axis);
    n->axis = v3_dot(sum, sum) > 0.0 ? v3_normalize(sum) : v3(0.0, 0.0, 1.0);
    for (int i = n->first; i < n->first + n->count; ++i) {
        const light *const l = &b->lights[b->order[i].index];
        const double from_axis = acos(fmin(fmax(v3_dot(n->axis, l->axis), -1.0), 1.0));
        angle = fmax(angle, from_axis + spread_of(l) + CONE_MARGIN);
    }
    angle = n->is_distant ? PREVIEW_PI : fmin(angle, PREVIEW_PI);
    n->cone_cos = cos(angle);
    n->cone_sin = sin(angle);
}

static void bound_lights(const builder *b, light_node *n)
{
    vec3 low = v3((double)INFINITY, (double)INFINITY, (double)INFINITY), high = v3_scale(low, -1.0);
    for (int i = n->first; i < n->first + n->count; ++i) {
        const light *const l = &b->lights[b->order[i].index];
        const vec3 size = light_is_area(l) ? v3_add(v3_magnitudes(l->half_x), v3_magnitudes(l->half_y)) : v3(0, 0, 0);
        low = v3_min(low, v3_sub(place_of(l), size));
        high = v3_max(high, v3_add(place_of(l), size));
        n->reach = fmax(n->reach, n->is_distant ? sqrt(fmax(1.0 - l->cosine * l->cosine, 0.0)) : l->radius);
        n->range = fmax(n->range, n->is_distant || light_is_area(l) ? (double)INFINITY : l->range);
        n->power += power_of(l);
    }
    n->middle = v3_scale(v3_add(low, high), 0.5);
    n->half = v3_scale(v3_sub(high, low), 0.5);
    bound_cone(b, n);
}

/* ---- the cut ---- */

static double component(vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

static int compare_keys(const void *a, const void *b)
{
    const sorted_light *const x = a, *const y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key) : (x->index > y->index) - (x->index < y->index);
}

/* Along which axis of the world the lights' places, or their directions, lie farthest apart. */
static int widest_axis(const builder *b, const light_node *n, bool by_direction, double *width)
{
    int widest = 0;
    *width = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double low = (double)INFINITY, high = -(double)INFINITY;
        for (int i = n->first; i < n->first + n->count; ++i) {
            const light *const l = &b->lights[b->order[i].index];
            const double at = component(by_direction ? l->axis : place_of(l), axis);
            low = fmin(low, at);
            high = fmax(high, at);
        }
        if (high - low > *width) {
            *width = high - low;
            widest = axis;
        }
    }
    return widest;
}

static void sort_node(const builder *b, const light_node *n)
{
    double width;
    int axis = widest_axis(b, n, false, &width);
    const bool by_direction = !(width > 0.0);
    if (by_direction)
        axis = widest_axis(b, n, true, &width);
    for (int i = n->first; i < n->first + n->count; ++i) {
        const light *const l = &b->lights[b->order[i].index];
        b->order[i].key = component(by_direction ? l->axis : place_of(l), axis);
    }
    qsort(&b->order[n->first], (size_t)n->count, sizeof *b->order, compare_keys);
}

/* As deep as the logarithm of the number of lights. */
static void build(builder *b, int index, int first, int count, bool distant)
{
    light_node *const n = &b->tree->nodes[index];
    *n = (light_node){ .first = first, .count = count, .is_distant = distant };
    bound_lights(b, n);
    if (count == 1)
        return;
    sort_node(b, n);
    n->children = b->node_count;
    b->node_count += 2;
    build(b, n->children, first, count / 2, distant);
    build(b, n->children + 1, first + count / 2, count - count / 2, distant);
}

/* Those that shine, directional ones first. Returns how many these are. */
static int list_lights(builder *b, int count)
{
    int distant_count = 0;
    for (int pass = 0; pass < 2; ++pass) {
        for (int i = 0; i < count; ++i) {
            if (is_distant(&b->lights[i]) == (pass == 0) && power_of(&b->lights[i]) > 0.0)
                b->order[b->tree->light_count++].index = i;
        }
        if (pass == 0)
            distant_count = b->tree->light_count;
    }
    return distant_count;
}

static void build_all(builder *b, int count)
{
    light_tree *const t = b->tree;
    const int distant_count = list_lights(b, count), local_count = t->light_count - distant_count;
    t->root_count = b->node_count = (distant_count > 0) + (local_count > 0);
    if (distant_count > 0)
        build(b, 0, 0, distant_count, true);
    if (local_count > 0)
        build(b, t->root_count - 1, distant_count, local_count, false);
    for (int i = 0; i < t->light_count; ++i) {
        t->order[i] = b->order[i].index;
        t->power_before[i + 1] = t->power_before[i] + power_of(&b->lights[t->order[i]]);
    }
}

bool light_tree_make(const light *lights, int count, light_tree *out, report *r)
{
    *out = (light_tree){ 0 };
    builder b = { .lights = lights, .tree = out };
    out->nodes = calloc(2 * (size_t)count, sizeof *out->nodes);
    out->order = calloc((size_t)count, sizeof *out->order);
    out->power_before = calloc((size_t)count + 1U, sizeof *out->power_before);
    b.order = calloc((size_t)count, sizeof *b.order);
    const bool ok = out->nodes != NULL && out->order != NULL && out->power_before != NULL && b.order != NULL;
    if (ok)
        build_all(&b, count);
    free(b.order);
    if (ok)
        return true;
    light_tree_free(out);
    return report_error(r, "no memory for a tree of %d lights", count);
}

void light_tree_free(light_tree *t)
{
    free(t->nodes);
    free(t->order);
    free(t->power_before);
    *t = (light_tree){ 0 };
}
