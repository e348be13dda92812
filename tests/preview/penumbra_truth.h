/* A half-shadow on a floor: what it is, by brute force, and what the renderer's quotient of a few places is in the
 * mean. */
#ifndef TESTS_PENUMBRA_TRUTH_H
#define TESTS_PENUMBRA_TRUTH_H

#include <math.h>

#include "glint.h"
#include "statistics.h"

/* A panel over the floor, all but the part to the left of an edge hidden by a blocker that hangs between. The point of
 * the floor is at x, the viewer straight above it. */
typedef struct penumbra {
    const glint_material *material;
    double x, edge, height;           /* of the blocker */
    double middle, above, wide, deep; /* the panel: along x, height, size along x and across */
} penumbra;

static inline int penumbra_sees(const penumbra *p, double px)
{
    return p->x + (px - p->x) * p->height / p->above <= p->edge;
}

/* f cos of the direction to a place of the panel, and steradians per square metre there. */
static inline double penumbra_reflects(const penumbra *p, double px, double py, float wi[3], double *steradians)
{
    static const float up[3] = { 0.0F, 0.0F, 1.0F };
    const double dx = px - p->x, d2 = dx * dx + py * py + p->above * p->above, d = sqrt(d2);
    float rgb[3];
    wi[0] = (float)(dx / d);
    wi[1] = (float)(py / d);
    wi[2] = (float)(p->above / d);
    *steradians = p->above / (d * d2);
    glint_eval(p->material, NULL, NULL, up, wi, NULL, rgb);
    return (double)rgb[0];
}

/* The integral of f cos over what is seen, or over all, by the midpoint rule. */
static inline double penumbra_brute_force(const penumbra *p, int all)
{
    enum { STEPS = 400 };
    double sum = 0.0;
    for (int a = 0; a < STEPS; ++a) {
        const double px = p->middle + p->wide * ((a + 0.5) / STEPS - 0.5);
        for (int b = 0; b < STEPS && (all || penumbra_sees(p, px)); ++b) {
            float wi[3];
            double steradians;
            const double f = penumbra_reflects(p, px, p->deep * ((b + 0.5) / STEPS - 0.5), wi, &steradians);
            sum += f * steradians;
        }
    }
    return sum * p->wide * p->deep / ((double)STEPS * STEPS);
}

/* The sums of a quotient: places that are seen, and all. */
typedef struct penumbra_sums {
    double place[7], weight[7];
    int count;
} penumbra_sums;

/* By the balance heuristic between 4 places even over the panel and `reflected` of the surface's own. */
static inline void penumbra_add(penumbra_sums *s, const penumbra *p, double px, double py, int reflected)
{
    static const float up[3] = { 0.0F, 0.0F, 1.0F };
    float wi[3];
    double steradians;
    const double f = penumbra_reflects(p, px, py, wi, &steradians);
    const double density = 4.0 / (steradians * p->wide * p->deep) +
                           (reflected > 0 ? reflected * (double)glint_pdf(p->material, NULL, NULL, up, wi) : 0.0);
    s->place[s->count] = px;
    s->weight[s->count++] = f / density;
}

/* src/preview/area_shadow.c in a few lines: one estimate of the share that is seen. */
static inline double penumbra_estimate(const penumbra *p, int reflected, uint64_t *random)
{
    static const float up[3] = { 0.0F, 0.0F, 1.0F };
    penumbra_sums s = { .count = 0 };
    const double u = random_uniform(random), v = random_uniform(random);
    for (int i = 0; i < 4; ++i)
        penumbra_add(&s, p, p->middle + p->wide * (0.5 * (i % 2 + u) - 0.5), p->deep * (0.5 * (i / 2 + v) - 0.5),
                     reflected);
    for (int i = 0; i < reflected; ++i) {
        const float three[3] = { (float)random_uniform(random), (float)random_uniform(random),
                                 (float)random_uniform(random) };
        glint_sample d;
        if (!glint_sample_direction(p->material, NULL, NULL, up, three, &d) || !(d.wi[2] > 0.0F))
            continue;
        const double far = p->above / (double)d.wi[2], px = p->x + far * (double)d.wi[0], py = far * (double)d.wi[1];
        if (fabs(px - p->middle) <= 0.5 * p->wide && fabs(py) <= 0.5 * p->deep)
            penumbra_add(&s, p, px, py, reflected);
    }
    double all = 0.0, asked = 0.0, seen = 0.0;
    for (int i = 0; i < s.count; ++i)
        all += s.weight[i];
    for (int i = 0; i < s.count; ++i)
        if (s.weight[i] >= 0.01 * all) { /* less is not worth a ray */
            asked += s.weight[i];
            seen += penumbra_sees(p, s.place[i]) ? s.weight[i] : 0.0;
        }
    return asked > 0.0 ? seen / asked : 1.0;
}

#endif
