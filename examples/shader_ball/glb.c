/* Writes GLB by the layout of the glTF 2.0 text, section 4.4: header, JSON chunk, BIN chunk, all little-endian. */
#include "glb.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COMPONENT_UNSIGNED_INT = 5125, COMPONENT_FLOAT = 5126, TARGET_ARRAY = 34962, TARGET_ELEMENT_ARRAY = 34963 };
enum { ACCESSORS_A_MESH = 5, VIEWS_A_MESH = 2 };

/* Room for count + extra elements, at least doubling what there was. */
static void *grow(void *memory, uint32_t count, uint32_t extra, uint32_t *capacity, size_t element_size)
{
    if (count + extra <= *capacity)
        return memory;
    *capacity = 2 * (count + extra);
    memory = realloc(memory, *capacity * element_size);
    if (!memory) {
        fprintf(stderr, "make_shader_ball: no memory for %u elements\n", *capacity);
        exit(1);
    }
    return memory;
}

void glb_add_vertex(glb_mesh *mesh, const glb_vertex *vertex)
{
    mesh->vertices = grow(mesh->vertices, mesh->vertex_count, 1, &mesh->vertex_capacity, sizeof *vertex);
    mesh->vertices[mesh->vertex_count++] = *vertex;
}

void glb_add_triangle(glb_mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    mesh->indices = grow(mesh->indices, mesh->index_count, 3, &mesh->index_capacity, sizeof *mesh->indices);
    uint32_t *corner = &mesh->indices[mesh->index_count];
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    mesh->index_count += 3;
}

void glb_mesh_free(glb_mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->indices);
    *mesh = (glb_mesh){ 0 };
}

/* ---- the JSON chunk ---- */

typedef struct text {
    char *bytes;
    uint32_t count, capacity;
} text;

static void __attribute__((format(printf, 2, 3))) append(text *t, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    t->bytes = grow(t->bytes, t->count, (uint32_t)length + 1, &t->capacity, 1);
    va_start(arguments, format);
    vsnprintf(t->bytes + t->count, (size_t)length + 1, format, arguments);
    va_end(arguments);
    t->count += (uint32_t)length;
}

static void append_mesh(text *t, const glb_mesh *mesh, size_t index)
{
    const size_t first = ACCESSORS_A_MESH * index;
    append(t,
           "%s{\"name\":\"%s\",\"primitives\":[{\"attributes\":{\"POSITION\":%zu,\"NORMAL\":%zu,\"TANGENT\":%zu,"
           "\"TEXCOORD_0\":%zu},\"indices\":%zu,\"material\":%d}]}",
           index ? "," : "", mesh->name, first, first + 1, first + 2, first + 3, first + 4, mesh->material);
}

static void append_attribute(text *t, size_t view, size_t offset, uint32_t count, const char *type, const char *bounds)
{
    append(t, "{\"bufferView\":%zu,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%u,\"type\":\"%s\"%s},", view,
           offset, COMPONENT_FLOAT, count, type, bounds);
}

static void append_accessors(text *t, const glb_mesh *mesh, size_t index)
{
    float low[3] = { FLT_MAX, FLT_MAX, FLT_MAX }, high[3] = { -FLT_MAX, -FLT_MAX, -FLT_MAX };
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], mesh->vertices[i].position[k]);
            high[k] = fmaxf(high[k], mesh->vertices[i].position[k]);
        }
    }
    /* Nine digits bring a float back to the same bits, and the glTF text asks that the bounds be exact. */
    char bounds[256];
    snprintf(bounds, sizeof bounds, ",\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]", (double)low[0],
             (double)low[1], (double)low[2], (double)high[0], (double)high[1], (double)high[2]);
    const size_t view = VIEWS_A_MESH * index;
    if (index)
        append(t, ",");
    append_attribute(t, view, offsetof(glb_vertex, position), mesh->vertex_count, "VEC3", bounds);
    append_attribute(t, view, offsetof(glb_vertex, normal), mesh->vertex_count, "VEC3", "");
    append_attribute(t, view, offsetof(glb_vertex, tangent), mesh->vertex_count, "VEC4", "");
    append_attribute(t, view, offsetof(glb_vertex, texcoord), mesh->vertex_count, "VEC2", "");
    append(t, "{\"bufferView\":%zu,\"componentType\":%d,\"count\":%u,\"type\":\"SCALAR\"}", view + 1,
           COMPONENT_UNSIGNED_INT, mesh->index_count);
}

