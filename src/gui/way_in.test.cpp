#include "gui/way_in.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/in_folder_fixture.hpp"

namespace phy::gui {
namespace {

namespace fs = std::filesystem;

class WayIn : public InFolder {
 protected:
  const std::string file = at(way_in_file);
  const std::string token = "0123456789abcdef0123456789abcdef";
  void leave() { write_way_in(file, "http://127.0.0.1:7337/?token=" + token); }
};

TEST_F(WayIn, TheNextStartTakesItsToken) {
  leave();
  EXPECT_EQ(kept_token(file), token);
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_NE(read(file).find("url=http://127.0.0.1:7337/?token=" + token), std::string::npos);
}

TEST_F(WayIn, WhatOthersCanReadIsNoSecret) {
  leave();
  for (const fs::perms others : {fs::perms::group_read, fs::perms::others_write}) {
    fs::permissions(file, fs::perms::owner_read | others);
    EXPECT_NE(kept_token(file), token);
  }
  fs::rename(file, at("elsewhere"));
  fs::permissions(at("elsewhere"), fs::perms::owner_read);
  fs::create_symlink(at("elsewhere"), file);
  EXPECT_NE(kept_token(file), token) << "a link of somebody else";
}

TEST_F(WayIn, WithoutATokenThereIsANewOne) {
  EXPECT_EQ(kept_token(file).size(), 32U);
  EXPECT_NE(kept_token(file), kept_token(file));
  for (const char* another : {"", "?token=0123", "?token=0123456789abcdef0123456789abcdeg"}) {
    write(way_in_file, another);
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(kept_token(file).find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_EQ(kept_token(file).size(), 32U);
  }
}

}  // namespace
}  // namespace phy::gui
