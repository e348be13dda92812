// Orders names by edit distance (Levenshtein 1966).
#include "io/near_names.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace
{

size_t edit_distance(const std::string &a, const std::string &b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{ 0 });
    for (size_t i = 1; i <= a.size(); i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t k = 1; k <= b.size(); k++) {
            const size_t replaced = diagonal + (a[i - 1] == b[k - 1] ? 0 : 1);
            diagonal = row[k];
            row[k] = std::min({ replaced, row[k] + 1, row[k - 1] + 1 });
        }
    }
    return row.back();
}

} // namespace

std::string near_names(const std::string &wanted, const std::vector<std::string> &names)
{
    const size_t limit = std::max<size_t>(2, wanted.size() / 3);
    std::vector<std::pair<size_t, std::string>> ranked;
    for (const std::string &name : names)
        ranked.emplace_back(edit_distance(wanted, name), name);
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    const bool any_near = !ranked.empty() && ranked[0].first <= limit;
    std::string list;
    for (const auto &[distance, name] : ranked)
        if (!any_near || distance <= limit)
            list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}
