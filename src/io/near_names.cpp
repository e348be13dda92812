// Orders names by edit distance.
#include "io/near_names.hpp"

#include <algorithm>
#include <utility>

#include "scene/edit_distance.h"

namespace
{

std::vector<std::string> near(const std::string &wanted, const std::vector<std::string> &names)
{
    const size_t limit = edit_distance_near(wanted.c_str());
    std::vector<std::pair<size_t, std::string>> found;
    for (const std::string &name : names) {
        const size_t distance = edit_distance(wanted.c_str(), name.c_str());
        if (distance <= limit)
            found.emplace_back(distance, name);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<std::string> sorted;
    sorted.reserve(found.size());
    for (const auto &[distance, name] : found)
        sorted.push_back(name);
    return sorted;
}

std::string joined(const std::vector<std::string> &names, const char *separator)
{
    std::string list;
    for (const std::string &name : names)
        list += (list.empty() ? "" : separator) + name;
    return list.empty() ? "none" : list;
}

} // namespace

std::string near_names(const std::string &wanted, const std::vector<std::string> &names)
{
    const std::vector<std::string> meant = near(wanted, names);
    return joined(meant.empty() ? names : meant, ", ");
}

std::string names_instead(const std::string &wanted, const std::vector<std::string> &names)
{
    const std::vector<std::string> meant = near(wanted, names);
    return meant.empty() ? ", expected one of: " + joined(names, ", ")
                         : "; did you mean " + joined(meant, " or ") + "?";
}
