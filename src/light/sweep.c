/* Integrals over a light of a density that is a stretched GGX or Gaussian lobe times something smooth: by the light's
 * boundary alone. */
#include "light/sweep.h"

#include "math/real.h"

/* How far the angles and levels that quadrature adds up may miss the true ones, of the light's own extent. */
#define TOLERANCE 3e-4

enum { NODES = 5, MOST_DEPTH = 24, MOST_PANELS = 400 };

/* Gauss and Legendre's on [0, 1]. */
static const double node_at[NODES] = { 0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                       0.95308992296933200 };
static const double node_weight[NODES] = { 0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                           0.23931433524968324, 0.11846344252809454 };

/* A direction in the lobe's own slopes. */
typedef struct place {
    double x, y, z, v;
} place;

static place place_of(const sweep_map *m, vec3d h)
{
    place p = { vec3d_dot(m->row[0], h), vec3d_dot(m->row[1], h), vec3d_dot(m->row[2], h), 0.0 };
    if (!(p.z > 0.0)) /* behind the lobe, which ends there */
        return p;
    const double r2 = p.x * p.x + p.y * p.y;
    if (m->is_gaussian)
        p.v = r2 < 1400.0 * p.z * p.z ? real_exp_negative(-0.5 * r2 / (p.z * p.z)) : 0.0;
    else
        p.v = p.z / sqrt(r2 + p.z * p.z);
    return p;
}

static vec3d moved(const sweep_map *m, vec3d direction)
{
    return vec3d_add(vec3d_normalize(direction), m->offset);
}

double sweep_level(const sweep_map *map, vec3d direction)
{
    return place_of(map, moved(map, direction)).v;
}

/* From one place to another around the origin, in (-pi, pi]. */
static double turn_between(const place *a, const place *b)
{
    return real_atan2(a->x * b->y - a->y * b->x, a->x * b->x + a->y * b->y);
}

static place place_on(const area_light *l, const sweep_map *m, int piece, double t)
{
    vec3d at, derivative;
    area_boundary(l, piece, t, &at, &derivative);
    return place_of(m, moved(m, at));
}

/* A node without its weight. *rise: the derivative of v. */
static sweep_node node_on(const area_light *l, const sweep_map *m, int piece, double t, double *rise)
{
    vec3d at, derivative;
    area_boundary(l, piece, t, &at, &derivative);
    const double length = vec3d_length(at);
    const double inverse = length > 1e-100 ? 1.0 / length : 0.0; /* a side through the point itself */
    const vec3d w = vec3d_scale(at, inverse);
    const vec3d dh = vec3d_scale(vec3d_mad(derivative, w, -vec3d_dot(w, derivative)), inverse);
    const vec3d h = vec3d_add(w, m->offset);
    const place p = place_of(m, h);
    const double dx = vec3d_dot(m->row[0], dh), dy = vec3d_dot(m->row[1], dh), dz = vec3d_dot(m->row[2], dh);
    const double r2 = p.x * p.x + p.y * p.y, r = sqrt(r2);
    sweep_node n = { 1.0, 0.0, p.v, 0.0, 0.0 };
    if (r2 > 1e-200) {
        n.cosine = p.x / r;
        n.sine = p.y / r;
        n.turn = (p.x * dy - p.y * dx) / r2;
    }
    const double h2 = vec3d_dot(h, h);
    n.twist = h2 > 1e-200 ? (h.x * dh.y - h.y * dh.x) / h2 : 0.0;
    *rise = 0.0;
    if (p.v > 0.0) {
        const double outward = p.x * dx + p.y * dy;
        if (m->is_gaussian) {
            *rise = -p.v * (outward / p.z - r2 / p.z * (dz / p.z)) / p.z;
        } else {
            const double l2 = r2 + p.z * p.z;
            *rise = (dz * r2 - p.z * outward) / (l2 * sqrt(l2));
        }
    }
    return n;
}

/* A part of one piece. */
typedef struct panel {
    double from, to;
    place first, last;
    int depth;
} panel;

typedef struct extent {
    double turn, rise, tolerance;
} extent;

static vec3d direction_on(const area_light *l, int piece, double t)
{
    vec3d at, derivative;
    area_boundary(l, piece, t, &at, &derivative);
    return vec3d_normalize(at);
}

/* Opposite sides of a light that is seen nearly edge-on all but cancel: they have to be known as well as it is thin. A
 * rectangle of one to fourteen is not. */
