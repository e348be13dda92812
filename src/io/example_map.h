/* Normal maps of the example model: from a scene's texture to the options of libglint, and from normals to a file. */
#ifndef IO_EXAMPLE_MAP_H
#define IO_EXAMPLE_MAP_H

#include "scene/report.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Decodes glintExampleTexture and fills o->example, which then points to *normals: free it once the material is made.
 * A material without that texture leaves both as they are: flat facets stand in. What is no normal map, or has a size
 * that the model does not take, is an error that names the image. */
bool example_map_open(const scene *s, const scene_glint *g, glint_material_options *o, float **normals, report *r);

/* The texture that example_map_open takes for these size * size normals (x, y, z): PNG of 8 or 16 bits, normal
 * (x, -y, z) as colour (1 + n) / 2, row 0 on top. */
bool example_map_write_png(const char *path, const float *normals, int size, int bits, report *r);

#ifdef __cplusplus
}
#endif

#endif
