// THE list of laboratory tests: what is not here does not exist. Also what a recipe's test is asked for.
#pragma once
#include <memory>
#include <string>

#include "lab/procedure.hpp"
#include "lab/room.hpp"

namespace phy::lab {

/// The room of the recipe's test.
const TestRoom& room_of(const Recipe& recipe);

/// Tests with equal names on one packing have the same boundary and may share a group.
std::string boundary_name(const Recipe& recipe);

/// The boundary of the recipe's test.
TestBoundary boundary_of(const Packing& packing, const Recipe& recipe);

/// The recipe's test, in a lane of the group.
std::unique_ptr<Procedure> make_test(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe,
                                     engine::LaneGroup& group, int lane);

/// Runs the recipe's test on one specimen to its end, alone and in double precision.
TestResult run_alone(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe);

}  // namespace phy::lab
