// Orders names by edit distance.
#include "io/near_names.hpp"

#include <algorithm>
#include <utility>

#include "scene/edit_distance.h"

std::string near_names(const std::string &wanted, const std::vector<std::string> &names)
{
    const size_t limit = edit_distance_near(wanted.c_str());
    std::vector<std::pair<size_t, std::string>> near;
    for (const std::string &name : names) {
        const size_t distance = edit_distance(wanted.c_str(), name.c_str());
        if (distance <= limit)
            near.emplace_back(distance, name);
    }
    std::stable_sort(near.begin(), near.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    std::string list;
    for (const auto &[distance, name] : near)
        list += (list.empty() ? "" : ", ") + name;
    for (const std::string &name : names)
        if (near.empty())
            list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}
