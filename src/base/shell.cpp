#include "base/shell.hpp"

#include "base/quote.hpp"
#include "system/terminal.hpp"

namespace phy {

std::string cmd_word(std::string_view text) {
  constexpr std::string_view harmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./\\-+=:";
  if (!text.empty() && text.find_first_not_of(harmless) == text.npos) return std::string(text);
  std::string word = "\"";
  // Programs of Windows take their line apart themselves: a backslash means itself, except before a quote.
  std::size_t slashes = 0;
  for (const char c : text) {
    if (c == '"') word.append(slashes + 1, '\\');
    slashes = c == '\\' ? slashes + 1 : 0;
    word += c;
  }
  return word.append(slashes, '\\') + "\"";
}

std::string shell_word(std::string_view text) {
  return system::has_posix_shell() ? sh_word(text) : cmd_word(text);
}

}  // namespace phy
