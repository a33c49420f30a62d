#include "lab/tests.hpp"

#include <array>

#include "base/check.hpp"
#include "lab/biaxial/biaxial.hpp"
#include "lab/brazilian/brazilian.hpp"
#include "lab/direct_shear/direct_shear.hpp"
#include "lab/direct_tension/direct_tension.hpp"
#include "lab/opening/opening.hpp"
#include "lab/semi_circular_bend/semi_circular_bend.hpp"
#include "lab/uniaxial/uniaxial.hpp"

namespace phy::lab {
namespace {

/// In the order of `phyllite recipe --explain`.
const auto& rooms() {
  static const std::array all = {&uniaxial_room(), &direct_tension_room(), &brazilian_room(),
                                 &biaxial_room(),  &direct_shear_room(),   &semi_circular_bend_room(),
                                 &opening_room()};
  return all;
}

std::span<const TestDescription* const> descriptions() {
  // Made once: kinds of recipes and results are pointers into this list.
  static const auto tests = [] {
    std::array<const TestDescription*, std::tuple_size_v<std::decay_t<decltype(rooms())>>> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = &rooms()[i]->description;
    return all;
  }();
  return tests;
}

}  // namespace

const TestRoom& room_of(const Recipe& recipe) {
  for (const TestRoom* room : rooms())
    if (&room->description == &*recipe.test.kind) return *room;
  PHY_CHECK(false, "every test has its room");
  return *rooms().front();
}

std::string boundary_name(const Recipe& recipe) { return room_of(recipe).boundary_name(recipe); }

TestBoundary boundary_of(const Packing& packing, const Recipe& recipe) {
  return room_of(recipe).boundary(packing, recipe);
}

std::unique_ptr<Procedure> make_test(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe,
                                     engine::LaneGroup& group, int lane) {
  const TestRoom& room = room_of(recipe);
  const auto boundary = std::make_shared<const TestBoundary>(room.boundary(*specimen->packing, recipe));
  return room.begin({specimen, recipe, boundary}, group, lane);
}

TestResult run_alone(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe) {
  engine::GroupOptions options;
  options.isa = engine::native_isa();
  options.interval = static_cast<int>(recipe.test.history_interval);
  options.inertia = recipe.engine.grain_inertia;
  options.contacts = &engine::physics_of(specimen->matrix, specimen->bedding);
  // A group of one lane: the same code as in a study, and the same bits.
  const auto group = engine::make_group(specimen->packing, options);
  const auto test = make_test(specimen, recipe, *group, 0);
  do group->advance();
  while (!test->after_block());
  return test->take_result();
}

}  // namespace phy::lab

std::span<const phy::TestDescription* const> phy::laboratory_tests() { return lab::descriptions(); }
