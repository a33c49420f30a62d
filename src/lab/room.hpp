// The room of a laboratory test: what it is, for everybody, and how it is done, for the laboratory. A test is
// one folder that fills this in, and one line in the list (tests.cpp).
#pragma once
#include <memory>
#include <string>

#include "lab/boundaries.hpp"
#include "lab/procedure.hpp"
#include "records/test_description.hpp"

namespace phy::lab {

/// The key that decides which grains the bodies hold: what to change where they hold none.
struct HoldKey {
  const char* key = "";                 ///< "test.grip_thickness"
  double TestRecipe::*value = nullptr;  ///< [m]; null: the test has no such key
  const char* expected = "";
  const char* remedy = "";
};

struct TestRoom {
  TestDescription description;
  /// Tests with equal names on one packing have the same boundary and may share a group.
  std::string (*boundary_name)(const Recipe&) = nullptr;
  TestBoundary (*boundary)(const Packing&, const Recipe&) = nullptr;
  /// The procedure, in a lane of the group.
  std::unique_ptr<Procedure> (*begin)(const TestSetup&, engine::LaneGroup&, int lane) = nullptr;
  HoldKey hold = {};
};

/// TestRoom::begin of a procedure, which has the constructor of Procedure.
template <class P>
std::unique_ptr<Procedure> begin_test(const TestSetup& setup, engine::LaneGroup& group, int lane) {
  auto test = std::make_unique<P>(setup, group, lane);
  test->begin();
  return test;
}

}  // namespace phy::lab
