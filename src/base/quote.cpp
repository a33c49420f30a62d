#include "base/quote.hpp"

#include <algorithm>

#include "system/terminal.hpp"

namespace phy {
namespace {

constexpr const char* digit = "0123456789abcdef";

bool is_control(std::string_view character) {
  const auto u = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return u < 32 || u == 127;
  return u == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;  // U+0080 to U+009F
}

/// Plain characters and those of `kept` as they are, all other bytes as "\x1b".
std::string visible(std::string_view text, std::string_view kept) {
  std::string out;
  while (!text.empty()) {
    const std::size_t n = utf8_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(1, n));
    text.remove_prefix(character.size());
    // An escape sequence in a file's name would be obeyed by the terminal.
    if ((n > 0 && !is_control(character)) || kept.find(character) != kept.npos) {
      out += character;
      continue;
    }
    for (const char c : character) {
      const auto u = static_cast<unsigned char>(c);
      ((out += "\\x") += digit[u >> 4U]) += digit[u & 15U];
    }
  }
  return out;
}

}  // namespace

// The Unicode Standard, table 3-7: shortest form only, no surrogates, nothing above U+10FFFF.
std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
  const unsigned first = at(0), second = at(1);
  if (first < 0x80) return 1;
  const std::size_t n = first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : 4;
  // 0xC0 and 0xC1 begin overlong forms, above 0xF4 there is no character.
  if (first < 0xC2 || first > 0xF4) return 0;
  const unsigned least = first == 0xE0   ? 0xA0
                         : first == 0xF0 ? 0x90
                                         : 0x80,
                 most = first == 0xED   ? 0x9F
                        : first == 0xF4 ? 0x8F
                                        : 0xBF;
  if (second < least || second > most) return 0;
  for (std::size_t i = 2; i < n; ++i)
    if (at(i) < 0x80 || at(i) > 0xBF) return 0;
  return n;
}

bool is_plain(std::string_view text) {
  while (!text.empty()) {
    const std::size_t n = utf8_length(text);
    // Bytes that are no UTF-8 break whatever shows them.
    if (n == 0 || is_control(text.substr(0, n))) return false;
    text.remove_prefix(n);
  }
  return true;
}

std::string terminal_text(std::string_view text) { return visible(text, "\n"); }

std::string comment_text(std::string_view text) { return visible(text, ""); }

std::string toml_string(std::string_view text) {
  std::string q = "\"";
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (q += '\\') += c;
    else if (u < 32 || u == 127)
      (((q += "\\u00") += digit[u >> 4U]) += digit[u & 15U]);
    else
      q += c;
  }
  return q + "\"";
}

std::string toml_list(const std::vector<std::string>& values) {
  // Some readers have lines of limited length.
  constexpr std::size_t longest = 1000;
  std::string text = "[";
  std::size_t line = 0;  // where the present one begins
  for (const std::string& value : values) {
    if (text.size() > 1) text += text.size() - line + value.size() > longest ? ",\n" : ", ";
    if (text.back() == '\n') line = text.size();
    text += value;
  }
  return text + "]";
}

std::string csv_cell(std::string_view text) {
  std::string plain = comment_text(text);
  const bool bare = plain.find_first_of(",;\"") == plain.npos && !plain.starts_with('#') &&
                    // Programs take blanks at the ends off, and what begins with # for a comment.
                    !plain.starts_with(' ') && !plain.ends_with(' ');
  if (bare) return plain;
  // As RFC 4180 has it.
  std::string cell = "\"";
  for (const char c : plain) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + "\"";
}

std::string sh_word(std::string_view text) {
  constexpr std::string_view harmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+=:,@%";
  if (!text.empty() && text.find_first_not_of(harmless) == text.npos) return std::string(text);
  std::string word = "'";
  // Inside single quotes a shell knows no escape: they are ended, and begun again.
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

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

std::string command_of(const std::vector<std::string>& words) {
  std::string command = "phyllite";
  for (const std::string& word : words) command += " " + shell_word(word);
  return command;
}

// A quote inside single quotes is not doubled: gnuplot 5.4 takes two of them in a row, or one at the front,
// for the end of the string. It is joined from outside.
std::string gnuplot_string(std::string_view text) {
  std::string out = "'";
  for (const char c : comment_text(text)) out += c == '\'' ? "'.\"'\".'" : std::string(1, c);
  return out + "'";
}

std::string gnuplot_plain(std::string_view text) {
  // gnuplot sets text in its own markup: "E_c" would be a subscript.
  constexpr std::string_view markup = "\\{}^_@&~";
  std::string out;
  for (const char c : comment_text(text)) {
    if (markup.find(c) != markup.npos) out += '\\';
    out += c;
  }
  return out;
}

std::string json_in_script(std::string_view json) {
  std::string out;
  // "</script" in a name would end the script that holds it.
  for (const char c : json) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

}  // namespace phy
