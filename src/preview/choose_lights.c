/* Chooses lights by a cut through their tree, one light from each of its nodes by power.
 *
 * Stochastic lightcuts (Yuksel 2019) with the bounds of lightcuts (Walter et al. 2005) and the cones of Conty Estevez
 * and Kulla 2018. The cut begins at the roots; the node that can bring most is replaced by its children until there
 * are as many as lights may be chosen. So lights that matter most are nodes of their own, chosen with certainty and
 * without noise. The sum over nodes of (light / probability in its node) has the mean of the sum over all lights. What
 * a node's bound shows to bring nothing is left out, which changes no mean.
 *
 * The bound only says where to cut, never with which probability: it may be wrong, but for where it is zero.
 */
#include "preview/choose_lights.h"

/* Nearer than this share of a node's size its bound grows no more. Taste. */
#define NEAREST 0.01
/* The viewer is taken to be at least so high above the horizon: the masking that we leave out bounds highlights. */
#define LEAST_COSINE 0.1
/* No layer is darker, smoother or more covered than this, so that no bound is zero by a wrong guess. */
#define LEAST_REFLECTANCE 0.04
#define LEAST_ALPHA_SQUARE 1e-6
#define LEAST_WEIGHT 0.01

/* A layer as the bound sees it. */
typedef struct bound_layer {
    vec3 z, mirrored;       /* normal; where the viewer's direction is reflected to */
    double diffuse, mirror; /* level of f cos but for the cosine, and for D */
    double alpha_square;
} bound_layer;

typedef struct viewpoint {
    vec3 position;
    bound_layer layers[2];
    int layer_count;
} viewpoint;

static double mean(const float rgb[3])
{
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3.0;
}

static viewpoint viewpoint_of(const shade_point *p, vec3 position)
{
    viewpoint v = { .position = position };
    for (int i = 0; i < p->layer_count; ++i) {
        const shade_layer *const from = &p->layers[i];
        const double alpha = (double)fmaxf(from->surface.alpha_x, from->surface.alpha_y);
        const double x = (double)from->wo[0], y = (double)from->wo[1], z = (double)from->wo[2];
        if (!(z > 0.0))
            continue;
        const double weight = fmax((double)from->weight, LEAST_WEIGHT);
        v.layers[v.layer_count++] = (bound_layer){
            .z = from->z,
            .mirrored = v3_mad(v3_mad(v3_scale(from->z, z), from->x, -x), from->y, -y),
            .diffuse = weight * mean(from->surface.diffuse) / PREVIEW_PI,
            .mirror = weight * fmax(mean(from->surface.f0), LEAST_REFLECTANCE) / (4.0 * fmax(z, LEAST_COSINE)),
            .alpha_square = fmax(alpha * alpha, LEAST_ALPHA_SQUARE),
        };
    }
    return v;
}

/* A node as the point sees it: in a cone around its middle. */
typedef struct node_view {
    vec3 towards; /* from the point to the middle, of any length */
    double distance;
    double cone_cos, cone_sin; /* of the half angle; the whole sphere from within */
    double nearest_square;     /* to the box; of directional lights 1, in the unit of their power */
} node_view;

static double squared(double x)
{
    return x * x;
}

static node_view view_node(const light_node *n, vec3 position)
{
    node_view v = { .towards = n->is_distant ? n->middle : v3_sub(n->middle, position), .cone_cos = -1.0 };
    const double radius_square = v3_dot(n->half, n->half);
    const double distance_square = v3_dot(v.towards, v.towards);
    v.distance = sqrt(distance_square);
    if (radius_square < distance_square) {
        const double sine_square = radius_square / distance_square;
        v.cone_sin = sqrt(sine_square);
        v.cone_cos = sqrt(1.0 - sine_square);
    }
    v.nearest_square = n->is_distant ? 1.0
                                     : squared(fmax(fabs(v.towards.x) - n->half.x, 0.0)) +
                                           squared(fmax(fabs(v.towards.y) - n->half.y, 0.0)) +
                                           squared(fmax(fabs(v.towards.z) - n->half.z, 0.0));
    return v;
}

/* Whether the point lies in none of the directions in which the lights shine: the angle between axis and middle is
 * larger than both cones together. */
static bool shines_elsewhere(const light_node *n, const node_view *v)
{
    const double both_cos = n->cone_cos * v->cone_cos - n->cone_sin * v->cone_sin;
    const double both_sin = n->cone_sin * v->cone_cos + n->cone_cos * v->cone_sin;
    return v->cone_cos >= 0.0 && both_sin > 0.0 && v3_dot(n->axis, v->towards) < both_cos * v->distance;
}

