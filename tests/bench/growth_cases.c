/* Scenes of any size: pixels, lights, materials, texels, triangles, and what facets a footprint holds. */
#include "growth_cases.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/scene_file.h"
#include "png_file.h"
#include "preview/preview.h"
#include "preview/trace.h"
#include "race.h"
#include "scenes.h"
#include "statistics.h"

growth_load growth_loaded;

static scene stage;
static preview_options options;
static scene_camera view;

static void stop(const char *what)
{
    fprintf(stderr, "growth: %s\n", what);
    exit(1);
}

/* A file that cases of one process use in turn; its reader goes by what is in it. */
static char temporary[] = "/tmp/glint-growth-XXXXXX.glb";
static bool has_temporary;

static FILE *open_temporary(void)
{
    const int descriptor = has_temporary ? -1 : mkstemps(temporary, 4);
    has_temporary = true;
    FILE *const file = descriptor >= 0 ? fdopen(descriptor, "wb") : fopen(temporary, "wb");
    if (file == NULL)
        stop("cannot write a file in /tmp");
    return file;
}

void growth_clean(void)
{
    if (has_temporary)
        unlink(temporary);
}

static void render(void)
{
    image picture;
    report r = { 0 };
    if (!preview_render(&stage, &options, &picture, NULL, &r))
        stop(r.error);
    image_free(&picture);
}

/* ---- pictures ---- */

/* A camera that sees all of a floor of 2 m by 2 m, and the floor's light. */
static void begin_picture(int side)
{
    static const float eye[3] = { 0.0F, 2.0F, 1.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    static const preview_sky black = { { 0 }, { 0 }, { 0 } };
    stage = scenes_empty();
    view = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, 0.8F);
    options = (preview_options)PREVIEW_OPTIONS_INIT;
    options.width = options.height = side;
    options.spp = 4;
    options.bounces = 0;
    options.threads = 1;
    options.camera = &view;
    options.sky = &black;
    options.accuracy = 0.02;
}

static void add_sun(void)
{
    static const float from[3] = { 0.2F, 1.0F, 0.3F };
    scenes_add_light(&stage, SCENE_LIGHT_DIRECTIONAL, from, 1.0F);
}

static void add_floor(void)
{
    const scene_material flakes = scenes_flakes(0.5F, 1e6F);
    scenes_add_instance(&stage, scenes_add_square(&stage, scenes_add_material(&stage, &flakes), 1.0F), NULL, 0);
}

static void prepare_pixels(double size)
{
    begin_picture((int)lround(sqrt(size)));
    add_floor();
    add_sun();
}

/* Points, spots, rectangles and suns over the floor, as strong together as one. */
static void prepare_lights(double size)
{
    static const scene_light_kind kinds[] = { SCENE_LIGHT_POINT, SCENE_LIGHT_SPOT, SCENE_LIGHT_RECT,
                                              SCENE_LIGHT_DIRECTIONAL };
    uint64_t random = 3;
    begin_picture(32);
    options.accuracy = 0.0;
    add_floor();
    for (int i = 0; i < (int)size; ++i) {
        const float from[3] = { (float)random_between(&random, -1.0, 1.0), (float)random_between(&random, 0.3, 1.5),
                                (float)random_between(&random, -1.0, 1.0) };
        scene_light *const l = scenes_add_light(&stage, kinds[i % 4], from, (float)(1.0 / size));
        l->width_m = l->height_m = 0.05F;
        if (l->kind == SCENE_LIGHT_RECT) /* as strong as the points */
            l->intensity /= l->width_m * l->height_m;
    }
}

/* The floor in as many squares, each of a material of its own. */
static void prepare_materials(double size)
{
    const int columns = (int)ceil(sqrt(size));
    begin_picture(64);
    add_sun();
    for (int i = 0; i < (int)size; ++i) {
        const scene_material flakes = scenes_flakes(0.3F + 0.3F * (float)i / (float)size, 1e5F * (float)(1 + i % 10));
        const float half = 1.0F / (float)columns;
        const int column = i % columns, row = i / columns;
        float place[16];
        scenes_translation(place, half * (float)(2 * column + 1) - 1.0F, 0.0F, half * (float)(2 * row + 1) - 1.0F);
        scenes_add_instance(&stage, scenes_add_square(&stage, scenes_add_material(&stage, &flakes), half), place, i);
    }
}

