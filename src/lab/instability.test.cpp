// Is the cause named, and the time step blamed only where nothing else is out of the ordinary?
#include "lab/instability.hpp"

#include <gtest/gtest.h>

#include "lab/tests.hpp"
#include "records/assembly.hpp"

namespace phy::lab {
namespace {

std::string advice(const Recipe& r, const HistoryRow& last = {}, bool stress_free = true) {
  Specimen s = assembly(hexagonal(4, 4, 0.5e-3), r.matrix);
  auto packing = std::make_shared<Packing>(*s.packing);
  packing->stress_free = stress_free;
  packing->report.mean_overlap = 0.2;
  s.packing = packing;
  s.bedding = r.bedding;
  return advice_on_instability(s, r, boundary_of(*packing, r).boundary, last);
}

bool names(const std::string& text, const char* key) { return text.find(key) != text.npos; }

TEST(Instability, AnOrdinaryRecipeIsToldToLowerTheStep) {
  Recipe r;
  r.bedding.resize(1);
  EXPECT_EQ(advice(r), "lower engine.step_safety (0.92)");
  r.engine.precision = Precision::single_precision;
  EXPECT_TRUE(names(advice(r), "engine.precision = \"double\""));
}

TEST(Instability, AGrainThatOutranItsListAsksForAShorterInterval) {
  Specimen s;
  s.packing = std::make_shared<Packing>();
  Recipe r;
  EXPECT_EQ(advice_on_instability(s, r, {}, {}, true),
            "lower test.history_interval (100): contacts are looked for that often");
  r.engine.damping = 0.0;
  EXPECT_TRUE(names(advice_on_instability(s, r, {}, {}, true), "raise engine.damping"));
  EXPECT_FALSE(names(advice_on_instability(s, r, {}, {}, true), "history_interval"));
}

TEST(Instability, EveryCauseIsNamedByItsKey) {
  const auto of = [](auto change) {
    Recipe r;
    r.bedding.resize(1);
    change(r);
    return advice(r);
  };
  EXPECT_TRUE(names(of([](Recipe& r) { r.engine.damping = 0.0; }), "raise engine.damping (0)"));
  EXPECT_TRUE(names(of([](Recipe& r) { r.test.platen_speed = 10.0; }), "lower test.platen_speed: the wave"));
  EXPECT_TRUE(names(of([](Recipe& r) { r.test.approach_strain = 1e-3, r.test.approach_speed = 10.0; }),
                    "lower test.approach_speed: the wave"));
  EXPECT_TRUE(names(of([](Recipe& r) { r.matrix.E_b = 1e4 * r.matrix.E_c; }), "matrix.E_b is 1.0e+04 of"));
  EXPECT_TRUE(names(of([](Recipe& r) { r.bedding[0].k_n *= 1e5; }), "bedding k_n is"));
  EXPECT_TRUE(names(of([](Recipe& r) { r.bedding[0].k_s *= 1e-5; }), "bedding k_s is"));
  const std::string jacket = of([](Recipe& r) {
    r.test.kind = TestKind("biaxial"), r.test.confinement = Confinement::jacket;
    r.test.confining_stress = 0.1 * r.matrix.E_c;
  });
  EXPECT_TRUE(names(jacket, "lower test.confining_stress: it is 0.1 of") && names(jacket, "\"walls\""));
}

TEST(Instability, StateCountsBesideTheRecipe) {
  HistoryRow moving;
  moving.boundary_work = 10.0, moving.kinetic = 4.0;
  EXPECT_TRUE(names(advice({}, moving), "lower test.platen_speed: 40 % of its work moves grains"));
  EXPECT_TRUE(
      names(advice({}, {}, false), "lower packing.isotropic_stress, or raise matrix.E_c: discs overlap"));
  Recipe imported;
  imported.packing.file = "discs.csv";
  EXPECT_TRUE(names(advice(imported, {}, false), "packing.initial_stress = \"stress_free\""));
}

}  // namespace
}  // namespace phy::lab
