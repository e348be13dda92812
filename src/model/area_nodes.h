/* The sums of area_plain.h over the points of one light, eight of them at a time. */
#ifndef MODEL_AREA_NODES_H
#define MODEL_AREA_NODES_H

#include "light/cubature.h"
#include "model/area.h"

enum { AREA_ROOM = 8 };

/* plain_quad's of a light, at every second place; w and the sizes by place are not set but for polygons. */
typedef struct area_parts {
    float middle[3][AREA_ROOM], u[3][AREA_ROOM], v[3][AREA_ROOM], w[3][AREA_ROOM];
    float size[AREA_ROOM], size_x[AREA_ROOM], size_y[AREA_ROOM];
} area_parts;

/* What area_lobe has. */
typedef struct area_eye {
    int is_ggx, is_schlick, has_base;
    vec3 wo;
    float visible_o, alpha_x, alpha_y;
} area_eye;

/* That, and a light. */
typedef struct area_nodes {
    area_eye eye;
    int is_bent, count; /* bent: the parts are those of a polygon */
    area_parts parts;
} area_nodes;

/* plain_sums. */
typedef struct area_node_sums {
    float reflected, fresnel[2], facets, x, y, z, cap;
    float cosine[3]; /* zero without has_base */
} area_node_sums;

typedef void area_nodes_sum(const area_nodes *n, const cubature *rule, area_node_sums *sums);

/* What the query asks of the lobe, and what its sums come to. */
area_eye area_eye_of(const model_query *q);
void area_shade(const model_query *q, const area_node_sums *sums, area_value *value);

/* Sets parts, of a polygon of 3 to 8 corners; and returns plain_light's rule, and what is left. */
typedef int area_fan_of(const float (*corner)[3], int count, int two_sided, area_nodes *n, float *left);

/* The same source, and so the same bits, for the processor that the library is compiled for and for one with AVX2. */
area_nodes_sum area_nodes_sum_base, area_nodes_sum_avx2;
area_fan_of area_fan_of_base, area_fan_of_avx2;

#endif
