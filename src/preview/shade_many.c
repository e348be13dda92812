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
    glint_value *value; /* once it has been evaluated */
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

/* The footprint of a layer that does not count, by its model or after shade_widen: the library takes numbers that are
 * none so. */
static const double nowhere[GROUP];
static const float endless[GROUP] = { [0 ... GROUP - 1] = INFINITY };

static bool are_of_one_kind(const part *a, const part *b)
{
    return a->layer->material == b->layer->material && a->layer->is_own == b->layer->is_own &&
           a->layer->counts == b->layer->counts && shade_is_area(a->query) == shade_is_area(b->query);
}

static void set_footprint(group *g, int i, const glint_footprint *f)
{
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
    if (layer->counts)
        set_footprint(g, i, &layer->footprint);
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
    const bool counts = first->layer->counts;
    const glint_batch batch = { .size = sizeof batch,
                                .count = (size_t)g->count,
                                .u = counts ? g->u : nowhere,
                                .v = counts ? g->v : nowhere,
                                .dudx = counts ? g->dudx : endless,
                                .dudy = counts ? g->dudy : endless,
                                .dvdx = counts ? g->dvdx : endless,
                                .dvdy = counts ? g->dvdy : endless,
                                .seed = counts ? g->seed : NULL,
                                .draw = counts ? g->draw : NULL,
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
static int take_group(part **list, int count, group *g, glint_value *values)
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

static void evaluate_all(part **list, int count, glint_value *values, uint64_t evaluated[2])
{
    group g;
    while (count > 0) {
        const part *const first = list[0];
        count = take_group(list, count, &g, values);
        evaluate(&g, first, values);
        evaluated[first->layer->counts] += (uint64_t)g.count;
        values += g.count;
    }
}

/* What the layers make of a query together; takes the place of what the base does. */
static void add_layers(shade_query *q, const part *base, const part *coat)
{
    const vec3 wi = shade_is_area(q) ? shade_towards_area(q->point, &q->area) : q->wi;
    glint_value sum = { 0 };
    shade_add_layer(q->point, 0, wi, base->value, &sum);
    if (coat != NULL)
        shade_add_layer(q->point, 1, wi, coat->value, &sum);
    *base->value = sum;
}

static part *add_part(part *p, const shade_query *q, const shade_layer *layer)
{
    *p = (part){ q, layer, NULL };
    return p;
}

void shade_eval_many(shade_query *const *queries, int count, glint_value values[2 * SHADE_MOST_QUERIES],
                     uint64_t evaluated[2])
{
    part parts[MOST_PARTS], *list[MOST_PARTS];
    int part_count = count;
    for (int i = 0; i < count; ++i)
        list[i] = add_part(&parts[i], queries[i], &queries[i]->point->layers[0]);
    for (int i = 0; EFFECT_COATS && i < count; ++i)
        if (queries[i]->point->layer_count == 2) {
            list[part_count] = add_part(&parts[part_count], queries[i], &queries[i]->point->layers[1]);
            ++part_count;
        }
    evaluate_all(list, part_count, values, evaluated);
    const part *coat = &parts[count];
    for (int i = 0; i < count; ++i) {
        const part *const base = &parts[i];
        const bool is_coated = EFFECT_COATS && queries[i]->point->layer_count == 2;
        queries[i]->value = base->value;
        if (is_coated || base->layer->weight != 1.0F)
            add_layers(queries[i], base, is_coated ? coat++ : NULL);
        else if (!base->layer->counts)
            base->value->facet_count = base->value->lit_probability = 0.0F;
    }
}

/* ---- patches ---- */

/* The layers of a point under a patch: those of *patches that are there. */
static int add_patches(const shade_point *p, const shade_surroundings *s, shade_query *query, shade_patch *patches,
                       part *parts)
{
    int count = 0;
    for (int i = 0; i < shade_layers(p); ++i) {
        const float density = shade_patch_density(p, i, s);
        if (!(density > 0.0F))
            continue;
        shade_patch_set(p, i, s, density, &patches[i]);
        query->solid_angle_sr = patches[i].solid_angle_sr;
        add_part(&parts[count++], query, &patches[i].layer);
    }
    query->wi = s->wi;
    query->is_area = false;
    return count;
}

/* At most GROUP points. */
void shade_eval_surroundings_many(const shade_point *const *points, const shade_surroundings *const *from, int count,
                                  glint_value *values)
{
    shade_query queries[GROUP];
    shade_patch patches[GROUP][2];
    part parts[2 * GROUP], *list[2 * GROUP];
    glint_value of_layers[2 * GROUP];
    uint64_t unused[2] = { 0 };
    int part_count = 0;
    for (int i = 0; i < count; ++i)
        part_count += add_patches(points[i], from[i], &queries[i], patches[i], &parts[part_count]);
    for (int i = 0; i < part_count; ++i)
        list[i] = &parts[i];
    evaluate_all(list, part_count, of_layers, unused);
    const part *p = parts;
    for (int i = 0; i < count; ++i) {
        values[i] = (glint_value){ 0 };
        for (; p < &parts[part_count] && p->query == &queries[i]; ++p) {
            const int layer = p->layer == &patches[i][1].layer;
            shade_add_patch(points[i], layer, from[i]->wi, &patches[i][layer], p->value, &values[i]);
        }
    }
}
