/* A scene as plain structs: what a file says, checked and in metres, with nothing about how it is rendered.
 *
 * Every index is either valid or SCENE_NONE. All memory belongs to the scene and goes with scene_free. Matrices are
 * column-major as in glTF; y is up; a camera looks along -z, a light shines along -z.
 */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "glint.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SCENE_NONE (-1)

/* An image is a file on disk, the bytes of one held by the scene, or texels, never two of them. Files are decoded by
 * src/io/image.h. */
typedef struct scene_image {
    char *name; /* for messages: the path, or the JSON pointer of an embedded image */
    char *path; /* NULL when the bytes are here */
    uint8_t *bytes;
    size_t byte_count;
    uint16_t *texels;  /* RGBA, straight alpha, row 0 on top: what a 16-bit file of it would hold. NULL: a file */
    int width, height; /* of the texels */
} scene_image;

typedef enum scene_wrap { SCENE_WRAP_REPEAT, SCENE_WRAP_CLAMP, SCENE_WRAP_MIRROR } scene_wrap;

/* One use of an image: sampler, KHR_texture_transform and the factor that belongs to the kind of texture. */
typedef struct scene_texture {
    int image;    /* SCENE_NONE: no texture */
    int texcoord; /* 0 or 1 */
    scene_wrap wrap_s, wrap_t;
    bool nearest; /* the sampler asks for unfiltered texels */
    bool srgb;    /* colours: decode before filtering */
    float offset[2], rotation, scale[2];
    float strength; /* normalTexture.scale, occlusionTexture.strength; else 1 */
} scene_texture;

typedef enum scene_alpha_mode { SCENE_ALPHA_OPAQUE, SCENE_ALPHA_MASK, SCENE_ALPHA_BLEND } scene_alpha_mode;
typedef enum scene_glint_space { SCENE_SPACE_UV, SCENE_SPACE_OBJECT } scene_glint_space;
typedef enum scene_glint_layer { SCENE_LAYER_BASE, SCENE_LAYER_CLEARCOAT } scene_glint_layer;
typedef enum scene_glint_structure { SCENE_STRUCTURE_FLAKES, SCENE_STRUCTURE_EXAMPLE } scene_glint_structure;
typedef enum scene_glint_placement { SCENE_PLACEMENT_TILED, SCENE_PLACEMENT_SCATTERED } scene_glint_placement;

/* GLINT_materials_glint, property by property. */
typedef struct scene_glint {
    bool present;
    float factor;
    scene_texture texture; /* R multiplies factor */
    glint_distribution distribution;
    float density;                 /* facets per m^2 */
    scene_texture density_texture; /* G multiplies density */
    float facet_roughness;         /* alpha is its square */
    float color[3];
    scene_texture color_texture;
    float color_variation;
    uint32_t color_count;              /* of colors */
    float colors[GLINT_MAX_COLORS][3]; /* what facets are tinted with, relative to their mean */
    float elongation;
    float coverage;
    float density_variation;
    scene_glint_space space;
    int texcoord;
    float uv_scale; /* metres per UV unit */
    scene_glint_layer layer;
    uint32_t seed;
    scene_glint_structure structure;
    scene_texture example_texture;
    scene_glint_placement example_placement;
    float example_size;                                        /* metres */
    float example_rotation_variation, example_scale_variation; /* of scattered examples: rad, relative; either way */
} scene_glint;

typedef struct scene_material {
    char *name;
    float base_color[4];
    scene_texture base_color_texture;
    float metallic, roughness;
    scene_texture metallic_roughness_texture; /* G roughness, B metallic */
    scene_texture normal_texture, occlusion_texture, emissive_texture;
    float emissive[3]; /* KHR_materials_emissive_strength multiplied in */
    scene_alpha_mode alpha_mode;
    float alpha_cutoff;
    bool double_sided;
    bool unlit;
    float ior; /* 1.5; 0 means the Fresnel term is 1 (KHR_materials_ior) */
    float specular, specular_color[3];
    scene_texture specular_texture, specular_color_texture; /* A; RGB */
    float anisotropy, anisotropy_rotation;
    scene_texture anisotropy_texture;
    float clearcoat, clearcoat_roughness;
    scene_texture clearcoat_texture, clearcoat_roughness_texture, clearcoat_normal_texture; /* R; G */
    scene_glint glint;      /* of the material: of the layer that it names */
    scene_glint coat_glint; /* of KHR_materials_clearcoat: of the coat, beside glint in the base */
} scene_material;

