#include "base/option.hpp"

#include <cctype>
#include <utility>

namespace phy {
namespace {

std::string at_command_line(std::string_view word) {
  const bool by_place = !word.empty() && std::isupper(static_cast<unsigned char>(word.front())) != 0;
  return (by_place ? "" : "--") + std::string(word);
}

std::string set_at_command_line(std::string_view word, std::string_view value) {
  const std::size_t blank = word.find(' ');
  if (blank != word.npos)
    return at_command_line(word.substr(0, blank)) + " \"" + std::string(word.substr(blank + 1)) + "=" +
           std::string(value) + "\"";
  const std::string quote = value.find(' ') == value.npos ? "" : "\"";
  return at_command_line(word) + (value.empty() ? "" : " ") + quote + std::string(value) + quote;
}

OptionSpelling& spelling() {
  static OptionSpelling now = {"command line", at_command_line, set_at_command_line};
  return now;
}

}  // namespace

void spell_options(const OptionSpelling& other) { spelling() = other; }

std::string option(std::string_view word) { return spelling().name(word); }

std::string option_set(std::string_view word, std::string_view value) { return spelling().set(word, value); }

Problem option_problem(std::string_view word, std::string value, std::string expected, std::string remedy) {
  return {spelling().place, option(word), std::move(value), std::move(expected), std::move(remedy)};
}

std::string option_text(const OptionValue& value) {
  if (const auto* number = std::get_if<std::int64_t>(&value)) return std::to_string(*number);
  if (const auto* word = std::get_if<std::string>(&value)) return word->empty() ? "not given" : *word;
  return std::get<bool>(value) ? "on" : "off";
}

}  // namespace phy
