/* Gathers queries for the vectors that shade them. */
#include "model/lobe_kernel.h"

#include "model/machine_lanes.h"

lobe_kernel *lobe_kernel_widest(size_t most_lanes)
{
    switch (machine_lanes(most_lanes)) {
#if defined(__x86_64__)
    case 16:
        return lobe_kernel_16;
    case 8:
        return lobe_kernel_8;
#endif
#if defined(__x86_64__) || defined(__aarch64__)
    case 4:
        return lobe_kernel_4;
#endif
    default:
        return lobe_kernel_1;
    }
}

static void gather(const model_query *q, size_t i, lobe_points *p)
{
    const glint_surface *s = q->surface;
    const float wo[3] = { q->wo.x, q->wo.y, q->wo.z }, wi[3] = { q->wi.x, q->wi.y, q->wi.z };
    p->alpha_x[i] = s->alpha_x;
    p->alpha_y[i] = s->alpha_y;
    p->total_area[i] = q->total_area;
    p->solid_angle[i] = q->solid_angle_sr;
    for (int c = 0; c < 3; c++) {
        p->wo[c][i] = wo[c];
        p->wi[c][i] = wi[c];
        p->diffuse[c][i] = s->diffuse[c];
        p->f0[c][i] = s->f0[c];
        p->f90[c][i] = s->f90[c];
    }
}

void lobe_eval_many(const model_query *q, size_t count, int counts, lobe_lit *lit)
{
    lobe_points points;
    for (size_t i = 0; i < count; i++)
        gather(&q[i], i, &points);
    /* What is left of a vector repeats the last. */
    const size_t padded = (count + MOST_LANES - 1) / MOST_LANES * MOST_LANES;
    for (size_t i = count; i < padded; i++)
        gather(&q[count - 1], i, &points);
    lobe_kernel_widest(MOST_LANES)(&q->material->options, &points, padded, counts, lit);
}
