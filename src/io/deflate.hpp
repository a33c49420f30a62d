// Bytes compressed and back (zlib streams), for scenes and for the histories of a store.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace phy::io {

std::string deflated(std::string_view bytes);

/// Nothing: the stream is damaged, cut short, or longer than `most` when inflated.
std::optional<std::string> inflated(std::string_view bytes, std::size_t most = std::string_view::npos);

}  // namespace phy::io
