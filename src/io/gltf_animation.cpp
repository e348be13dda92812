// Reads channels and samplers of animations (glTF 2.0 section 3.11) and poses nodes by them.
#include "io/gltf_animation.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "io/gltf_accessor.hpp"

namespace
{

enum class use { times, vectors, rotations };

constexpr std::array<const char *, 3> moved_names = { "translation", "rotation", "scale" };

// Channels that nothing comes of, by reason.
struct left_out {
    size_t weights = 0, joints = 0, others = 0;
};

struct animation_reader {
    gltf_file &file;
    gltf_animation &out;
    std::set<size_t> joints;
    // What has been moved so far: node and property, and the animation and the channel that move it.
    std::map<std::pair<size_t, gltf_moved>, std::pair<size_t, size_t>> taken;
    left_out still;
};

std::string label(const json &animations, size_t number)
{
    return std::to_string(number) + " \"" + animations[number].value("name", "") + "\"";
}

std::string labels(const json &animations)
{
    constexpr size_t most = 24; // what a message can hold
    std::string all;
    for (size_t i = 0; i < animations.size() && i < most; i++)
        all += (i > 0 ? ", " : "") + label(animations, i);
    return all + (animations.size() > most ? " ..." : "");
}

std::string accessor_pointer(int number)
{
    return json_pointer("/accessors", static_cast<size_t>(number));
}

// ---- samplers ----

void check_times(const std::vector<float> &times, int accessor)
{
    for (size_t i = 0; i < times.size(); i++) {
        if (times[i] < 0.0F)
            throw file_error(accessor_pointer(accessor), "found the negative time " + json(times[i]).dump() +
                                                             " in element " + std::to_string(i) +
                                                             ", expected seconds from 0 on");
        if (i > 0 && !(times[i] > times[i - 1]))
            throw file_error(accessor_pointer(accessor),
                             "found the time " + json(times[i]).dump() + " in element " + std::to_string(i) +
                                 " behind " + json(times[i - 1]).dump() + ", expected times that increase");
    }
}

// Of the keys; tangents of a spline, the first and the last of each three, may be zero.
void check_lengths(const std::vector<float> &values, bool spline, int accessor)
{
    for (size_t i = 0; i < values.size() / 4; i++)
        if ((!spline || i % 3 == 1) &&
            std::all_of(&values[4 * i], &values[4 * i] + 4, [](float part) { return part == 0.0F; }))
            throw file_error(accessor_pointer(accessor), "found a quaternion of length 0 in element " +
                                                             std::to_string(i) + ", expected unit quaternions");
}

const std::vector<float> &array_of(animation_reader &r, int accessor, use what, bool spline)
{
    const std::pair<int, int> key = { accessor, 2 * static_cast<int>(what) + (spline ? 1 : 0) };
    const auto known = r.out.arrays.find(key);
    if (known != r.out.arrays.end())
        return known->second;
    const int components = what == use::times ? 1 : what == use::vectors ? 3 : 4;
    const unsigned allowed = what == use::rotations
                                 ? GLTF_FLOAT | GLTF_BYTE_NORMALIZED | GLTF_UNSIGNED_BYTE_NORMALIZED |
                                       GLTF_SHORT_NORMALIZED | GLTF_UNSIGNED_SHORT_NORMALIZED
                                 : GLTF_FLOAT;
    gltf_check_accessor(r.file, accessor, components, components, allowed,
                        what == use::times ? "the times of an animation" : "an animation of nodes");
    std::vector<float> values = gltf_read_floats(r.file, accessor);
    if (what == use::times)
        check_times(values, accessor);
    else if (what == use::rotations)
        check_lengths(values, spline, accessor);
    return r.out.arrays[key] = std::move(values);
}

gltf_interpolation interpolation_of(const json &sampler)
{
    const std::string name = sampler.value("interpolation", "LINEAR");
    return name == "STEP"     ? gltf_interpolation::step
           : name == "LINEAR" ? gltf_interpolation::linear
                              : gltf_interpolation::cubic_spline;
}

gltf_keyframes read_sampler(animation_reader &r, const json &sampler, gltf_moved moved, const std::string &pointer)
{
    const gltf_interpolation how = interpolation_of(sampler);
    const bool spline = how == gltf_interpolation::cubic_spline, turns = moved == gltf_moved::rotation;
    const std::vector<float> &times = array_of(r, sampler["input"].get<int>(), use::times, false),
                             &values = array_of(r, sampler["output"].get<int>(), turns ? use::rotations : use::vectors,
                                                spline);
    const size_t components = turns ? 4 : 3, found = values.size() / components;
    const size_t expected = times.size() * (spline ? 3 : 1);
    if (found != expected)
        throw file_error(pointer + "/output", "found " + std::to_string(found) + " elements, expected " +
                                                  std::to_string(expected) + " for " + std::to_string(times.size()) +
                                                  (spline ? " keys of a cubic spline" : " keys"));
    if (spline && times.size() < 2)
        throw file_error(pointer + "/input", "found 1 key, expected at least 2 of a cubic spline");
    r.out.end_s = std::max(r.out.end_s, static_cast<double>(times.back()));
    return { &times, &values, how, components };
}

// ---- channels ----

// Two channels of one animation never move the same; two animations may, but do not play together.
void take(animation_reader &r, size_t node, gltf_moved moved, size_t animation, size_t channel,
          const std::string &pointer)
{
    const auto [entry, is_new] = r.taken.insert({ { node, moved }, { animation, channel } });
    if (is_new)
        return;
    const auto [other, other_channel] = entry->second;
    const std::string what = std::string("found the ") + moved_names[static_cast<size_t>(moved)] + " of node " +
                             std::to_string(node) + ", which ";
    if (other == animation)
        throw file_error(pointer, what + "channel " + std::to_string(other_channel) +
                                      " moves already, expected one channel for it");
    throw file_error(
        pointer, what + "animation " + label(r.file.animations, other) +
                     " moves as well, expected one of them to be chosen (--animation): " + labels(r.file.animations));
}

void read_channel(animation_reader &r, size_t animation, size_t number)
{
    const std::string here = json_pointer("/animations", animation), pointer = json_pointer(here + "/channels", number);
    const json &all = r.file.animations[animation], &channel = all["channels"][number], &target = channel["target"];
    const std::string path = target["path"].get<std::string>();
    const size_t sampler = channel["sampler"].get<size_t>(), sampler_count = all["samplers"].size();
    if (sampler >= sampler_count)
        throw file_error(pointer + "/sampler", "found " + std::to_string(sampler) + ", expected an index into the " +
                                                   std::to_string(sampler_count) + " samplers of the animation");
    const auto name = std::find(moved_names.begin(), moved_names.end(), path);
    if (path == "weights" && target.contains("node")) {
        r.still.weights++;
    } else if (!target.contains("node") || name == moved_names.end()) {
        r.still.others++;
    } else if (r.joints.count(target["node"].get<size_t>()) > 0) {
        r.still.joints++;
    } else {
        const size_t node = target["node"].get<size_t>();
        const gltf_moved moved = static_cast<gltf_moved>(name - moved_names.begin());
        take(r, node, moved, animation, number, pointer);
        if (!r.file.model.nodes[node].matrix.empty())
            throw file_error(json_pointer("/nodes", node) + "/matrix",
                             "found a matrix on a node that " + pointer +
                                 " moves, expected translation, rotation and scale");
        r.out.channels.push_back(
            { node, moved,
              read_sampler(r, all["samplers"][sampler], moved, json_pointer(here + "/samplers", sampler)) });
    }
}

void warn_of(gltf_file &file, size_t count, const char *what)
{
    if (count > 0)
        file.warn("/animations",
                  std::to_string(count) + (count == 1 ? " channel is" : " channels are") + " left out: " + what);
}

// The animations that are wanted, by number.
std::vector<size_t> chosen(const json &animations, const char *wanted)
{
    std::vector<size_t> all(animations.size());
    for (size_t i = 0; i < all.size(); i++)
        all[i] = i;
    if (all.empty())
        throw file_error("", "found no animation, expected one for its frames to show");
    if (!wanted)
        return all;
    const std::string text = wanted;
    for (const size_t i : all)
        if (animations[i].value("name", "") == text)
            return { i };
    const bool counted = !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == text.npos;
    if (counted && std::stoul(text) < all.size())
        return { std::stoul(text) };
    throw file_error("", "found no animation called \"" + text + "\", expected one of: " + labels(animations));
}

} // namespace

