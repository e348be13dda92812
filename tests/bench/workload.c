/* Draws the workloads, the same on every run. */
#include "workload.h"

#include <math.h>

#include "statistics.h"

const workload_kind workload_kinds[WORKLOAD_KINDS] = {
    { "mix, N p .01 to 1000", 0.01, 1e3, 1e-4, 0.3, 16 },
    { "sparse, N p .01 to 3", 0.01, 3.0, 1e-4, 0.1, 16 },
    { "dense, N p 20 to 2000", 20.0, 2e3, 1e-3, 0.3, 16 },
    { "incoherent, N p .01 to 1000", 0.01, 1e3, 1e-4, 0.3, 1 },
};

void workload_fill(workload *w, const workload_kind *kind)
{
    w->name = kind->name;
    w->points = (counting_points){ w->u,       w->v,    w->dudx, w->dudy, w->dvdx, w->dvdy,
                                   w->density, w->seed, w->hx,   w->hy,   w->cap,  w->p };
    uint64_t random = 2023;
    double size = 0.0, aspect = 1.0, turn = 0.0, u = 0.0, v = 0.0, hx = 0.0, hy = 0.0, lit = 1.0, p = 0.1;
    for (int i = 0; i < WORKLOAD_POINTS; i++) {
        if (i % kind->group == 0) {
            size = random_log_between(&random, 1e-4, 1e-2);
            aspect = random_log_between(&random, 1.0, 8.0);
            turn = random_between(&random, 0.0, 6.2831853);
            u = random_between(&random, -1.0, 1.0);
            v = random_between(&random, -1.0, 1.0);
            hx = random_between(&random, -0.5, 0.5);
            hy = random_between(&random, -0.5, 0.5);
            lit = random_log_between(&random, kind->lit_low, kind->lit_high);
            p = random_log_between(&random, kind->p_low, kind->p_high);
        }
        /* The next pixel of the row: one step aside, and everything else a hundredth different. */
        const double near = random_between(&random, 0.99, 1.01), minor = size * near / aspect;
        w->u[i] = u += size * cos(turn);
        w->v[i] = v += size * sin(turn);
        w->dudx[i] = (float)(size * cos(turn));
        w->dvdx[i] = (float)(size * sin(turn));
        w->dudy[i] = (float)(-minor * sin(turn));
        w->dvdy[i] = (float)(minor * cos(turn));
        w->density[i] = (float)(lit / p / (size * minor));
        w->hx[i] = (float)(hx += random_between(&random, -0.002, 0.002));
        w->hy[i] = (float)(hy += random_between(&random, -0.002, 0.002));
        w->p[i] = (float)(p * random_between(&random, 0.99, 1.01));
        w->cap[i] = 0.2F * w->p[i];
        w->seed[i] = 7U;
    }
}

static void copy_point(workload *w, int to, int from)
{
    w->u[to] = w->u[from];
    w->v[to] = w->v[from];
    w->dudx[to] = w->dudx[from];
    w->dudy[to] = w->dudy[from];
    w->dvdx[to] = w->dvdx[from];
    w->dvdy[to] = w->dvdy[from];
    w->density[to] = w->density[from];
}

void workload_add_lights(workload *w, int each, int share)
{
    /* From the last on: what is copied lies before what it is copied to. */
    for (int i = WORKLOAD_POINTS - 1; i >= 0; i--) {
        const int from = i / each, light = i % each;
        if (!share)
            copy_point(w, i, from);
        w->place[i] = (uint32_t)from;
        w->hx[i] = w->hx[from] + 0.11F * (float)light;
        w->hy[i] = w->hy[from] - 0.07F * (float)light;
        w->cap[i] = w->cap[from];
        w->p[i] = w->p[from];
    }
    w->points.place = share ? w->place : NULL;
}
