// Options of a job in messages. A room knows an option by one word; the front end that a person uses writes
// it as it is written there: "max-tests" is --max-tests at the command line and max_tests in Python.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "base/check.hpp"

namespace phy {

/// A word in capitals is an argument by place ("LAW"); "set k_n" is the item k_n of the option "set".
struct OptionSpelling {
  const char* place;  ///< of what was given wrong; may be empty
  std::string (*name)(std::string_view word);
  /// With a value; without one it is a switch, on.
  std::string (*set)(std::string_view word, std::string_view value);
};

/// Of this process; until it is called, that of the command line.
void spell_options(const OptionSpelling& spelling);

/// "--max-tests".
std::string option(std::string_view word);
/// "--method sequence"; "--resume".
std::string option_set(std::string_view word, std::string_view value = {});
/// What is wrong with the value of an option.
Problem option_problem(std::string_view word, std::string value, std::string expected, std::string remedy);

/// A switch, a whole number, or a word, which is empty where none was given.
using OptionValue = std::variant<bool, std::int64_t, std::string>;
/// "on" or "off", "2000", "quick"; "not given".
std::string option_text(const OptionValue& value);

struct SetOption {
  std::string key;  ///< in data: "max_tests"
  OptionValue value;
};

}  // namespace phy
