/* frames FILE.json [ROUNDS [SCENE.glb]]: whole pictures, as someone sees them who turns the shader ball: 1920 x 1080
 * pixels, one sample each, direct light, a million facets a square metre, no plan; lights of real size by the fast
 * integral, as in a viewport.
 *
 * With one thread the pictures race in processor time. With more they are timed by the clock, which a busy machine
 * makes slower. The counting kernel is held to eight lanes in one of them; Embree takes what the machine has.
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "io/scene_file.h"
#include "lanes.h"
#include "preview/stage.h"
#include "preview/tiles.h"
#include "race.h"

enum { WIDTH = 1920, HEIGHT = 1080, FRAMES = 3, MOST_THREADS = 2 };

/* Everything but the pixels is made before the first picture. */
typedef struct frame {
    preview_options options;
    stage stage;
    view view;
    image film;
} frame;

static void stop(const char *why)
{
    fprintf(stderr, "frames: %s\n", why);
    exit(1);
}

static void open_frame(frame *f, const scene *s, int model, size_t lanes)
{
    report r = { 0 };
    preview_statistics unused;
    f->options = (preview_options)PREVIEW_OPTIONS_INIT;
    f->options.width = WIDTH;
    f->options.height = HEIGHT;
    f->options.spp = 1;
    f->options.bounces = 0;
    f->options.threads = 1;
    f->options.model = model;
    f->options.area_lights = GLINT_AREA_LIGHT_FAST;
    if (!stage_set_up(&f->stage, s, &f->options, (double)INFINITY, &unused, &r) ||
        !view_set_up(&f->view, &f->stage, &f->options, &r) || !film_of_options(&f->options, &f->film, &r))
        stop(r.error);
    for (int i = 0; i < s->material_count; i++) {
        lanes_hold(f->stage.materials.layers[i].base, lanes);
        lanes_hold(f->stage.materials.layers[i].coat, lanes);
    }
}

static void close_frame(frame *f)
{
    image_free(&f->film);
    view_take_down(&f->view);
    stage_take_down(&f->stage);
}

static void render(void *user)
{
    frame *const f = user;
    report r = { 0 };
    ray_counts counts = { 0 };
    const tiles_job job = { .world = &f->view.world, .options = &f->options, .samples = 1, .film = &f->film };
    if (!tiles_render(&job, &counts, &r))
        stop(r.error);
}

static double mean(const image *i)
{
    double sum = 0.0;
    for (size_t k = 0; k < (size_t)WIDTH * HEIGHT; k++)
        sum += (double)i->pixels[k * (size_t)i->channel_count + 1];
    return sum / ((double)WIDTH * HEIGHT);
}

static double clock_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Pictures a second by the clock, of the fastest round. */
static double frames_per_second(frame *f, int threads, int rounds)
{
    double least = 1e9;
    f->options.threads = threads;
    for (int i = 0; i < rounds; i++) {
        const double start = clock_s();
        render(f);
        const double seconds = clock_s() - start;
        least = seconds < least ? seconds : least;
    }
    f->options.threads = 1;
    return 1.0 / least;
}

static void read_scene(const char *path, scene *s)
{
    const scene_file_options options = { 0 };
    report r = { 0 };
    if (!scene_file_read(path, &options, s, &r))
        stop(r.error);
    for (int i = 0; i < s->material_count; i++)
        if (s->materials[i].glint.present)
            s->materials[i].glint.density = 1e6F;
}

int main(int argc, char **argv)
{
    const int rounds = argc > 2 ? atoi(argv[2]) : 3;
    FILE *const json = argc > 1 ? fopen(argv[1], "w") : NULL;
    if (json == NULL || rounds < 1) {
        fprintf(stderr, "usage: %s FILE.json [ROUNDS [SCENE.glb]]\n", argv[0]);
        return 2;
    }
    static frame frames[FRAMES];
    static const char *const names[FRAMES] = { "smooth", "glints, 16 lanes", "glints, 8 lanes" };
    static const size_t lanes[FRAMES] = { 16, 16, 8 };
    racer racers[FRAMES];
    race_result result[FRAMES];
    scene s;
    read_scene(argc > 3 ? argv[3] : SHADER_BALL, &s);
    for (int i = 0; i < FRAMES; i++) {
        open_frame(&frames[i], &s, i == 0 ? GLINT_MODEL_SMOOTH : PREVIEW_MODEL_AUTO, lanes[i]);
        racers[i] = (racer){ names[i], render, &frames[i] };
    }
    race(racers, FRAMES, WIDTH * HEIGHT, rounds, result);
    race_print("a pixel of a frame, one thread", racers, FRAMES, result);
    fprintf(json, "{\n");
    race_write(json, "frames", racers, FRAMES, result);
    printf("%-34s %9s %9s   %s\n", "frames a second, by the clock", "1 thread", "2 threads", "mean");
    for (int i = 0; i < FRAMES; i++) {
        const double one = frames_per_second(&frames[i], 1, rounds);
        const double two = frames_per_second(&frames[i], MOST_THREADS, rounds);
        printf("  %-32s %9.3f %9.3f   %.5f\n", names[i], one, two, mean(&frames[i].film));
        fprintf(json, ",\n  \"%s, frames a second\": [%.6g, %.6g]", names[i], one, two);
    }
    fprintf(json, "\n}\n");
    for (int i = 0; i < FRAMES; i++)
        close_frame(&frames[i]);
    scene_free(&s);
    return fclose(json) != 0;
}
