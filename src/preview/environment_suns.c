/* Finds the suns of a map: spots of few texels that are far brighter than the whole.
 *
 * A facet that reflects a sun flashes, and how many do depends on the sun's size. So a sun must be one light with its
 * own solid angle, and not a chance of the sampling.
 */
#include <stdlib.h>

#include "preview/environment.h"

/* Taste, all three. A sun is this much brighter than the mean of the map, ... */
#define CONTRAST 32.0
/* ... no wider than a ball of 6 degrees, over which D may well change, ... */
#define LARGEST_SR 0.01
/* ... and gives at least this share of the light. */
#define LEAST_SHARE 0.005

#define UNSEEN 0U
#define DIM 1U

typedef struct spot {
    uint32_t label;
    double solid_angle, level, square; /* integrals of 1, L and L^2 over the spot */
    double rgb[3];
    vec3 towards; /* of L * direction, in the map */
} spot;

typedef struct search {
    const environment_map *map;
    uint32_t *label; /* of every texel */
    uint32_t *queue; /* texels whose neighbours are still to be looked at */
    double threshold, total;
} search;

static void measure(search *s)
{
    const environment_map *const m = s->map;
    s->total = 0.0;
    for (int y = 0; y < m->height; ++y) {
        const double sr = environment_texel_sr(m, y);
        for (int x = 0; x < m->width; ++x)
            s->total += sr * environment_level(&m->rgb[3 * ((size_t)y * (size_t)m->width + (size_t)x)]);
    }
    s->threshold = CONTRAST * s->total / (4.0 * PREVIEW_PI);
}

static void add_texel(const search *s, uint32_t texel, spot *to)
{
    const environment_map *const m = s->map;
    const int x = (int)(texel % (uint32_t)m->width), y = (int)(texel / (uint32_t)m->width);
    const float *const rgb = &m->rgb[3 * (size_t)texel];
    const double sr = environment_texel_sr(m, y), level = environment_level(rgb);
    double d[3];
    environment_map_direction((x + 0.5) / m->width, (y + 0.5) / m->height, d);
    to->solid_angle += sr;
    to->level += sr * level;
    to->square += sr * level * level;
    to->towards = v3_mad(to->towards, v3(d[0], d[1], d[2]), sr * level);
    for (int c = 0; c < 3; ++c)
        to->rgb[c] += sr * (double)rgb[c];
}

/* Labels a texel that is bright and not yet seen, and puts it into the queue. */
static void visit(search *s, int x, int y, uint32_t label, size_t *queued)
{
    const int width = s->map->width;
    if (y < 0 || y >= s->map->height)
        return;
    const size_t texel = (size_t)y * (size_t)width + (size_t)((x + width) % width);
    if (s->label[texel] != UNSEEN)
        return;
    const bool bright = environment_level(&s->map->rgb[3 * texel]) > s->threshold;
    s->label[texel] = bright ? label : DIM;
    if (bright)
        s->queue[(*queued)++] = (uint32_t)texel;
}

/* The connected bright texels around one, corners included, and over the seam at the map's sides. */
static spot flood(search *s, int x, int y, uint32_t label)
{
    spot found = { .label = label };
    size_t queued = 0;
    visit(s, x, y, label, &queued);
    for (size_t i = 0; i < queued; ++i) {
        const int column = (int)(s->queue[i] % (uint32_t)s->map->width);
        const int row = (int)(s->queue[i] / (uint32_t)s->map->width);
        add_texel(s, s->queue[i], &found);
        for (int k = 0; k < 9; ++k)
            visit(s, column + k % 3 - 1, row + k / 3 - 1, label, &queued);
    }
    return found;
}

/* Keeps the spots with the most light, in falling order. */
static void keep(spot *best, int *count, const spot *found)
{
    int at = *count < ENVIRONMENT_MOST_SUNS ? (*count)++ : ENVIRONMENT_MOST_SUNS - 1;
    if (at == ENVIRONMENT_MOST_SUNS - 1 && best[at].label != 0 && best[at].level >= found->level)
        return;
    for (; at > 0 && best[at - 1].level < found->level; --at)
        best[at] = best[at - 1];
    best[at] = *found;
}

static void search_spots(search *s, spot *best, int *count)
{
    uint32_t label = DIM + 1U;
    for (int y = 0; y < s->map->height; ++y) {
        for (int x = 0; x < s->map->width; ++x) {
            const spot found = flood(s, x, y, label);
            if (!(found.solid_angle > 0.0))
                continue;
            ++label;
            if (found.solid_angle <= LARGEST_SR && found.level >= LEAST_SHARE * s->total)
                keep(best, count, &found);
        }
    }
}

/* A sun as wide as a disc of even radiance with the same light and the same integral of L^2, (int L)^2 / int L^2: a rim
 * of half-lit texels does not count in full. */
static scene_light to_light(const environment *e, const spot *from)
{
    const double solid_angle = from->level * from->level / from->square;
    const vec3 d = v3_normalize(from->towards);
    const double *const m = e->to_map;
    const vec3 z = v3(m[0] * d.x + m[3] * d.y + m[6] * d.z, m[1] * d.x + m[4] * d.y + m[7] * d.z,
                      m[2] * d.x + m[5] * d.y + m[8] * d.z);
    const vec3 x = v3_any_tangent(z);
    scene_light sun = { .kind = SCENE_LIGHT_DIRECTIONAL, .intensity = 1.0F };
    for (int c = 0; c < 3; ++c)
        sun.color[c] = (float)((double)e->scale * from->rgb[c]);
    /* 2 pi (1 - cos(d / 2)) = 4 pi sin^2(d / 4) */
    sun.angular_diameter_rad = (float)(4.0 * asin(sqrt(solid_angle / (4.0 * PREVIEW_PI))));
    m4_from_axes(x, v3_cross(z, x), z, v3(0.0, 0.0, 0.0), sun.to_world);
    return sun;
}

bool environment_find_suns(environment *e, report *r)
{
    const size_t texels = (size_t)e->map->width * (size_t)e->map->height;
    search s = { .map = e->map, .label = calloc(texels, sizeof *s.label), .queue = malloc(texels * sizeof *s.queue) };
    if (s.label == NULL || s.queue == NULL) {
        free(s.label);
        free(s.queue);
        return report_error(r, "no memory to look for suns in %d x %d texels", e->map->width, e->map->height);
    }
    spot best[ENVIRONMENT_MOST_SUNS] = { { 0 } };
    measure(&s);
    search_spots(&s, best, &e->sun_count);
    for (int i = 0; i < e->sun_count; ++i)
        e->suns[i] = to_light(e, &best[i]);
    for (size_t t = 0; t < texels; ++t) {
        e->patch_sr[t] = 1.0F;
        for (int i = 0; i < e->sun_count; ++i)
            if (s.label[t] == best[i].label)
                e->patch_sr[t] = 0.0F;
    }
    free(s.label);
    free(s.queue);
    return true;
}
