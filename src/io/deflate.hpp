// Bytes compressed and back (zlib streams), for scenes, for the histories of a store, and for workbooks.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace phy::io {

std::string deflated(std::string_view bytes);

/// Nothing: the stream is damaged, cut short, or longer than `most` when inflated.
std::optional<std::string> inflated(std::string_view bytes, std::size_t most = std::string_view::npos);
/// Of a stream without head and checksum, as ZIP archives have them.
std::optional<std::string> inflated_raw(std::string_view bytes, std::size_t most);
std::uint32_t crc32_of(std::string_view bytes);

}  // namespace phy::io