/* One glTF primitive as triangles. Arrays that a file leaves out and that cannot be computed are NULL. */
typedef struct scene_mesh {
    char *name; /* for messages: "meshes/3/primitives/0" */
    uint32_t vertex_count, triangle_count;
    float *position;    /* 3 a vertex */
    float *normal;      /* 3, unit; never NULL: flat normals are computed, with vertices split */
    float *tangent;     /* 4, unit, w is the handedness; NULL without texture coordinates */
    float *texcoord[2]; /* 2 */
    float *color;       /* 4, linear */
    uint32_t *index;    /* 3 a triangle */
    int material;       /* never SCENE_NONE: the default material is in the scene */
} scene_mesh;

typedef struct scene_instance {
    char *name; /* of the node; may be empty */
    int mesh;
    float to_world[16];
    int node; /* of the file: instances of one node share the seed offset */
} scene_instance;

typedef enum scene_projection { SCENE_PERSPECTIVE, SCENE_ORTHOGRAPHIC } scene_projection;

typedef struct scene_camera {
    char *name;
    scene_projection projection;
    float yfov_rad;    /* perspective */
    float aspect;      /* width over height; 0: that of the picture */
    float xmag, ymag;  /* orthographic: half width and half height in metres */
    float znear, zfar; /* zfar 0: none */
    /* The part of the plane that fills the picture: left, right, bottom, top; perspective: at 1 m in front,
     * orthographic: in metres. In place of yfov, aspect, xmag and ymag where left < right: it can be shifted. */
    float window[4];
    float to_world[16];
} scene_camera;

typedef enum scene_light_kind {
    SCENE_LIGHT_DIRECTIONAL,
    SCENE_LIGHT_POINT,
    SCENE_LIGHT_SPOT,
    SCENE_LIGHT_RECT, /* from -width / 2 to width / 2 along x, likewise y; shines to one side, along -z */
    SCENE_LIGHT_DISK  /* width is its diameter, and so is height */
} scene_light_kind;

/* KHR_lights_punctual and EXT_lights_area. Intensity is taken as it stands: directional E (W/m^2), point and spot
 * I (W/sr), rectangle and disk L (W/(m^2 sr), the extension's nits). */
typedef struct scene_light {
    char *name;
    scene_light_kind kind;
    float color[3], intensity;
    float range; /* metres; 0: unlimited */
    float inner_cone_rad, outer_cone_rad;
    float angular_diameter_rad; /* directional: extras.angularDiameter (rad), default the sun's, .00929 */
    float radius_m;             /* point and spot: extras.radius (m), default .01 */
    float width_m, height_m; /* rectangle and disk, as large as they are in the world: to_world scales them no more */
    float to_world[16];
} scene_light;

/* EXT_lights_image_based: light from all around, on the faces of a cube seen from its middle. */
typedef struct scene_environment {
    bool present;
    char *name;
    int faces[6];      /* images of +x, -x, +y, -y, +z and -z; see io/environment_map.h for their orientation */
    float rotation[4]; /* a unit quaternion x y z w that turns the cube */
    float intensity;
} scene_environment;

typedef struct scene {
    char *path;
    scene_image *images;
    int image_count;
    scene_material *materials;
    int material_count;
    scene_mesh *meshes;
    int mesh_count;
    scene_instance *instances;
    int instance_count;
    scene_camera *cameras;
    int camera_count;
    scene_light *lights;
    int light_count;
    scene_environment environment;
    char **variants;
    int variant_count;
    float bounds_min[3], bounds_max[3]; /* of all instances, in world space; min > max when there are none */
} scene;

void scene_free(scene *s);

/* A material with the defaults of the glTF text and no glints. */
scene_material scene_material_default(void);
scene_texture scene_texture_none(void);
/* The glints of a layer, whichever extension they come from; NULL: there are none. */
const scene_glint *scene_layer_glint(const scene_material *m, scene_glint_layer layer);

#define SCENE_MATERIAL_TEXTURES 19
/* All textures of a material, those without an image included. They belong to m. */
void scene_material_textures(const scene_material *m, const scene_texture *list[SCENE_MATERIAL_TEXTURES]);

#ifdef __cplusplus
}
#endif

#endif
