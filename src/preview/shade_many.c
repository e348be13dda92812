/* Lights at many points, evaluated in batches: the library's widest kernels take points of one material side by side.
 */
#include "preview/shade_parts.h"

/* The library takes as many at a time. */
#define GROUP 64
#define MOST_PARTS (2 * SHADE_MOST_QUERIES)

/* A layer of a query's point. */
typedef struct part {
    const shade_query *query;
    int layer;
    glint_value value;
} part;

/* Parts of one kind as a structure of arrays. */
typedef struct group {
    part *parts[GROUP];
    int count;
    double u[GROUP], v[GROUP];
    float dudx[GROUP], dudy[GROUP], dvdx[GROUP], dvdy[GROUP], wo[3][GROUP], wi[3][GROUP], solid_angle_sr[GROUP];
    uint32_t seed[GROUP], draw[GROUP];
    glint_surface surfaces[GROUP];
    glint_area_light areas[GROUP];
    glint_value values[GROUP];
} group;

static const shade_layer *layer_of(const part *p)
{
    return &p->query->point->layers[p->layer];
}

static bool are_of_one_kind(const part *a, const part *b)
{
    const shade_layer *const one = layer_of(a), *const other = layer_of(b);
    return one->material == other->material && one->is_own == other->is_own && a->query->is_area == b->query->is_area;
}

/* A layer that does not count has a model that reads no footprint: shade_prepare leaves it so. */
static void set_footprint(group *g, int i, const shade_layer *layer)
{
    const glint_footprint none = { 0 };
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

static void add(group *g, part *p)
{
    const shade_layer *const layer = layer_of(p);
    const int i = g->count++;
    float wi[3];
    g->parts[i] = p;
    set_footprint(g, i, layer);
    if (!layer->is_own)
        g->surfaces[i] = layer->surface;
    for (int c = 0; c < 3; ++c)
        g->wo[c][i] = layer->wo[c];
    if (p->query->is_area) {
        shade_area_to_local(layer, &p->query->area, &g->areas[i]);
        return;
    }
    shade_to_local(layer, p->query->wi, wi);
    for (int c = 0; c < 3; ++c)
        g->wi[c][i] = wi[c];
    g->solid_angle_sr[i] = p->query->solid_angle_sr;
}

static void evaluate(group *g)
{
    const part *const first = g->parts[0];
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
                                .surfaces = layer_of(first)->is_own ? NULL : g->surfaces,
                                .area_lights = first->query->is_area ? g->areas : NULL,
                                .values = g->values };
    glint_eval_batch(layer_of(first)->material, &batch);
    for (int i = 0; i < g->count; ++i)
        g->parts[i]->value = g->values[i];
}

/* Takes those of one kind out of the list, as many as fit, and leaves the others in their order. */
static int take_group(part **list, int count, group *g)
{
    const part *const first = list[0];
    int left = 0;
    g->count = 0;
    for (int i = 0; i < count; ++i) {
        if (g->count < GROUP && are_of_one_kind(first, list[i]))
            add(g, list[i]);
        else
            list[left++] = list[i];
    }
    return left;
}

void shade_eval_many(shade_query *const *queries, int count)
{
    part parts[MOST_PARTS], *list[MOST_PARTS];
    group g;
    int part_count = 0;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < queries[i]->point->layer_count; ++k) {
            list[part_count] = &parts[part_count];
            parts[part_count].query = queries[i];
            parts[part_count++].layer = k;
        }
    for (int left = part_count; left > 0;) {
        left = take_group(list, left, &g);
        evaluate(&g);
    }
    const part *p = parts;
    for (int i = 0; i < count; ++i) {
        shade_query *const q = queries[i];
        const vec3 wi = q->is_area ? shade_towards_area(q->point, &q->area) : q->wi;
        q->value = (glint_value){ 0 };
        for (int k = 0; k < q->point->layer_count; ++k)
            shade_add_layer(q->point, k, wi, &p++->value, &q->value);
    }
}
