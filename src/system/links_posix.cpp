#include "system/links.hpp"

namespace phy::system {

std::optional<std::filesystem::path> followed(const std::filesystem::path& path) {
  std::error_code gone, error;
  const std::filesystem::path home = std::filesystem::canonical(".", gone),
                              place = std::filesystem::weakly_canonical(home / path, error);
  if (gone || error) return std::nullopt;
  return place;
}

}  // namespace phy::system
