/* Brings points into the structure of arrays in which they look at lights. */
#include "preview/light_batch.h"

static void put(double to[3][LIGHT_BATCH], int i, vec3 a)
{
    to[0][i] = a.x;
    to[1][i] = a.y;
    to[2][i] = a.z;
}

static void put_layer(light_layer *to, int i, const shade_layer *from)
{
    put(to->x, i, from->x);
    put(to->y, i, from->y);
    put(to->z, i, from->z);
    for (int c = 0; c < 3; ++c)
        to->wo[c][i] = from->wo[c];
    to->alpha_x[i] = from->surface.alpha_x;
    to->alpha_y[i] = from->surface.alpha_y;
}

void light_batch_set(light_batch *b, int i, const hit *h, const shade_point *p, const sampler *random)
{
    put(b->place, i, h->position);
    put(b->origin, i, hit_leave(h, h->shadow_origin));
    b->pixel[i] = random->pixel;
    b->reversed[i] = random->reversed;
    put_layer(&b->layer[0], i, &p->layers[0]);
    if (EFFECT_COATS && b->layers == 2)
        put_layer(&b->layer[1], i, &p->layers[shade_layers(p) == 2]);
}

light_view light_batch_view(const light_batch *b, int point)
{
    return (light_view){ .wi = v3(b->wi[0][point], b->wi[1][point], b->wi[2][point]),
                         .distance = b->distance[point],
                         .irradiance = { b->irradiance[0][point], b->irradiance[1][point], b->irradiance[2][point] },
                         .solid_angle_sr = b->solid_angle_sr[point],
                         .sine = b->sine[point] };
}
