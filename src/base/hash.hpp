// A 64-bit fingerprint for "the same to the last bit": FNV-1a (Fowler, Noll, Vo) over bytes, with the
// values laid out little-endian. It tells equal from unequal results; it is no protection against forgery.
// And one of 128 bits, for names in a store.
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace phy {

class Hash {
 public:
  void bytes(const void* data, std::size_t n) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < n; ++i) value_ = (value_ ^ p[i]) * 0x100000001b3ULL;
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T x) { bytes(&x, sizeof x); }
  void add(std::string_view s) {
    add(static_cast<std::uint64_t>(s.size()));
    bytes(s.data(), s.size());
  }
  std::uint64_t value() const { return value_; }
  /// Sixteen hexadecimal digits.
  std::string text() const {
    static const char* digit = "0123456789abcdef";
    std::string s(16, '0');
    for (unsigned i = 0; i < 16; ++i) s[15 - i] = digit[(value_ >> (4 * i)) & 15U];
    return s;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// 32 hexadecimal digits that name a text among any number of others (XXH3, 128 bits, xxhash.com): two of
/// 10^9 texts have the same with a probability of 10^-21.
std::string fingerprint_of(std::string_view text);

}  // namespace phy
