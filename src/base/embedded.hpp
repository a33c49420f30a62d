// Files of the source tree that are part of the program: pages, tables of what models reach, measured rocks,
// recorded numbers (PHY_EMBEDDED in CMakeLists.txt). The assembler takes them in as they are.
#pragma once
#include <string_view>
#include <vector>

namespace phy {

/// The text of a file, by its path in the source tree ("web/report.html"), which is one of the list.
std::string_view embedded(std::string_view path);

/// Paths of all files of the list that begin so ("data/rocks/"), in alphabetical order.
std::vector<std::string_view> embedded_below(std::string_view folder);

}  // namespace phy
