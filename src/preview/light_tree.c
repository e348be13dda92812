/* Builds the tree of lights from above: halves of as many lights, cut where the lights lie farthest apart. */
#include "preview/light_tree.h"

#include <stdlib.h>

/* Cones are wider by this angle, so that rounding cuts off no light. */
#define CONE_MARGIN 1e-3

typedef struct sorted_light {
    double key;
    int index;
} sorted_light;

/* What its nodes want to know of a light, looked up once and not at each of the levels. */
typedef struct known_light {
    vec3 place, axis; /* place: among its like */
    vec3 low, high;   /* a box around it */
    double spread;    /* how far from its axis it may be seen shining; radians */
    double reach, range, power;
} known_light;

typedef struct builder {
    const light *lights;
    known_light *known; /* by the light's index */
    light_tree *tree;
    sorted_light *order; /* the lights that are not black; keys are scratch */
    int node_count;
} builder;

static bool is_distant(const light *l)
{
    return l->kind == SCENE_LIGHT_DIRECTIONAL;
}

static double power_of(const light *l)
{
    const double mean = ((double)l->intensity[0] + (double)l->intensity[1] + (double)l->intensity[2]) / 3.0;
    return light_is_area(l) ? mean * light_area_m2(l) : mean;
}

static double spread_of(const light *l)
{
    if (light_is_area(l))
        return 0.5 * PREVIEW_PI;
    if (l->kind != SCENE_LIGHT_SPOT)
        return PREVIEW_PI;
    return acos(fmin(fmax(-l->cone_offset / l->cone_scale, -1.0), 1.0));
}

static vec3 v3_min(vec3 a, vec3 b)
{
    return v3(smaller_of(a.x, b.x), smaller_of(a.y, b.y), smaller_of(a.z, b.z));
}

static vec3 v3_max(vec3 a, vec3 b)
{
    return v3(larger_of(a.x, b.x), larger_of(a.y, b.y), larger_of(a.z, b.z));
}

static vec3 v3_magnitudes(vec3 a)
{
    return v3(fabs(a.x), fabs(a.y), fabs(a.z));
}

static known_light know(const light *l)
{
    const bool distant = is_distant(l), flat = light_is_area(l);
    const vec3 size = flat ? v3_add(v3_magnitudes(l->half_x), v3_magnitudes(l->half_y)) : v3(0, 0, 0);
    known_light k = { .place = distant ? l->axis : l->position, .axis = l->axis, .spread = spread_of(l) };
    k.low = v3_sub(k.place, size);
    k.high = v3_add(k.place, size);
    k.reach = distant ? sqrt(fmax(1.0 - l->cosine * l->cosine, 0.0)) : l->radius;
    k.range = distant || flat ? (double)INFINITY : l->range;
    k.power = power_of(l);
    return k;
}

/* ---- one node ---- */

static const known_light *light_at(const builder *b, int place)
{
    return &b->known[b->order[place].index];
}

static void bound_cone(const builder *b, light_node *n)
{
    vec3 sum = v3(0.0, 0.0, 0.0);
    double angle = 0.0;
    for (int i = n->first; i < n->first + n->count; ++i)
        sum = v3_add(sum, light_at(b, i)->axis);
    n->axis = v3_dot(sum, sum) > 0.0 ? v3_normalize(sum) : v3(0.0, 0.0, 1.0);
    /* No arc cosine where the cone is the whole sphere anyway. */
    for (int i = n->first; i < n->first + n->count && angle < PREVIEW_PI; ++i) {
        const known_light *const l = light_at(b, i);
        const double from_axis = l->spread < PREVIEW_PI ? acos(fmin(fmax(v3_dot(n->axis, l->axis), -1.0), 1.0)) : 0.0;
        angle = larger_of(angle, from_axis + l->spread + CONE_MARGIN);
    }
    angle = n->is_distant ? PREVIEW_PI : smaller_of(angle, PREVIEW_PI);
    n->cone_cos = cos(angle);
    n->cone_sin = sin(angle);
}

static void bound_lights(const builder *b, light_node *n)
{
    vec3 low = v3((double)INFINITY, (double)INFINITY, (double)INFINITY), high = v3_scale(low, -1.0);
    for (int i = n->first; i < n->first + n->count; ++i) {
        const known_light *const l = light_at(b, i);
        low = v3_min(low, l->low);
        high = v3_max(high, l->high);
        n->reach = larger_of(n->reach, l->reach);
        n->range = larger_of(n->range, l->range);
        n->power += l->power;
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

static vec3 where(const known_light *l, bool by_direction)
{
    return by_direction ? l->axis : l->place;
}

/* Along which axis of the world the lights' places, or their directions, lie farthest apart. */
static int widest_axis(const builder *b, const light_node *n, bool by_direction, double *width)
{
    vec3 low = v3((double)INFINITY, (double)INFINITY, (double)INFINITY), high = v3_scale(low, -1.0);
    int widest = 0;
    for (int i = n->first; i < n->first + n->count; ++i) {
        const vec3 at = where(light_at(b, i), by_direction);
        low = v3_min(low, at);
        high = v3_max(high, at);
    }
    *width = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        if (component(high, axis) - component(low, axis) > *width) {
            *width = component(high, axis) - component(low, axis);
            widest = axis;
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
    for (int i = n->first; i < n->first + n->count; ++i)
        b->order[i].key = component(where(light_at(b, i), by_direction), axis);
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
            if (is_distant(&b->lights[i]) == (pass == 0) && b->known[i].power > 0.0)
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
        t->power_before[i + 1] = t->power_before[i] + b->known[t->order[i]].power;
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
    b.known = calloc((size_t)count, sizeof *b.known);
    const bool ok =
        out->nodes != NULL && out->order != NULL && out->power_before != NULL && b.order != NULL && b.known != NULL;
    for (int i = 0; ok && i < count; ++i)
        b.known[i] = know(&lights[i]);
    if (ok)
        build_all(&b, count);
    free(b.order);
    free(b.known);
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