gltf_animation gltf_read_animation(gltf_file &file, const char *wanted)
{
    gltf_animation out;
    animation_reader r = { file, out, {}, {}, {} };
    for (const tinygltf::Skin &skin : file.model.skins)
        r.joints.insert(skin.joints.begin(), skin.joints.end());
    for (const size_t animation : chosen(file.animations, wanted))
        for (size_t i = 0; i < file.animations[animation]["channels"].size(); i++)
            read_channel(r, animation, i);
    warn_of(file, r.still.weights, "the weights of morph targets stand still");
    warn_of(file, r.still.joints, "skins and what hangs on their joints stand still, in their bind pose");
    warn_of(file, r.still.others, "what is no node stands still (KHR_animation_pointer)");
    if (out.channels.empty())
        file.warn("/animations", "no node moves; every frame shows the same picture");
    return out;
}

void gltf_pose(const gltf_animation &animation, double time_s, tinygltf::Model &model)
{
    for (const gltf_channel &channel : animation.channels) {
        tinygltf::Node &node = model.nodes[channel.node];
        std::vector<double> &value = channel.moved == gltf_moved::translation ? node.translation
                                     : channel.moved == gltf_moved::rotation  ? node.rotation
                                                                              : node.scale;
        value.resize(channel.keys.components);
        gltf_value_at(channel.keys, time_s, value.data());
    }
}
