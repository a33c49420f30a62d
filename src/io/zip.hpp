// ZIP archives as office programs write them: files as they are or deflated (APPNOTE.TXT, 4.3), without
// encryption and none of 4 GB.
#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace phy::io {

class ZipArchive {
 public:
  /// The bytes must outlive it. What is no archive holds nothing.
  explicit ZipArchive(std::string_view bytes);
  bool has(const std::string& name) const { return places_.contains(name); }
  /// A file of at most so many bytes; nothing: it is not there, larger, or damaged.
  std::optional<std::string> read(const std::string& name, std::size_t most) const;

 private:
  /// Bytes that may lie beyond the end, and then are fewer or none.
  std::string_view part(std::size_t at, std::size_t n) const;
  /// Little endian; 0 beyond the end.
  std::size_t number(std::size_t at, std::size_t n) const;

  std::string_view bytes_;
  std::map<std::string, std::size_t> places_;  // in the directory at the end, by name
};

}  // namespace phy::io
