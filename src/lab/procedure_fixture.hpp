// Small specimens on small groups, for the tests of the laboratory's rooms.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "analysis/histories_fixture.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"

namespace phy::lab {

/// 8 x 16 mm, 330 grains, no bedding.
inline Recipe small_rock(TestKind kind) {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  r.test.kind = kind;
  r.test.platen_speed = 0.05;
  r.test.history_interval = 20;
  return r;
}

inline std::shared_ptr<const Packing> small_packing(const Recipe& r) {
  return std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
}

/// The first specimen of the recipe, tested alone.
inline TestResult run_alone(const Recipe& r) {
  return run_alone(std::make_shared<const Specimen>(genesis::make_specimens(small_packing(r), r).front()), r);
}

/// The marble of the analysis' tests as a history of that test.
inline History marble_of(const char* test) {
  History h = analysis::marble();
  h.kind = TestKind(test), h.width = h.height = 0.1;
  return h;
}

/// Definitions name the stress of their test; only the press's is an axial one.
inline void expect_speaks_of(const std::string& stress, const std::vector<Number>& numbers) {
  const Number* first = analysis::find(numbers, "sigma_first_crack");
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->definition, stress + " at the first crack");
  for (const Number& n : numbers) {
    if (stress == "axial stress" || n.name == "sigma_1") continue;  // that one is the axial stress
    EXPECT_EQ(n.definition.find("axial stress"), std::string::npos) << n.name << ": " << n.definition;
  }
}

inline const Number& number(const TestResult& r, const std::string& name) {
  const Number* n = analysis::find(r.numbers, name);
  static const Number absent{"", std::nan(""), "", "", "absent"};
  return n == nullptr ? absent : *n;
}

}  // namespace phy::lab