static double tolerance_of(const area_light *l)
{
    double length = 0.0;
    for (int i = 0; i < area_piece_count(l); i++) {
        const vec3d a = direction_on(l, i, 0.0), b = direction_on(l, i, 0.5), c = direction_on(l, i, 1.0);
        length += vec3d_length(vec3d_sub(b, a)) + vec3d_length(vec3d_sub(c, b));
    }
    return TOLERANCE * real_min(1.0, 64.0 * vec3d_length(l->moment) / real_max(length * length, 1e-30));
}

/* How far the boundary goes around and up and down: what is not to be missed. */
static extent extent_of(const area_light *l, const sweep_map *m)
{
    extent e = { 0.0, 0.0, tolerance_of(l) };
    for (int i = 0; i < area_piece_count(l); i++) {
        const place a = place_on(l, m, i, 0.0), b = place_on(l, m, i, 0.5), c = place_on(l, m, i, 1.0);
        e.turn += fabs(turn_between(&a, &b)) + fabs(turn_between(&b, &c));
        e.rise += fabs(b.v - a.v) + fabs(c.v - b.v);
    }
    return e;
}

static int is_resolved(const panel *p, const extent *all, double turn, double rise, double whole_turn)
{
    return fabs(turn - whole_turn) <= all->tolerance * all->turn &&
           fabs(rise - (p->last.v - p->first.v)) <= all->tolerance * all->rise + 1e-12;
}

/* Visits a panel's nodes if they tell the truth about it. */
static int visit_panel(const area_light *l, const sweep_map *m, int piece, const panel *p, const extent *all,
                       void (*visit)(const sweep_node *node, void *user), void *user)
{
    sweep_node node[NODES];
    const double length = p->to - p->from;
    double turn = 0.0, rise = 0.0;
    for (int i = 0; i < NODES; i++) {
        double rate;
        node[i] = node_on(l, m, piece, p->from + length * node_at[i], &rate);
        node[i].turn *= length * node_weight[i];
        node[i].twist *= length * node_weight[i];
        turn += node[i].turn;
        rise += rate * length * node_weight[i];
    }
    const double whole_turn = turn_between(&p->first, &p->last);
    if (!is_resolved(p, all, turn, rise, whole_turn)) {
        if (p->depth < MOST_DEPTH)
            return 0;
        /* So small a part is a point of the boundary; only how far it turns matters. */
        node[0] = node[2];
        node[0].turn = whole_turn;
        node[0].twist = 0.0;
        visit(node, user);
        return 1;
    }
    /* Ends know the whole turn: around a light it is none or all, and so must be the sum. */
    double size = 0.0;
    for (int i = 0; i < NODES; i++)
        size += fabs(node[i].turn);
    for (int i = 0; i < NODES; i++) {
        if (size > 0.0)
            node[i].turn += (whole_turn - turn) * (fabs(node[i].turn) / size);
        visit(&node[i], user);
    }
    return 1;
}

void sweep_each(const area_light *light, const sweep_map *map, void (*visit)(const sweep_node *node, void *user),
                void *user)
{
    const extent all = extent_of(light, map);
    int left = MOST_PANELS;
    for (int piece = 0; piece < area_piece_count(light); piece++) {
        panel stack[MOST_DEPTH + 2];
        int count = 1;
        stack[0] = (panel){ 0.0, 1.0, place_on(light, map, piece, 0.0), place_on(light, map, piece, 1.0), 0 };
        while (count > 0) {
            panel p = stack[--count];
            if (left-- <= 0)
                p.depth = MOST_DEPTH;
            if (visit_panel(light, map, piece, &p, &all, visit, user))
                continue;
            const double half = 0.5 * (p.from + p.to);
            const place middle = place_on(light, map, piece, half);
            stack[count++] = (panel){ half, p.to, middle, p.last, p.depth + 1 };
            stack[count++] = (panel){ p.from, half, p.first, middle, p.depth + 1 };
        }
    }
}

typedef struct mass_sum {
    double v0, sum;
} mass_sum;

static void add_mass(const sweep_node *n, void *user)
{
    mass_sum *s = user;
    s->sum += n->turn * (s->v0 - n->v) * (s->v0 + n->v);
}

double sweep_mass(const area_light *light, const sweep_map *map, vec3d peak)
{
    mass_sum s = { area_touches(light, peak) ? 1.0 : sweep_level(map, light->middle), 0.0 };
    sweep_each(light, map, add_mass, &s);
    return real_min(fabs(s.sum) / (2.0 * REAL_PI), 1.0);
}
