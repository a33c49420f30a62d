// A scene of a test that has blown up is read back like any other, and shows what is there.
#include "io/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/check.hpp"

namespace phy::io {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

Scene three_discs() {
  Scene s{0.01, 0.02, {{0.001, 0.001, 0.001}, {0.003, 0.001, 0.001}, {0.005, 0.001, 0.001}}, {}, {}, {}};
  s.links = {{0, 1, ContactKind::bonded}, {1, 2, ContactKind::touching}};
  s.frames.push_back({100.0, 0.001, 1e6, {{1e-5F, 2e-5F}, {1e-5F, 0.0F}, {0.0F, 0.0F}}});
  s.frames.push_back({200.0, 0.002, 2e6, {{2e-5F, 3e-5F}, {2e-5F, 0.0F}, {1e-5F, 0.0F}}});
  s.forces.push_back({200.0, 0.002, 2e6, {1000.0F, -250.0F}});
  return s;
}

TEST(Scene, WhatIsNoNumberStaysWhereItWasAndCarriesNothing) {
  Scene blown = three_discs();
  blown.frames[1].u[0] = {nan, inf};
  blown.frames[1].u[1] = {1e20F, 0.0F};  // finite, but nothing of the specimen
  blown.forces[0].F_n[0] = -inf;
  const std::string bytes = pack_scene(blown, TestKind("uniaxial"));
  EXPECT_NE(bytes.substr(0, bytes.find('\n')).find("\"lost\":4"), std::string::npos);
  const Scene back = unpack_scene(bytes, "scene.bin"), whole = three_discs();
  constexpr float quantum = 0.25e-6F;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(back.frames[1].u[0][i], whole.frames[0].u[0][i], quantum);
  EXPECT_NEAR(back.frames[1].u[1][0], 1e-5F, quantum);
  EXPECT_NEAR(back.frames[1].u[2][0], 1e-5F, quantum) << "the others keep their resolution";
  EXPECT_EQ(back.forces[0].F_n[0], 0.0F);
  EXPECT_NEAR(back.forces[0].F_n[1], -250.0F, 1.0F);
}

TEST(Scene, NumbersThatTheWriterNeverMakesAreRefused) {
  const std::string bytes = pack_scene(three_discs(), TestKind("uniaxial"));
  const std::size_t end = bytes.find('\n') + 1;
  const auto with = [&](const std::string& before, const std::string& now) {
    std::string head = bytes.substr(0, end);
    EXPECT_NE(head.find(before), head.npos) << before;
    return head.replace(head.find(before), before.size(), now) + bytes.substr(end);
  };
  for (const auto& [before, now] : std::vector<std::pair<std::string, std::string>>{
           {"\"n_discs\":3", "\"n_discs\":3.0"},
           {"\"n_discs\":3", "\"n_discs\":1e300"},
           {"\"n_links\":2", "\"n_links\":-2"},
           {"\"width [m]\":0.01", "\"width [m]\":0"},
           {"\"height [m]\":0.02", "\"height [m]\":1e300"},
           {"\"displacement_quantum [m]\":", "\"displacement_quantum [m]\":1e300,\"before\":"},
           {"\"disc_quantum [m]\":", "\"disc_quantum [m]\":1e3,\"before\":"},
           {"\"F_max [N/m]\":", "\"F_max [N/m]\":1e300,\"before\":"}})
    EXPECT_THROW(unpack_scene(with(before, now), "scene.bin"), InputError) << now;
  Scene odd = three_discs();
  odd.links[1].kind = static_cast<ContactKind>(9);
  EXPECT_THROW(unpack_scene(pack_scene(odd, TestKind("uniaxial")), "scene.bin"), InputError);
}

TEST(Scene, OfAnOrdinaryTestSaysNothingOfLosses) {
  const std::string bytes = pack_scene(three_discs(), TestKind("uniaxial"));
  EXPECT_EQ(bytes.substr(0, bytes.find('\n')).find("lost"), std::string::npos);
}

}  // namespace
}  // namespace phy::io
