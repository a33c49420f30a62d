// Text without the blanks at its ends.
#pragma once
#include <string_view>

namespace phy {

/// `blanks`: the characters that are taken off; " \t" keeps line breaks.
inline std::string_view trimmed(std::string_view s, std::string_view blanks = " \t\r\n\v\f") {
  const std::size_t from = s.find_first_not_of(blanks);
  return from == s.npos ? std::string_view() : s.substr(from, s.find_last_not_of(blanks) - from + 1);
}

}  // namespace phy
