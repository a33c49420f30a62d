// Lines of text for people that say the same of several things once.
#pragma once
#include <string>
#include <vector>

namespace phy {

/// Adds the line "subject: what". Subjects of which the same is said share it: "subject, other: what".
void add_line(std::vector<std::string>& lines, const std::string& subject, const std::string& what);

}  // namespace phy
