#include "gui/way_in.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "gui/server.hpp"
#include "io/file.hpp"
#include "system/files.hpp"

namespace phy::gui {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t largest_way_in = 4096, digits_of_token = 32;

bool is_private(const std::string& file) {
  std::error_code error;
  // Not through a link: its owner decides where it leads.
  const fs::file_status status = fs::symlink_status(file, error);
  const fs::perms others = fs::perms::group_all | fs::perms::others_all;
  return !error && fs::is_regular_file(status) && (status.permissions() & others) == fs::perms::none;
}

}  // namespace

std::string kept_token(const std::string& file) {
  const std::optional<std::string> text =
      is_private(file) ? io::read_if_file(file, largest_way_in) : std::nullopt;
  const std::string mark = "?token=";
  const std::size_t at = text ? text->find(mark) : std::string::npos;
  if (at == std::string::npos) return random_token();
  const std::string token = text->substr(at + mark.size(), digits_of_token);
  const bool good =
      // The file may have been edited: a short token would be guessed.
      token.size() == digits_of_token && token.find_first_not_of("0123456789abcdef") == std::string::npos;
  return good ? token : random_token();
}

void write_way_in(const std::string& file, const std::string& address) {
  const std::string text =
      "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Phyllite</title>\n"
      "<meta http-equiv=\"refresh\" content=\"0; url=" +
      address + "\">\n<p>Start <code>phyllite gui</code> in this folder, then <a href=\"" + address +
      "\">open the page</a>.</p>\n</html>\n";
  const auto part = system::passing_file(file);  // nobody else may read it, from its first byte on
  if (!part) return;
  const int descriptor = system::open_to_append(*part);
  const bool whole = descriptor >= 0 && system::write_all(descriptor, text) == 0;
  if (descriptor >= 0) system::close(descriptor);
  // Moved into place: a browser that opens it meanwhile finds the old file or the new one.
  if (!whole || system::replace(*part, file) != 0) system::remove_file(*part);
}

}  // namespace phy::gui
