/* Lights at many points, evaluated in batches: the library's widest kernels take points of one material side by side.
 */
#include "preview/shade_parts.h"

/* The library takes as many at a time. */
#define GROUP 64
#define MOST_PARTS (2 * SHADE_MOST_QUERIES)

/* A layer of a query's point. */
typedef struct part {
    const shade_query *query;
    const shade_layer *layer;
    const glint_value *value; /* once it has been evaluated */
} part;

/* Parts of one kind as a structure of arrays. */
typedef struct group {
    int count;
    double u[GROUP], v[GROUP];
    float dudx[GROUP], dudy[GROUP], dvdx[GROUP], dvdy[GROUP], wo[3][GROUP], wi[3][GROUP], solid_angle_sr[GROUP];
    uint32_t seed[GROUP], draw[GROUP];
    glint_surface surfaces[GROUP];
    glint_area_light areas[GROUP];
} group;

static bool are_of_one_kind(const part *a, const part *b)
{
    return a->layer->material == b->layer->material && a->layer->is_own == b->layer->is_own &&
           shade_is_area(a->query) == shade_is_area(b->query);
}

/* A layer that does not count, by its model or after shade_widen, has none: the library takes numbers that are none so.
 */
static void set_footprint(group *g, int i, const shade_layer *layer)
{
    static const glint_footprint none = { .dudx = INFINITY };
    const glint_footprint *const f = layer->counts ? &layer->footprint : &none;
    g->u[i] = f->u;
    g->v[i] = f->v;
    g->dudx[i] = f->dudx;
    g->dudy[i] = f->dudy;
    g->dvdx[i] = f->dvdx;
    g->dvdy[i] = f->dvdy;
    g->seed[i] = f->seed;
    g->draw[i] = f->draw;
}

static void add(group *g, const part *p)
{
    const shade_layer *const layer = p->layer;
    const int i = g->count++;
    float wi[3];
    set_footprint(g, i, layer);
    if (!layer->is_own)
        g->surfaces[i] = layer->surface;
    for (int c = 0; c < 3; ++c)
        g->wo[c][i] = layer->wo[c];
    if (shade_is_area(p->query)) {
        shade_area_to_local(layer, &p->query->area, &g->areas[i]);
        return;
    }
    shade_to_local(layer, p->query->wi, wi);
    for (int c = 0; c < 3; ++c)
        g->wi[c][i] = wi[c];
    g->solid_angle_sr[i] = p->query->solid_angle_sr;
}

/* first: any of the group. */
static void evaluate(const group *g, const part *first, glint_value *values)
{
    const glint_batch batch = { .size = sizeof batch,
                                .count = (size_t)g->count,
                                .u = g->u,
                                .v = g->v,
                                .dudx = g->dudx,
                                .dudy = g->dudy,
                                .dvdx = g->dvdx,
                                .dvdy = g->dvdy,
                                .seed = g->seed,
                                .draw = g->draw,
                                .wo = { g->wo[0], g->wo[1], g->wo[2] },
                                .wi = { g->wi[0], g->wi[1], g->wi[2] },
                                .solid_angle_sr = g->solid_angle_sr,
                                .surfaces = first->layer->is_own ? NULL : g->surfaces,
                                .area_lights = shade_is_area(first->query) ? g->areas : NULL,
                                .values = values };
    glint_eval_batch(first->layer->material, &batch);
}

/* Takes those of the kind of the first out of the list, as many as fit, and leaves the others in their order. values:
 * where theirs will be. */
static int take_group(part **list, int count, group *g, const glint_value *values)
{
    const part *const first = list[0];
    int left = 0;
    g->count = 0;
    for (int i = 0; i < count; ++i) {
        part *const p = list[i];
        if (g->count < GROUP && are_of_one_kind(first, p)) {
            p->value = &values[g->count];
            add(g, p);
        } else {
            list[left++] = p;
        }
    }
    return left;
}

static void evaluate_all(part **list, int count, glint_value *values)
{
    group g;
    while (count > 0) {
        const part *const first = list[0];
        count = take_group(list, count, &g, values);
        evaluate(&g, first, values);
        values += g.count;
    }
}

/* What its layers make of a query, the first of them at *p. */
static void add_layers(shade_query *q, const part *p)
{
    const shade_point *const point = q->point;
    const int layers = shade_layers(point);
    if (layers == 1 && p->layer->weight == 1.0F) {
        q->value = *p->value;
        if (!p->layer->counts)
            q->value.facet_count = q->value.lit_probability = 0.0F;
        return;
    }
    const vec3 wi = shade_is_area(q) ? shade_towards_area(point, &q->area) : q->wi;
    q->value = (glint_value){ 0 };
    for (int k = 0; k < layers; ++k)
        shade_add_layer(point, k, wi, p[k].value, &q->value);
}

void shade_eval_many(shade_query *const *queries, int count)
{
    part parts[MOST_PARTS], *list[MOST_PARTS];
    glint_value values[MOST_PARTS];
    int part_count = 0;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < shade_layers(queries[i]->point); ++k) {
            part *const p = &parts[part_count];
            list[part_count++] = p;
            p->query = queries[i];
            p->layer = &queries[i]->point->layers[k];
        }
    evaluate_all(list, part_count, values);
    const part *p = parts;
    for (int i = 0; i < count; ++i) {
        add_layers(queries[i], p);
        p += shade_layers(queries[i]->point);
    }
}
