// Does every text come back, and is a damaged one found out?
#include "io/deflate.hpp"

#include <gtest/gtest.h>

namespace phy::io {
namespace {

std::string long_text() {
  std::string text;
  for (int i = 0; i < 40000; ++i) text += std::to_string(i * 7919 % 10007) + (i % 9 == 0 ? "\n" : ",");
  return text;
}

TEST(Deflate, GivesBackWhatWentIn) {
  for (const std::string& text : {std::string(), std::string("a"), std::string("\0\xff\0", 3), long_text()})
    EXPECT_EQ(inflated(deflated(text)), text);
  EXPECT_LT(deflated(long_text()).size(), long_text().size() / 2);
}

TEST(Deflate, KnowsDamage) {
  const std::string text = long_text(), bytes = deflated(text);
  std::string flipped = bytes;
  flipped[bytes.size() / 2] = static_cast<char>(flipped[bytes.size() / 2] ^ 1);
  for (const std::string& damaged : {std::string(), bytes.substr(0, bytes.size() - 1), flipped, text})
    EXPECT_FALSE(inflated(damaged));
}

TEST(Deflate, StopsBeyondWhatIsAllowed) {
  const std::string text = long_text(), bytes = deflated(text);
  EXPECT_EQ(inflated(bytes, text.size()), text);
  EXPECT_FALSE(inflated(bytes, text.size() - 1));
}

}  // namespace
}  // namespace phy::io