/* In a process of its own, whose memory does not count. */
static void write_texture(int side)
{
    const pid_t child = fork();
    if (child == 0) {
        const size_t texel_bytes = 4 * (size_t)side * (size_t)side;
        size_t file_bytes = 0;
        uint8_t *const texels = malloc(texel_bytes);
        for (size_t i = 0; texels != NULL && i < texel_bytes; ++i)
            texels[i] = (uint8_t)(128U + ((uint32_t)i * 2654435761U >> 25));
        const uint8_t *const png = texels != NULL ? png_file(texels, side, side, &file_bytes) : NULL;
        FILE *const file = open_temporary();
        _exit(png != NULL && fwrite(png, file_bytes, 1, file) == 1 && fclose(file) == 0 ? 0 : 1);
    }
    int status = 1;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
        stop("cannot write a texture");
}

static void prepare_texels(double size)
{
    const int side = (int)lround(sqrt(size));
    begin_picture(64);
    add_sun();
    fclose(open_temporary());
    write_texture(side);
    scene_material flakes = scenes_flakes(0.5F, 1e6F);
    static const uint8_t texel[4];
    flakes.base_color_texture = scenes_add_texture(&stage, texel, 1, 1);
    flakes.base_color_texture.nearest = false;
    scene_image *const from = &stage.images[flakes.base_color_texture.image];
    free(from->bytes);
    from->bytes = NULL;
    from->byte_count = 0;
    from->path = strdup(temporary);
    scenes_add_instance(&stage, scenes_add_square(&stage, scenes_add_material(&stage, &flakes), 1.0F), NULL, 0);
}

/* ---- triangles, from a file ---- */

/* A wavy square of side x side vertices, streamed, so that writing takes no memory. */
static void write_vertices(FILE *file, uint32_t side)
{
    for (uint32_t k = 0; k < side * side; ++k) {
        const uint32_t column = k % side, row = k / side;
        const double x = 2.0 * column / (side - 1) - 1.0, z = 2.0 * row / (side - 1) - 1.0;
        const float p[3] = { (float)x, (float)(0.05 * sin(9.0 * x) * cos(7.0 * z)), (float)z };
        fwrite(p, sizeof p, 1, file);
    }
}

static void write_indices(FILE *file, uint32_t side)
{
    for (uint32_t k = 0; k < side * (side - 1); ++k) {
        const uint32_t six[6] = { k, k + side, k + 1, k + 1, k + side, k + side + 1 };
        if (k % side != side - 1)
            fwrite(six, sizeof six, 1, file);
    }
}

static void write_glb(uint32_t side)
{
    char text[1200];
    const uint32_t vertices = side * side, indices = 6 * (side - 1) * (side - 1);
    const int length = snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2}]}],"
        "\"buffers\":[{\"byteLength\":%u}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%u},"
        "{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\",\"min\":[-1,-1,-1],\"max\":[1,1,1]},"
        "{\"bufferView\":0,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5125,\"count\":%u,\"type\":\"SCALAR\"}]}",
        12 * vertices + 4 * indices, 12 * vertices, 12 * vertices, 4 * indices, vertices, vertices, indices);
    const uint32_t padded = ((uint32_t)length + 3U) & ~3U, binary = 12 * vertices + 4 * indices;
    memset(text + length, ' ', padded - (uint32_t)length);
    FILE *const file = open_temporary();
    const uint32_t head[5] = { 0x46546C67U, 2U, 28U + padded + binary, padded, 0x4E4F534AU };
    const uint32_t chunk[2] = { binary, 0x004E4942U };
    fwrite(head, sizeof head, 1, file);
    fwrite(text, padded, 1, file);
    fwrite(chunk, sizeof chunk, 1, file);
    write_vertices(file, side);
    write_indices(file, side);
    if (fclose(file) != 0)
        stop("cannot write a file in /tmp");
}

static void prepare_triangles(double size)
{
    begin_picture(64);
    write_glb((uint32_t)lround(sqrt(0.5 * size)) + 1U);
}

static float opaque(const void *user, const trace_hit *at)
{
    (void)user;
    (void)at;
    return 1.0F;
}

/* From the file to what rays can be sent into, Embree's part measured in its midst. */
static void load(void)
{
    report r = { 0 };
    geometry g;
    trace_scene *traced = NULL;
    const double start = race_now_all();
    if (!scene_file_read(temporary, NULL, &stage, &r))
        stop(r.error);
    const double read = race_now_all();
    if (!geometry_make(&stage, &g, &r))
        stop(r.error);
    const double made = race_now_all();
    if (!trace_build(&g, TRACE_TREES_FINE, opaque, NULL, &traced, &r))
        stop(r.error);
    growth_loaded = (growth_load){ read - start, race_now_all() - made, race_now_all() - start };
}

/* ---- single evaluations: points that have nothing in common ---- */

enum { POINTS = 4096 };
static glint_material *material;
static glint_footprint footprints[POINTS];
static float wo[POINTS][3], wi[POINTS][3];

