#include "base/hash.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace phy {

std::string fingerprint_of(std::string_view text) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, XXH3_128bits(text.data(), text.size()));
  static const char* digit = "0123456789abcdef";
  std::string s;
  for (const unsigned char b : bytes.digest) s += digit[b >> 4U], s += digit[b & 15U];
  return s;
}

}  // namespace phy
