#include "lab/scene_room.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/check.hpp"

namespace phy::lab {
namespace {

/// As many discs, and two and a half contacts for each, as bonded rock has.
Specimen specimen(std::size_t n_discs) {
  auto packing = std::make_shared<Packing>();
  packing->discs.resize(n_discs);
  Specimen s;
  s.packing = packing, s.contacts.resize(n_discs * 5 / 2);
  return s;
}

TEST(SceneRoom, AMillionGrainsHaveRoomForTheUsualFrames) {
  EXPECT_NO_THROW(check_scene_room(specimen(1000000), Recipe{}));
}

TEST(SceneRoom, FramesAndSnapshotsThatCouldNotBeReadAreRefused) {
  Recipe frames, snapshots;
  frames.test.n_frames = 1000, snapshots.test.n_frames = 0, snapshots.test.n_snapshots = 200;
  EXPECT_NO_THROW(check_scene_room(specimen(50000), frames));
  try {
    check_scene_room(specimen(200000), frames);
    FAIL() << "not refused";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("test.n_frames = 1000, with n_snapshots = 5"),
                                         testing::HasSubstr("200000 grains up to 2.4 GB")));
  }
  EXPECT_THROW(check_scene_room(specimen(1000000), snapshots), InputError);
}

}  // namespace
}  // namespace phy::lab
