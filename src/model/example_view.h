/* What lies under one footprint: the example in its own coordinates, who else covers it, its tiles and its seeds by
 * fours. Shared by example_density.c, example_tiled.c, example_kernel.c, example_cover.c and example_quad.c. */
#ifndef MODEL_EXAMPLE_VIEW_H
#define MODEL_EXAMPLE_VIEW_H

#include "model/example.h"
#include "model/tint.h"

/* Half of the square of the reach: exponents beyond it are left out. */
#define LAST_EXPONENT (0.5F * SLOPE_REACH * SLOPE_REACH)

/* The ellipse that a footprint reaches, seeds and all, as a box and a circle on the lattice. */
typedef struct extent {
    float at[2], half[2], radius;
} extent;

/* Scattered examples that reach into a footprint. Spread and radius are bounded so that no more fit: 3.5 * .6 + 1.06
 * lattice units around, one centre a cell. */
enum { MOST_NEAR = 64 };

typedef struct neighbours {
    instance at[MOST_NEAR];
    int count;
} neighbours;

void neighbours_find(const lattice *l, const example_footprint *f, const extent *r, uint32_t seed, neighbours *list);

/* Who may own a part of what self shows: a bit for each neighbour. */
typedef uint64_t rivals;

rivals rivals_of(const neighbours *list, int self);

/* Drops the rivals that cannot own a part of the disc around (x, y). False: one of them owns all of it. self: NULL for
 * the ground. */
int rivals_within(const neighbours *list, const instance *self, rivals *r, float x, float y, float radius);
/* Which of the four points at -+ right -+ up are self's, a bit each: (-, -), (+, -), (-, +), (+, +). */
uint32_t quarters_owned(const neighbours *list, const instance *self, rivals r, const float at[2], const float right[2],
                        const float up[2]);

/* One example under the footprint, in its own coordinates. */
typedef struct example_view {
    const example *e;
    const instance *self;
    const instance *owner;       /* self; NULL for the ground, which lies below all examples */
    const neighbours *others;    /* NULL: nobody overlaps */
    int wants_value;             /* else only its mass */
    int wants_mass;              /* also of its dark parts */
    float texel;                 /* side of one */
    float mean[2];               /* centre of the footprint */
    float half[2];               /* and how far it reaches, seed and all */
    covariance2 precision;       /* inverse of footprint and seed together */
    float norm;                  /* 1 / (2 pi sqrt(det)) of it */
    float quad_curve;            /* how much the footprint varies across a quad by its curvature alone */
    covariance2 posterior;       /* of the place within a seed, given the footprint */
    float slope[2];              /* what is asked for */
    float slope_variance;        /* of the surface and the light */
    slope_blend blend;           /* of the maps, for that variance */
    float slope_scale;           /* density of slopes here to that on the lattice */
    const tint_palette *palette; /* NULL: all facets have the base colour */
    uint32_t tint_seed;          /* of this example */
} example_view;

typedef struct gathered {
    float value, mass;
    float tint[3]; /* what tints add to value */
} gathered;

/* One question about one footprint. */
typedef struct question {
    const example *e;
    const example_footprint *f;
    const float *slope;
    float light_variance;
    uint32_t seed;
    extent reach;
    const tint_palette *palette;
} question;

/* The footprint and the slope as one example sees them. */
example_view example_view_of(const question *q, const instance *self);

/* Adds what one example shows. */
void example_descend(const example_view *v, rivals all, gathered *sum);

/* Adds what examples show that lie side by side, one in every square of the lattice. */
void example_gather_tiled(const question *q, int wants_mass, gathered *sum);

/* Flat texels are facets with a tint each. Where normals vary between texels there are no facets, and the tint is the
 * whole example's. */
static inline int example_tints_texels(const example_view *v)
{
    return v->palette && v->e->is_flat;
}

/* Which tints an instance has. */
uint32_t example_tint_seed(const example_footprint *f, const instance *self, uint32_t seed);

/* Adds the tint of a texel, row by row, of what it adds to value. */
void example_add_tint(const example_view *v, uint32_t texel, float value, gathered *sum);

/* The quarters of a tile that may have seeds with the slope, a bit each. */
uint32_t example_lit_quarters(const example_view *v, int level, uint32_t x, uint32_t y);

/* Adds the seeds of a quad whose bits are set in owned: Eq. 6. is_dark: their slopes are known to be out of reach. */
void example_take_quad(const example_view *v, uint32_t x, uint32_t y, uint32_t owned, int is_dark, gathered *sum);

#endif