static void direction(uint64_t *random, float w[3])
{
    const double cosine = random_between(random, 0.3, 0.95), turn = random_between(random, 0.0, 6.2831853);
    const double sine = sqrt(1.0 - cosine * cosine);
    w[0] = (float)(sine * cos(turn));
    w[1] = (float)(sine * sin(turn));
    w[2] = (float)cosine;
}

/* Footprints of a square millimetre or so. */
static void prepare_points(double facets_per_m2, double ratio)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    uint64_t random = 17;
    o.surface.facets_per_m2 = (float)facets_per_m2;
    if (glint_material_create(&o, &material, NULL, 0) != GLINT_OK)
        stop("no material");
    for (int i = 0; i < POINTS; ++i) {
        const double size = random_log_between(&random, 3e-4, 3e-3), turn = random_between(&random, 0.0, 6.2831853);
        const double major = size * sqrt(ratio), minor = size / sqrt(ratio);
        footprints[i] = (glint_footprint){ random_between(&random, -1.0, 1.0),
                                           random_between(&random, -1.0, 1.0),
                                           (float)(major * cos(turn)),
                                           (float)(-minor * sin(turn)),
                                           (float)(major * sin(turn)),
                                           (float)(minor * cos(turn)),
                                           0U };
        direction(&random, wo[i]);
        direction(&random, wi[i]);
    }
}

/* The same points as a batch. */
static void evaluate_batch(void)
{
    static double u[POINTS], v[POINTS];
    static float steps[4][POINTS], directions[6][POINTS], solid_angle[POINTS], rgb[3][POINTS];
    glint_batch b = GLINT_BATCH_INIT;
    for (int i = 0; i < POINTS; ++i) {
        const glint_footprint *const f = &footprints[i];
        const float step[4] = { f->dudx, f->dudy, f->dvdx, f->dvdy };
        u[i] = f->u;
        v[i] = f->v;
        solid_angle[i] = 1e-3F;
        for (int k = 0; k < 4; ++k)
            steps[k][i] = step[k];
        for (int k = 0; k < 3; ++k) {
            directions[k][i] = wo[i][k];
            directions[3 + k][i] = wi[i][k];
        }
    }
    b.count = POINTS;
    b.u = u;
    b.v = v;
    b.dudx = steps[0];
    b.dudy = steps[1];
    b.dvdx = steps[2];
    b.dvdy = steps[3];
    b.solid_angle_sr = solid_angle;
    for (int k = 0; k < 3; ++k) {
        b.wo[k] = directions[k];
        b.wi[k] = directions[3 + k];
        b.rgb[k] = rgb[k];
    }
    if (glint_eval_batch(material, &b) != GLINT_OK)
        stop("no batch");
}

static void prepare_density(double size)
{
    prepare_points(size, 2.0);
}

static void prepare_ratio(double size)
{
    prepare_points(1e8, size);
}

static void evaluate(void)
{
    const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
    double sum = 0.0;
    for (int i = 0; i < POINTS; ++i) {
        float rgb[3];
        glint_eval(material, NULL, &footprints[i], wo[i], wi[i], &light, rgb);
        sum += (double)rgb[0];
    }
    if (!(sum >= 0.0))
        stop("an evaluation is no number");
}

/* ---- the table ---- */

const growth_case growth_cases[] = {
    { "resolution",
      "pixels",
      { 4096, 16384, 65536, 262144, 1048576 },
      { 256, 1024, 4096 },
      false,
      prepare_pixels,
      render },
    { "density",
      "facets per m^2",
      { 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14 },
      { 1e2, 1e6, 1e10, 1e14 },
      true,
      prepare_density,
      evaluate },
    { "batch",
      "facets per m^2",
      { 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14 },
      { 0 },
      true,
      prepare_density,
      evaluate_batch },
    { "footprint",
      "length over width",
      { 1, 2, 4, 8, 16, 32, 64, 125, 250, 500, 1000 },
      { 1, 8, 100, 1000 },
      true,
      prepare_ratio,
      evaluate },
    { "lights", "lights", { 1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024 }, { 64, 1024 }, true, prepare_lights, render },
    { "triangles", "triangles", { 1e3, 1e4, 1e5, 1e6, 1e7 }, { 1e3, 4e3, 1.6e4 }, false, prepare_triangles, load },
    { "textures",
      "texels",
      { 65536, 262144, 1048576, 4194304, 16777216, 67108864 },
      { 65536, 262144, 1048576 },
      false,
      prepare_texels,
      render },
    { "materials", "materials", { 1, 4, 16, 64, 256 }, { 16, 64, 256 }, false, prepare_materials, render },
};
const int growth_case_count = sizeof growth_cases / sizeof growth_cases[0];

__attribute__((noinline)) void growth_run(const growth_case *c)
{
    c->run();
}
