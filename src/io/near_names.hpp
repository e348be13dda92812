// Which of the names that exist a mistyped one may have meant.
#ifndef IO_NEAR_NAMES_HPP
#define IO_NEAR_NAMES_HPP

#include <string>
#include <vector>

// The names within a third of the wanted one's letters (at least 2), nearest first; all of them, in their order, when
// none is near. Separated by commas; "none" when there are no names.
std::string near_names(const std::string &wanted, const std::vector<std::string> &names);

// How a sentence ends that says what was not found: "; did you mean A or B?" of those that are near, else ", expected
// one of: " and all of them.
std::string names_instead(const std::string &wanted, const std::vector<std::string> &names);

#endif
