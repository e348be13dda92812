// Orders names by edit distance.
#include "io/near_names.hpp"

#include <algorithm>
#include <utility>

#include "scene/edit_distance.h"

std::string near_names(const std::string &wanted, const std::vector<std::string> &names)
{
    const size_t limit = edit_distance_near(wanted.c_str());
    std::vector<std::pair<size_t, std::string>> ranked;
    for (const std::string &name : names)
        ranked.emplace_back(edit_distance(wanted.c_str(), name.c_str()), name);
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    const bool any_near = !ranked.empty() && ranked[0].first <= limit;
    std::string list;
    for (const auto &[distance, name] : ranked)
        if (!any_near || distance <= limit)
            list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}
