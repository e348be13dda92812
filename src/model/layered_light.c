/* A light of real size as the coat of a layered material sees it: turned into the frame of the coat. */
#include "model/layered_light.h"

#include "math/float_bits.h"

static int is_usable(const float v[3])
{
    return is_below(v[0], 1e15F) && is_below(v[1], 1e15F) && is_below(v[2], 1e15F);
}

/* Of a vector that has been turned already there is nothing left to check. */
static int turn(const coat_frame *f, const float from[3], float to[3])
{
    if (!is_usable(from))
        return 0;
    const vec3 v = coat_frame_in(f, vec3_from(from));
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
    return 1;
}

/* Only what the kind names is read. */
int coat_light_turn(const coat_frame *f, const glint_area_light *from, glint_area_light *to)
{
    *to = (glint_area_light){ .kind = from->kind,
                              .two_sided = from->two_sided,
                              .hidden = from->hidden,
                              .solid_angle_sr = from->solid_angle_sr,
                              .radius = from->radius };
    switch (from->kind) {
    case GLINT_AREA_POLYGON:
        if (from->corner_count > GLINT_MAX_CORNERS)
            return 0;
        to->corner_count = from->corner_count;
        for (uint32_t i = 0; i < from->corner_count; i++)
            if (!turn(f, from->corners[i], to->corners[i]))
                return 0;
        return 1;
    case GLINT_AREA_RECTANGLE:
    case GLINT_AREA_DISK:
        return turn(f, from->center, to->center) && turn(f, from->half_x, to->half_x) &&
               turn(f, from->half_y, to->half_y);
    case GLINT_AREA_SUN:
    case GLINT_AREA_SPHERE:
        return turn(f, from->center, to->center);
    }
    return 0;
}

static float cosine_of(vec3 v)
{
    return vec3_normalize(v).z;
}

/* The middle and the ends of both diameters, or of the four corners. */
static int flat_cosines(const glint_area_light *light, float cosine[COAT_LIGHT_POINTS])
{
    const vec3 c = vec3_from(light->center), x = vec3_from(light->half_x), y = vec3_from(light->half_y);
    const vec3 a = light->kind == GLINT_AREA_DISK ? x : vec3_add(x, y);
    const vec3 b = light->kind == GLINT_AREA_DISK ? y : vec3_add(x, vec3_scale(y, -1.0F));
    cosine[0] = cosine_of(c);
    cosine[1] = cosine_of(vec3_add(c, a));
    cosine[2] = cosine_of(vec3_add(c, vec3_scale(a, -1.0F)));
    cosine[3] = cosine_of(vec3_add(c, b));
    cosine[4] = cosine_of(vec3_add(c, vec3_scale(b, -1.0F)));
    return 5;
}

/* Sine of the angular radius. */
static float sine_of_round(const glint_area_light *light, float distance)
{
    if (light->kind == GLINT_AREA_SPHERE) {
        const float radius = clamp_to(light->radius, 0.0F, 1e15F);
        return radius < distance ? radius / distance : 1.0F;
    }
    /* A cap of solid angle 2 pi (1 - cos). */
    const float versine = clamp_to(light->solid_angle_sr, 0.0F, 6.28318531F) * (1.0F / 6.28318531F);
    const float squared = versine * (2.0F - versine);
    return squared < 1.0F ? sqrtf(squared) : 1.0F;
}

/* The middle, the highest and the lowest point and two beside. */
static int round_cosines(const glint_area_light *light, float cosine[COAT_LIGHT_POINTS])
{
    const vec3 center = vec3_from(light->center);
    const vec3 axis = vec3_normalize(center);
    const float sine = sine_of_round(light, sqrtf(vec3_dot(center, center)));
    const float squared = 1.0F - sine * sine, turned = axis.z * (squared > 0.0F ? sqrtf(squared) : 0.0F);
    const float flat2 = 1.0F - axis.z * axis.z, flat = sine * (flat2 > 0.0F ? sqrtf(flat2) : 0.0F);
    cosine[0] = axis.z;
    cosine[1] = turned + flat;
    cosine[2] = turned - flat;
    cosine[3] = cosine[4] = turned;
    return 5;
}

int coat_light_cosines(const glint_area_light *light, float cosine[COAT_LIGHT_POINTS])
{
    if (light->kind == GLINT_AREA_SUN || light->kind == GLINT_AREA_SPHERE)
        return round_cosines(light, cosine);
    if (light->kind != GLINT_AREA_POLYGON)
        return flat_cosines(light, cosine);
    vec3 sum = { 0.0F, 0.0F, 0.0F };
    const int count = (int)light->corner_count;
    for (int i = 0; i < count; i++) {
        const vec3 corner = vec3_from(light->corners[i]);
        cosine[i] = cosine_of(corner);
        sum = vec3_add(sum, corner);
    }
    cosine[count] = cosine_of(sum);
    return count + 1;
}
