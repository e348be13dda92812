// Checks that nodes form strict trees and walks them without recursion, however deep they are.
#include "io/gltf_graph.hpp"

namespace
{

constexpr int no_parent = -1;

std::string node_pointer(size_t node)
{
    return json_pointer("/nodes", node);
}

std::vector<int> find_parents(const tinygltf::Model &model)
{
    std::vector<int> parents(model.nodes.size(), no_parent);
    for (size_t i = 0; i < model.nodes.size(); i++)
        for (const int child : model.nodes[i].children) {
            int &parent = parents[static_cast<size_t>(child)];
            if (parent != no_parent)
                throw file_error(node_pointer(i) + "/children",
                                 "found node " + std::to_string(child) + ", which is already a child of node " +
                                     std::to_string(parent) + "; a node may have one parent");
            parent = static_cast<int>(i);
        }
    return parents;
}

// Appends node and all below it to order, parents first.
void walk(const tinygltf::Model &model, size_t root, std::vector<size_t> &order)
{
    std::vector<size_t> waiting = { root };
    while (!waiting.empty()) {
        const size_t node = waiting.back();
        waiting.pop_back();
        order.push_back(node);
        const std::vector<int> &children = model.nodes[node].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            waiting.push_back(static_cast<size_t>(*child));
    }
}

// With one parent each, the nodes that no root reaches lie on cycles or below them.
void check_reached(const std::vector<size_t> &order, size_t node_count)
{
    std::vector<bool> reached(node_count, false);
    for (const size_t node : order)
        reached[node] = true;
    for (size_t i = 0; i < node_count; i++)
        if (!reached[i])
            throw file_error(node_pointer(i), "found a node in a cycle of children, expected trees");
}

void walk_scene(const tinygltf::Model &model, const std::vector<int> &parents, std::vector<size_t> &visible)
{
    const size_t number = model.defaultScene < 0 ? 0 : static_cast<size_t>(model.defaultScene);
    const std::string pointer = json_pointer("/scenes", number) + "/nodes";
    for (const int root : model.scenes[number].nodes) {
        const int parent = parents[static_cast<size_t>(root)];
        if (parent != no_parent)
            throw file_error(pointer, "found node " + std::to_string(root) + ", which is a child of node " +
                                          std::to_string(parent) + "; a scene lists root nodes");
        walk(model, static_cast<size_t>(root), visible);
    }
}

} // namespace

gltf_graph gltf_read_graph(const gltf_file &file)
{
    const tinygltf::Model &model = file.model;
    const std::vector<int> parents = find_parents(model);
    std::vector<size_t> order;
    for (size_t i = 0; i < model.nodes.size(); i++)
        if (parents[i] == no_parent)
            walk(model, i, order);
    check_reached(order, model.nodes.size());
    gltf_graph graph;
    graph.to_world.resize(model.nodes.size(), identity4);
    for (const size_t node : order) {
        const matrix4 local = node_transform(model.nodes[node], node_pointer(node));
        const int parent = parents[node];
        graph.to_world[node] =
            parent == no_parent ? local : multiply(graph.to_world[static_cast<size_t>(parent)], local);
    }
    if (model.scenes.empty())
        graph.visible = order;
    else
        walk_scene(model, parents, graph.visible);
    return graph;
}