static size_t vertex_bytes(const glb_mesh *mesh)
{
    return mesh->vertex_count * sizeof *mesh->vertices;
}

static size_t index_bytes(const glb_mesh *mesh)
{
    return mesh->index_count * sizeof *mesh->indices;
}

static text make_json(const char *members, const glb_mesh *meshes, size_t mesh_count)
{
    text t = { 0 };
    append(&t, "{%s,\"meshes\":[", members);
    for (size_t i = 0; i < mesh_count; i++)
        append_mesh(&t, &meshes[i], i);
    append(&t, "],\"accessors\":[");
    for (size_t i = 0; i < mesh_count; i++)
        append_accessors(&t, &meshes[i], i);
    append(&t, "],\"bufferViews\":[");
    size_t offset = 0;
    for (size_t i = 0; i < mesh_count; i++) {
        append(&t, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"byteStride\":%zu,\"target\":%d},",
               i ? "," : "", offset, vertex_bytes(&meshes[i]), sizeof(glb_vertex), TARGET_ARRAY);
        offset += vertex_bytes(&meshes[i]);
        append(&t, "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":%d}", offset,
               index_bytes(&meshes[i]), TARGET_ELEMENT_ARRAY);
        offset += index_bytes(&meshes[i]);
    }
    append(&t, "],\"buffers\":[{\"byteLength\":%zu}]}", offset);
    while (t.count % 4 != 0)
        append(&t, " ");
    return t;
}

/* ---- the file ---- */

static void put_word(FILE *file, uint32_t word)
{
    for (int shift = 0; shift < 32; shift += 8)
        putc((int)(word >> shift & 0xFFU), file);
}

static void put_floats(FILE *file, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        put_word(file, bits);
    }
}

static void put_mesh(FILE *file, const glb_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        put_floats(file, mesh->vertices[i].position, 3);
        put_floats(file, mesh->vertices[i].normal, 3);
        put_floats(file, mesh->vertices[i].tangent, 4);
        put_floats(file, mesh->vertices[i].texcoord, 2);
    }
    for (uint32_t i = 0; i < mesh->index_count; i++)
        put_word(file, mesh->indices[i]);
}

static void put_glb(FILE *file, const text *json, const glb_mesh *meshes, size_t mesh_count)
{
    enum { HEADER_BYTES = 12, CHUNK_HEADER_BYTES = 8 };
    size_t bin_bytes = 0;
    for (size_t i = 0; i < mesh_count; i++)
        bin_bytes += vertex_bytes(&meshes[i]) + index_bytes(&meshes[i]);

    put_word(file, 0x46546C67U); /* "glTF" */
    put_word(file, 2);
    put_word(file, (uint32_t)(HEADER_BYTES + 2 * CHUNK_HEADER_BYTES + json->count + bin_bytes));
    put_word(file, json->count);
    put_word(file, 0x4E4F534AU); /* "JSON" */
    fwrite(json->bytes, 1, json->count, file);
    put_word(file, (uint32_t)bin_bytes);
    put_word(file, 0x004E4942U); /* "BIN" */
    for (size_t i = 0; i < mesh_count; i++)
        put_mesh(file, &meshes[i]);
}

bool glb_write(const char *path, const char *members, const glb_mesh *meshes, size_t mesh_count)
{
    char partial[4096];
    if (snprintf(partial, sizeof partial, "%s.part", path) >= (int)sizeof partial) {
        fprintf(stderr, "make_shader_ball: the path has more than %zu characters\n", sizeof partial - 6);
        return false;
    }
    FILE *file = fopen(partial, "wb");
    if (!file) {
        perror(partial);
        return false;
    }
    text json = make_json(members, meshes, mesh_count);
    put_glb(file, &json, meshes, mesh_count);
    free(json.bytes);
    const bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed || rename(partial, path) != 0) {
        perror(path);
        remove(partial);
        return false;
    }
    return true;
}
