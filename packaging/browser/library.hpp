// What C++20 asks of its library and libc++ 13, emscripten's in Debian 12, does not have yet: algorithms of
// ranges, and numbers of `double` as text. Included before every file of the build for browsers.
#pragma once
#ifdef PHY_MAIN  // a name that clang changes from 15 on, and em++ 3.1.6 looks for
int main(int, char**) __asm__("main");
#endif
#if defined(__cplusplus) && __cplusplus >= 202002L
#include <version>
#if _LIBCPP_VERSION < 15000
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <system_error>

namespace std {
namespace ranges {

template <class Range, class Is, class Projection = identity>
auto find_if(Range&& range, Is is, Projection of = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](auto&& x) { return std::invoke(is, std::invoke(of, x)); });
}
template <class Range, class Value, class Projection = identity>
auto find(Range&& range, const Value& value, Projection of = {}) {
  return ranges::find_if(
      range, [&](const auto& x) { return x == value; }, of);
}
template <class Range, class Is, class Projection = identity>
bool any_of(Range&& range, Is is, Projection of = {}) {
  return ranges::find_if(range, is, of) != std::end(range);
}
template <class Range, class Is, class Projection = identity>
bool none_of(Range&& range, Is is, Projection of = {}) {
  return !ranges::any_of(range, is, of);
}
template <class Range, class Is, class Projection = identity>
bool all_of(Range&& range, Is is, Projection of = {}) {
  return ranges::none_of(
      range, [&](auto&& x) { return !std::invoke(is, x); }, of);
}
template <class Range, class Is, class Projection = identity>
auto count_if(Range&& range, Is is, Projection of = {}) {
  return std::count_if(std::begin(range), std::end(range),
                       [&](auto&& x) { return std::invoke(is, std::invoke(of, x)); });
}
template <class Range, class Value, class Projection = identity>
auto count(Range&& range, const Value& value, Projection of = {}) {
  return ranges::count_if(
      range, [&](const auto& x) { return x == value; }, of);
}
template <class Range, class Out>
void copy(Range&& range, Out out) {
  std::copy(std::begin(range), std::end(range), out);
}
template <class Range, class Out, class Is>
void copy_if(Range&& range, Out out, Is is) {
  std::copy_if(std::begin(range), std::end(range), out, is);
}
template <class Range>
void reverse(Range&& range) {
  std::reverse(std::begin(range), std::end(range));
}
/// Two elements, compared by what the projection makes of them.
template <class Less, class Projection>
auto comparison(Less& less, Projection& of) {
  return
      [&](const auto& a, const auto& b) { return std::invoke(less, std::invoke(of, a), std::invoke(of, b)); };
}
template <class Range, class Less = std::less<>, class Projection = identity>
void sort(Range&& range, Less is_less = {}, Projection of = {}) {
  std::sort(std::begin(range), std::end(range), comparison(is_less, of));
}
template <class Range, class Less = std::less<>, class Projection = identity>
auto max_element(Range&& range, Less is_less = {}, Projection of = {}) {
  return std::max_element(std::begin(range), std::end(range), comparison(is_less, of));
}
template <class Range, class Less = std::less<>, class Projection = identity>
auto minmax(Range&& range, Less is_less = {}, Projection of = {}) {
  struct {
    iter_value_t<decltype(std::begin(range))> min, max;
  } found;
  const auto [min, max] = std::minmax_element(std::begin(range), std::end(range), comparison(is_less, of));
  found.min = *min, found.max = *max;
  return found;
}

}  // namespace ranges

/// The longest beginning that is a number as strtod() would have it, without what from_chars() does not take.
inline from_chars_result from_chars(const char* first, const char* last, double& value,
                                    chars_format format = chars_format::general) {
  const bool hex = format == chars_format::hex;
  const char* digit = first != last && *first == '-' ? first + 1 : first;
  const auto is_digit = [&](const char* c) {
    return c != last &&
           (isdigit(static_cast<unsigned char>(*c)) || (hex && isxdigit(static_cast<unsigned char>(*c))));
  };
  const bool is_word = digit != last && (tolower(*digit) == 'i' || tolower(*digit) == 'n');
  if (!is_word && !is_digit(digit) && !(digit != last && *digit == '.' && is_digit(digit + 1)))
    return {first, errc::invalid_argument};
  if (!hex && last - digit > 1 && *digit == '0' &&
      tolower(digit[1]) == 'x') {  // to strtod() it would be a number
    value = digit == first ? 0.0 : -0.0;
    return {digit + 1, errc()};
  }
  const string sign = (digit == first ? "" : "-"), prefix = hex && !is_word ? "0x" : "";
  const string text = sign + prefix + string(digit, last);
  char* end = nullptr;
  const double read = strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const char* stop = digit + (end - text.c_str()) - static_cast<ptrdiff_t>(sign.size() + prefix.size());
  // Too large, or so small that nothing is left of it.
  const char* mantissa = std::find_if(digit, stop, [&](char c) { return tolower(c) == (hex ? 'p' : 'e'); });
  const bool is_zero = std::none_of(
      digit, mantissa, [](char c) { return isxdigit(static_cast<unsigned char>(c)) && c != '0'; });
  if (!is_word && (isinf(read) || (read == 0.0 && !is_zero))) return {stop, errc::result_out_of_range};
  value = read;
  return {stop, errc()};
}

inline to_chars_result copied(const string& text, char* first, char* last) {
  if (text.size() > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
  return {std::copy(text.begin(), text.end(), first), errc()};
}

/// The fewest digits that are read as this number again.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format format) {
  char text[64];
  if (format == chars_format::hex) {
    snprintf(text, sizeof text, "%a", value);
    string digits = text;
    if (const size_t x = digits.find("0x"); x != digits.npos) digits.erase(x, 2);
    return copied(digits, first, last);
  }
  int precision = 0;
  do snprintf(text, sizeof text, "%.*e", precision, value);
  while (strtod(text, nullptr) != value && ++precision < 18);
  return copied(text, first, last);
}

/// With an exponent or without, whatever is shorter.
inline to_chars_result to_chars(char* first, char* last, double value) {
  char text[64];
  const string scientific(text, to_chars(text, text + sizeof text, value, chars_format::scientific).ptr);
  const size_t e = scientific.find('e');
  if (e == scientific.npos) return copied(scientific, first, last);  // "inf", "nan"
  const int power = atoi(scientific.c_str() + e + 1);
  string digits = scientific.substr(0, e), fixed;
  const string sign = digits[0] == '-' ? "-" : "";
  digits.erase(0, sign.size());
  if (digits.size() > 1) digits.erase(1, 1);
  const int n = static_cast<int>(digits.size());
  if (power < 0) {
    fixed = "0." + string(static_cast<size_t>(-power - 1), '0') + digits;
  } else if (power >= n - 1) {
    char whole[400];
    snprintf(whole, sizeof whole, "%.0f", fabs(value));
    fixed = whole;
  } else {
    fixed = digits.substr(0, static_cast<size_t>(power + 1)) + "." +
            digits.substr(static_cast<size_t>(power + 1));
  }
  return copied(sign.size() + fixed.size() <= scientific.size() ? sign + fixed : scientific, first, last);
}

}  // namespace std
#endif
#endif
