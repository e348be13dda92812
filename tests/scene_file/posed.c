/* Prints where a moving scene's cameras, lights and instances are: posed FILE TIME... */
#include <stdio.h>
#include <stdlib.h>

#include "io/scene_motion.h"

static void print_place(double time_s, const char *kind, const char *name, const float to_world[16])
{
    printf("%.9g %s %s", time_s, kind, name);
    for (int i = 0; i < 16; i++)
        printf(" %.9g", (double)to_world[i]);
    putchar('\n');
}

static void print_pose(const scene *s, double time_s)
{
    for (int i = 0; i < s->camera_count; i++)
        print_place(time_s, "camera", s->cameras[i].name, s->cameras[i].to_world);
    for (int i = 0; i < s->light_count; i++)
        print_place(time_s, "light", s->lights[i].name, s->lights[i].to_world);
    for (int i = 0; i < s->instance_count; i++)
        print_place(time_s, "mesh", s->instances[i].name, s->instances[i].to_world);
}

int main(int argc, char **argv)
{
    report r = { 0 };
    scene s;
    scene_motion *motion;
    bool done = argc > 2 && scene_motion_open(argv[1], NULL, NULL, &s, &motion, &r);
    for (int i = 2; done && i < argc; i++) {
        const double time_s = strtod(argv[i], NULL);
        done = scene_motion_pose(motion, time_s, &s, &r);
        if (done)
            print_pose(&s, time_s);
    }
    if (!done) {
        fprintf(stderr, "%s\n", r.error);
        return 1;
    }
    scene_motion_close(motion);
    scene_free(&s);
    return 0;
}
