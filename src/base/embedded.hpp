// Files of the source tree that are part of the program: pages, tables of what models reach, recorded numbers
// (PHY_EMBEDDED in CMakeLists.txt). The assembler takes them in as they are.
#pragma once
#include <string_view>

namespace phy {

/// The text of a file, by its path in the source tree ("web/report.html"), which is one of the list.
std::string_view embedded(std::string_view path);

}  // namespace phy
