// Links in the file system.
#pragma once
#include <filesystem>
#include <optional>

namespace phy::system {

/// The whole name of what a path leads to, links followed; what is not there yet is kept as it is written.
std::optional<std::filesystem::path> followed(const std::filesystem::path& path);

}  // namespace phy::system
