/* What the parts of the POV-Ray exporter share: the scene, how it is seen, and the texts that are written.
 *
 * Coordinates are those of glTF, right-handed with y up: POV-Ray is left-handed only by the camera that it assumes, and
 * ours brings its own. One metre is `unit` units of POV-Ray, a power of ten that keeps scenes near the size that its
 * tolerances (1e-3 for shadows) are made for.
 */
#ifndef EXPORTERS_POVRAY_POVRAY_H
#define EXPORTERS_POVRAY_POVRAY_H

#include "exporters/povray/folder.h"
#include "exporters/povray/linear.h"
#include "exporters/povray/notes.h"
#include "exporters/povray/text.h"
#include "glint_export.h"
#include "io/image.h"
#include "scene/scene.h"

/* Where pictures are taken from: unit axes, half the picture's extent at distance one (perspective) or in metres. */
typedef struct eye {
    bool perspective;
    vec at, right, up, forward;
    double half_width, half_height;
} eye;

typedef struct povray {
    const scene *scene;
    const glint_export_povray_options *options;
    const textures *textures; /* for the means of those that POV-Ray cannot show */
    report *report;           /* of errors */
    notes *notes;             /* of what is left out or added */
    char file[NAME_LENGTH];   /* what the files are called, without their endings */
    double unit;
    vec centre; /* of the scene, metres */
    double radius;
    eye eye;
    const scene_light *lights; /* the scene's, or the studio's */
    int light_count;
    bool studio;             /* the scene brings no light, the studio does */
    text materials, objects; /* the texts of two files */
    int image_count;         /* how many of the scene's images are written */
    bool *image_used;        /* one for each image of the scene */
    char (*material_name)[NAME_LENGTH];
} povray;

/* ---- eye.c ---- */

/* The camera that the options name, else the first, else one that frames the scene. */
bool eye_choose(povray *p);
/* A camera of the file, or NULL for the framing one. */
void eye_write(const povray *p, text *out);

/* ---- light.c ---- */

enum { STUDIO_LIGHTS = 3 };
/* Key, fill and rim around the eye's view. */
void studio_lights(const povray *p, scene_light lights[STUDIO_LIGHTS]);
void lights_write(const povray *p, text *out);
/* What the size of the lights, on average over their power, adds to the square of a lobe's roughness. */
double lights_width2(const povray *p);
/* Where the only light stands, metres, when there is one and it is small enough to be a point. */
bool lights_single_point(const povray *p, vec *at);

/* ---- material.c ---- */

/* What a material is after the means of its textures: read by every object that wears it. */
typedef struct material_look {
    const scene_material *material;
    glint_surface surface;
    bool flakes;    /* discrete in the base layer */
    int base_image; /* the image that colours the base, or SCENE_NONE */
    float lobe;     /* roughness of a flake's highlight */
    float edge_m;   /* edge of a square flake of the same area */
    bool anisotropic;
} material_look;

material_look material_look_of(const povray *p, int material);
/* A #macro that sets the parameters of glint.inc, and one texture for objects of any shape. */
void material_write(povray *p, int material);
/* Says what of a material is left out. */
void material_warn(const povray *p, int material);

/* ---- object.c ---- */

void objects_write(povray *p);

/* ---- flat.c ---- */

/* A plane on which flakes lie: world = at + x across + y along + z normal, metres, the three unit and orthogonal; a
 * point with the flake coordinates (u, v) in metres is at (u, v) * stretch. */
typedef struct flat {
    vec at, across, along, normal;
    double stretch;
} flat;

/* Whether all of the instance lies in one plane, and its flakes without shear; false otherwise. */
bool flat_find(const scene *s, const scene_instance *instance, flat *out);

/* ---- flake_mesh.c ---- */

/* Writes the instance as a mesh2 with one polygon a flake. False when there are more than a million, with their number
 * in *count. */
bool flake_mesh_write(const povray *p, const scene_instance *instance, uint32_t seed, text *out, double *count);

/* ---- texture.c ---- */

/* The file that an image is written to, relative to the folder; NULL where POV-Ray cannot read its format. */
const char *texture_file(const povray *p, int index, char out[2 * NAME_LENGTH]);
bool textures_write(const povray *p, folder *f);

#endif
