// JSON of outside. The library reads any depth of nesting, but works on what it has read by recursion: a file
// of brackets would end the program.
#pragma once
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace phy::io {

/// Throws nlohmann::json::exception, or std::out_of_range where it is nested deeper than anything of ours.
template <class Json>
Json parse_json(std::string_view text) {
  constexpr int deepest = 64;
  const auto is_shallow = [](int depth, typename Json::parse_event_t, Json&) {
    if (depth > deepest) throw std::out_of_range("nested too deep");
    return true;
  };
  return Json::parse(text, is_shallow);
}

/// What reading has thrown, without the number that the library puts in front.
inline std::string in_words(const std::exception& e) {
  const std::string_view text = e.what();
  const std::size_t end = text.starts_with("[json.exception") ? text.find("] ") : text.npos;
  return std::string(end == text.npos ? text : text.substr(end + 2));
}

/// A whole number; the library would cut 1e300 down to one without a word. Throws std::out_of_range.
template <class Whole, class Json>
Whole whole_number(const Json& j) {
  const auto fits = [](auto n) {
    return std::cmp_greater_equal(n, std::numeric_limits<Whole>::min()) &&
           std::cmp_less_equal(n, std::numeric_limits<Whole>::max());
  };
  if (j.is_number_unsigned() && fits(j.template get<std::uint64_t>())) return j.template get<Whole>();
  if (j.is_number_integer() && !j.is_number_unsigned() && fits(j.template get<std::int64_t>()))
    return j.template get<Whole>();
  throw std::out_of_range("no whole number, or one out of range");
}

}  // namespace phy::io