/* GGX in the direction of the node's cone that comes nearest to the mirrored one, as if half vectors turned in the
 * plane of reflection; its tail never ends. */
static double lobe(const bound_layer *l, const node_view *v)
{
    const double cosine = v3_dot(l->mirrored, v->towards) / v->distance;
    double nearest = 1.0;
    if (cosine < v->cone_cos)
        nearest = cosine * v->cone_cos + sqrt(fmax(1.0 - cosine * cosine, 0.0)) * v->cone_sin;
    const double half_cos_square = 0.5 * (1.0 + nearest);
    return l->alpha_square / (PREVIEW_PI * squared(half_cos_square * (l->alpha_square - 1.0) + 1.0));
}

/* About the most that the node's lights can bring to the point; 0: nothing. */
static double bound(const light_node *n, const viewpoint *from)
{
    const node_view v = view_node(n, from->position);
    const double square = fmax(v.nearest_square, squared(NEAREST) * v3_dot(n->half, n->half));
    double level = 0.0;
    if (v.nearest_square >= n->range * n->range || shines_elsewhere(n, &v))
        return 0.0;
    for (int i = 0; i < from->layer_count; ++i) {
        const bound_layer *const l = &from->layers[i];
        const double highest = v3_dot(l->z, v.towards) + fabs(l->z.x) * n->half.x + fabs(l->z.y) * n->half.y +
                               fabs(l->z.z) * n->half.z + n->reach;
        if (!(highest > 0.0))
            continue;
        level += l->diffuse * fmin(highest * highest / square, 1.0) + l->mirror * lobe(l, &v);
    }
    return level > 0.0 ? n->power * level / square : 0.0;
}

/* ---- the cut ---- */

typedef struct cut {
    int nodes[MOST_LIGHTS];
    double bounds[MOST_LIGHTS]; /* of nodes that can be cut; else 0 */
    int count;
} cut;

static void place_node(const light_tree *t, const viewpoint *from, int node, int at, cut *c)
{
    const double most = bound(&t->nodes[node], from);
    c->nodes[at] = most > 0.0 ? node : -1;
    c->bounds[at] = t->nodes[node].children != 0 ? most : 0.0;
}

static int brightest(const cut *c)
{
    int found = 0;
    for (int i = 1; i < c->count; ++i)
        if (c->bounds[i] > c->bounds[found])
            found = i;
    return found;
}

/* Nodes that bring nothing keep a place with -1 until another node takes it. */
static int free_place(cut *c)
{
    for (int i = 0; i < c->count; ++i)
        if (c->nodes[i] < 0)
            return i;
    return c->count < MOST_LIGHTS ? c->count++ : -1;
}

static void make_cut(const light_tree *t, const viewpoint *from, cut *c)
{
    *c = (cut){ .count = t->root_count };
    for (int i = 0; i < t->root_count; ++i)
        place_node(t, from, i, i, c);
    while (c->count > 0) {
        const int at = brightest(c);
        if (!(c->bounds[at] > 0.0))
            return;
        const int other = free_place(c);
        if (other < 0)
            return;
        const int children = t->nodes[c->nodes[at]].children;
        place_node(t, from, children, at, c);
        place_node(t, from, children + 1, other, c);
    }
}

/* One light of a node by its power; the probability is 0 where rounding leaves it none. */
static chosen_light pick(const light_tree *t, const light_node *n, double u)
{
    int low = n->first, high = n->first + n->count;
    const double begin = t->power_before[low], all = t->power_before[high] - begin;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (t->power_before[middle] <= begin + u * all)
            low = middle;
        else
            high = middle;
    }
    const double own = t->power_before[low + 1] - t->power_before[low];
    return (chosen_light){ t->order[low], all > 0.0 ? (float)(own / all) : 0.0F };
}

int lights_choose(const light_tree *t, const shade_point *p, vec3 position, const sampler *random, uint32_t dimension,
                  chosen_light chosen[MOST_LIGHTS])
{
    const viewpoint from = viewpoint_of(p, position);
    cut c;
    int count = 0;
    uint32_t drawn = 0;
    double u[2] = { 0.0, 0.0 };
    make_cut(t, &from, &c);
    for (int i = 0; i < c.count; ++i) {
        if (c.nodes[i] < 0)
            continue;
        const light_node *const n = &t->nodes[c.nodes[i]];
        if (n->count == 1) {
            chosen[count++] = (chosen_light){ t->order[n->first], 1.0F };
            continue;
        }
        if (drawn % 2U == 0U)
            sampler_pair(random, dimension + drawn / 2U, u);
        chosen[count] = pick(t, n, u[drawn++ % 2U]);
        count += chosen[count].probability > 0.0F;
    }
    return count;
}
