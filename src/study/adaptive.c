/* Adaptive cubature: products of Gauss's rule of 7 points and Kronrod's of 15, and the cell cut in two across which
 * they differ most. Piessens et al. 1983, QUADPACK, whose qk15 these nodes and weights are.
 */
#include "adaptive.h"

#include <math.h>
#include <stddef.h>

enum { NODES = 15, MOST_CELLS = 3000 };

/* On [-1, 1], from the outermost to the middle; every other one is Gauss's. */
static const double node[8] = { 0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
                                0.207784955007898467600689403773245, 0.0 };
static const double kronrod[8] = { 0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                   0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                   0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                   0.204432940075298892414161999234649, 0.209482141084727828012999174891714 };
static const double gauss[8] = { 0.0, 0.129484966168869693270611432679082, 0.0, 0.279705391489276667901467771423780,
                                 0.0, 0.381830050505118944950369775488975, 0.0, 0.417959183673469387755102040816327 };

typedef struct cell {
    int square;
    double x, y, width, height;
    double value[ADAPTIVE_MOST], error[2][ADAPTIVE_MOST]; /* error: along x, along y */
} cell;

/* The i-th of 15 from the left. */
static int rank_of(int i)
{
    return i < 8 ? i : 14 - i;
}

static double place_of(int i)
{
    return 0.5 + (i < 8 ? -0.5 : 0.5) * node[rank_of(i)];
}

static void measure(const adaptive_task *t, cell *c)
{
    double coarse[2][ADAPTIVE_MOST] = { { 0.0 } };
    const double area = 0.25 * c->width * c->height;
    for (int k = 0; k < ADAPTIVE_MOST; k++)
        c->value[k] = 0.0;
    for (int i = 0; i < NODES; i++)
        for (int j = 0; j < NODES; j++) {
            double f[ADAPTIVE_MOST] = { 0.0 };
            t->f(t->user, c->square, c->x + c->width * place_of(i), c->y + c->height * place_of(j), f);
            const double fine_x = kronrod[rank_of(i)], fine_y = kronrod[rank_of(j)];
            const double weight[3] = { area * fine_x * fine_y, area * gauss[rank_of(i)] * fine_y,
                                       area * fine_x * gauss[rank_of(j)] };
            for (int k = 0; k < ADAPTIVE_MOST; k++) {
                c->value[k] += weight[0] * f[k];
                coarse[0][k] += weight[1] * f[k];
                coarse[1][k] += weight[2] * f[k];
            }
        }
    for (int a = 0; a < 2; a++)
        for (int k = 0; k < ADAPTIVE_MOST; k++)
            c->error[a][k] = fabs(c->value[k] - coarse[a][k]);
}

/* The larger of the wanted errors along an axis, over the whole integrals. */
static double share_of(const adaptive_task *t, const cell *c, int axis, const double whole[ADAPTIVE_MOST])
{
    double most = 0.0;
    for (int k = 0; k < t->wanted; k++)
        most = whole[k] != 0.0 ? fmax(most, c->error[axis][k] / fabs(whole[k])) : most;
    return most;
}

/* Sums, and which cell is known least. */
static int add_up(const adaptive_task *t, const cell *cells, int count, adaptive_result *r)
{
    double error[ADAPTIVE_MOST] = { 0.0 }, most = -1.0;
    int worst = 0;
    *r = (adaptive_result){ .cells = count };
    for (int i = 0; i < count; i++)
        for (int k = 0; k < ADAPTIVE_MOST; k++) {
            r->value[k] += cells[i].value[k];
            error[k] += cells[i].error[0][k] + cells[i].error[1][k];
        }
    for (int k = 0; k < t->wanted; k++)
        r->error = r->value[k] != 0.0 ? fmax(r->error, error[k] / fabs(r->value[k])) : r->error;
    for (int i = 0; i < count; i++) {
        const double share = share_of(t, &cells[i], 0, r->value) + share_of(t, &cells[i], 1, r->value);
        if (share > most) {
            most = share;
            worst = i;
        }
    }
    return worst;
}

/* In two, across the axis along which it is known least. */
static void cut(const adaptive_task *t, cell *c, cell *other, const double whole[ADAPTIVE_MOST])
{
    const int is_tall = share_of(t, c, 1, whole) > share_of(t, c, 0, whole);
    c->width *= is_tall ? 1.0 : 0.5;
    c->height *= is_tall ? 0.5 : 1.0;
    *other = *c;
    other->x += is_tall ? 0.0 : c->width;
    other->y += is_tall ? c->height : 0.0;
    measure(t, c);
    measure(t, other);
}

adaptive_result adaptive_integrate(const adaptive_task *task)
{
    cell cells[MOST_CELLS];
    adaptive_result r = { .cells = 0 };
    int count = 0;
    if (task->squares < 1)
        return r;
    for (int i = 0; i < task->squares && count < MOST_CELLS; i++) {
        cells[count] = (cell){ .square = i, .width = 1.0, .height = 1.0 };
        measure(task, &cells[count++]);
    }
    int worst = add_up(task, cells, count, &r);
    while (count < MOST_CELLS && r.error > task->tolerance) {
        cut(task, &cells[worst], &cells[count++], r.value);
        worst = add_up(task, cells, count, &r);
    }
    return r;
}
