// How large a file may be that is read at once, packed or unpacked. Scenes that would be larger are refused
// before they are computed (lab/scene_room.hpp).
#pragma once
#include <cstddef>

namespace phy {

constexpr std::size_t largest_file = std::size_t{1} << 30U;  ///< bytes

/// What a person writes: recipes, rocks, studies have some kilobytes, tables a line for every specimen.
constexpr std::size_t largest_document = std::size_t{1} << 20U, largest_table = std::size_t{16} << 20U;

}  // namespace phy
