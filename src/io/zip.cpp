#include "io/zip.hpp"

#include "io/deflate.hpp"

namespace phy::io {
namespace {

// Where a number stands in a record, and how many bytes it has: sections 4.3.16, 4.3.12 and 4.3.7 of
// APPNOTE.TXT.
namespace end {
constexpr std::string_view mark = "PK\5\6";
constexpr std::size_t size = 22, n_files = 10, directory = 16;
}  // namespace end
namespace entry {
constexpr std::string_view mark = "PK\1\2";
constexpr std::size_t size = 46, flags = 8, method = 10, checksum = 16, packed = 20, unpacked = 24, name = 28,
                      extra = 30, comment = 32, header = 42;
}  // namespace entry
namespace header {
constexpr std::string_view mark = "PK\3\4";
constexpr std::size_t size = 30, name = 26, extra = 28;
}  // namespace header
constexpr std::size_t stored = 0, deflate = 8, encrypted = 1;

}  // namespace

ZipArchive::ZipArchive(std::string_view bytes) : bytes_(bytes) {
  if (bytes.size() < end::size) return;
  // From behind: a comment may follow.
  const std::size_t last = bytes.rfind(end::mark, bytes.size() - end::size);
  if (last == bytes.npos) return;
  std::size_t at = number(last + end::directory, 4);
  for (std::size_t n = number(last + end::n_files, 2); n > 0 && part(at, 4) == entry::mark; --n) {
    const std::size_t name = number(at + entry::name, 2);
    places_.emplace(part(at + entry::size, name), at);
    at += entry::size + name + number(at + entry::extra, 2) + number(at + entry::comment, 2);
  }
}

std::optional<std::string> ZipArchive::read(const std::string& name, std::size_t most) const {
  const auto place = places_.find(name);
  if (place == places_.end()) return std::nullopt;
  // From the directory: a writer that streams leaves sizes and checksum zero in the header before the data.
  const std::size_t at = place->second, size = number(at + entry::unpacked, 4),
                    head = number(at + entry::header, 4), method = number(at + entry::method, 2);
  // Before anything is unpacked: some kilobytes of an archive may mean gigabytes.
  if (size > most || part(head, 4) != header::mark) return std::nullopt;
  if ((number(at + entry::flags, 2) & encrypted) != 0) return std::nullopt;
  const std::size_t start =
      head + header::size + number(head + header::name, 2) + number(head + header::extra, 2);
  const std::string_view packed = part(start, number(at + entry::packed, 4));
  std::optional<std::string> text;
  if (method == stored) text = packed;
  if (method == deflate) text = inflated_raw(packed, size);
  if (!text || text->size() != size || crc32_of(*text) != number(at + entry::checksum, 4))
    return std::nullopt;
  return text;
}

std::string_view ZipArchive::part(std::size_t at, std::size_t n) const {
  return at > bytes_.size() ? std::string_view() : bytes_.substr(at, n);
}

std::size_t ZipArchive::number(std::size_t at, std::size_t n) const {
  const std::string_view b = part(at, n);
  std::size_t value = 0;
  // Cut short, a number is 0: where that leads to is checked by its mark.
  for (std::size_t i = b.size() == n ? n : 0; i > 0; --i)
    value = value << 8U | static_cast<unsigned char>(b[i - 1]);
  return value;
}

}  // namespace phy::io
