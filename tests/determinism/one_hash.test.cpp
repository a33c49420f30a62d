// One hash: the same recipe and precision give the same bits for every number of lanes, instruction set,
// thread count, skew, lane neighbour and compiler. The recorded hashes are those of g++ 12 and hold for clang
// as well (make clang-hash).
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <set>

#include "base/recorded_fixture.hpp"
#include "contact/models.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"
#include "records/test_description.hpp"
#include "study/worker.hpp"
#include "verification/golden.hpp"

namespace phy {
namespace {

Recipe small_recipe(Precision precision) {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  r.matrix.sigma_c = r.matrix.tau_c = 40e6;
  r.bedding = {BeddingRecipe{}};
  r.bedding[0].spacing = 0.002;
  r.test.angles = {0.0, 30.0, 60.0, 90.0};
  r.test.intact = true;
  r.test.platen_speed = 0.2;
  r.test.n_snapshots = 2;
  r.engine.precision = precision;
  return r;
}

std::vector<std::shared_ptr<const Specimen>> specimens_of(const Recipe& r) {
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  std::vector<std::shared_ptr<const Specimen>> all;
  for (Specimen& s : genesis::make_specimens(packing, r))
    all.push_back(std::make_shared<const Specimen>(std::move(s)));
  return all;
}

std::vector<std::string> hashes(const Recipe& r,
                                const std::vector<std::shared_ptr<const Specimen>>& specimens,
                                const study::MachineOptions& machine) {
  std::vector<std::string> h;
  for (const TestResult& result : study::run_tests(specimens, r, machine)) h.push_back(result.hash);
  return h;
}

study::MachineOptions narrowest(Precision precision) {
  study::MachineOptions machine;
  machine.lanes = precision == Precision::single_precision ? 4 : 1, machine.skew = 1;
  return machine;
}
study::MachineOptions widest(Precision precision) {
  study::MachineOptions machine;
  machine.isa = engine::native_isa();
  machine.lanes = engine::native_lanes(precision, machine.isa), machine.skew = 9, machine.threads = 2;
  return machine;
}

/// Each specimen in a group of its own, its contacts side by side; narrowest() in double is one contact after
/// the other.
study::MachineOptions alone() {
  study::MachineOptions machine;
  machine.isa = engine::native_isa();
  machine.lanes = 1, machine.skew = 6, machine.threads = 2;
  return machine;
}

TEST(OneHashOfEqualMasses, ForLanesSetsAndThreads) {
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    Recipe r = small_recipe(precision);
    const auto specimens = specimens_of(r);
    const std::vector<std::string> discs = hashes(r, specimens, narrowest(precision));
    r.engine.grain_inertia = GrainInertia::equal;
    const std::vector<std::string> expected = hashes(r, specimens, narrowest(precision));
    EXPECT_NE(expected, discs);
    for (const study::MachineOptions& machine : {widest(precision), alone()})
      EXPECT_EQ(hashes(r, specimens, machine), expected);
  }
}

// Written down once: a change of any bit of the physics shows here and has to be explained in the changelog.
TEST(GoldenHashes, AreTheRecordedOnes) {
  std::string before;
  study::MachineOptions machine;
  machine.isa = engine::native_isa(), machine.threads = 2;
  for (const verification::GoldenHash& h : verification::golden_hashes(machine)) {
    expect_recorded(h.name, h.hash);
    EXPECT_NE(h.hash, before) << h.name << " is the test before it";
    before = h.hash;
  }
}

TEST(GoldenHashes, AreOfEveryKindModelAndPrecision) {
  std::set<std::string> names;
  std::set<std::size_t> models;
  for (const verification::GoldenTest& t : verification::golden_tests()) {
    EXPECT_TRUE(names.insert(t.name).second) << t.name << " twice";
    models.insert(contact::combination_of(t.recipe.matrix, t.recipe.bedding));
  }
  EXPECT_EQ(models.size(), std::tuple_size_v<contact::Combinations>);
  EXPECT_EQ(names.size(), laboratory_tests().size() * models.size() * 2);
}

// Every kind of test with every contact model: the narrowest lanes of the portable instruction set on one
// thread, the widest of this processor on two, each alone, and groups that tests move between.
TEST(OneHashOfEveryKindAndModel, ForLanesSetsThreadsAndSkew) {
  for (const verification::GoldenTest& golden : verification::golden_tests()) {
    Recipe r = golden.recipe;
    r.test.angles = {30.0, 75.0};
    r.test.max_strain = 0.002;
    const auto specimens = specimens_of(r);
    const Precision precision = r.engine.precision;
    std::vector<std::string> reference;
    std::size_t n_cracks = 0;
    for (const TestResult& result : study::run_tests(specimens, r, narrowest(precision)))
      reference.push_back(result.hash), n_cracks += result.cracks.size();
    EXPECT_GT(n_cracks, 0U) << golden.name;
    EXPECT_EQ(reference, hashes(r, specimens, widest(precision))) << golden.name;
    EXPECT_EQ(reference, hashes(r, specimens, alone())) << golden.name << ", alone";
    if (precision == Precision::double_precision) continue;
    study::MachineOptions shared;
    shared.threads = 3;  // lanes 0: tests move to other groups
    EXPECT_EQ(reference, hashes(r, specimens, shared)) << golden.name;
  }
}

class OneHash : public testing::TestWithParam<Precision> {};

TEST_P(OneHash, ForLanesSetsThreadsSkewAndNeighbours) {
  const Recipe r = small_recipe(GetParam());
  const auto specimens = specimens_of(r);
  const auto reference = hashes(r, specimens, narrowest(GetParam()));
  study::MachineOptions machine;
  for (const engine::Isa isa : {engine::Isa::sse2, engine::Isa::avx2, engine::Isa::avx512}) {
    if (isa > engine::native_isa()) continue;
    for (const int lanes : engine::lanes_of(GetParam(), isa)) {
      machine = {};
      machine.isa = isa;
      machine.lanes = lanes;
      machine.threads = 1 + lanes % 3;
      machine.skew = 1 + lanes;
      EXPECT_EQ(hashes(r, specimens, machine), reference)
          << engine::to_string(isa) << ", " << lanes << " lanes";
    }
  }
}

// Without a fixed number of lanes a lane batch grows narrower as its tests end, and those who have run dry
// are given tests in the middle of their course.
TEST_P(OneHash, ForTestsThatMoveBetweenGroups) {
  const Recipe r = small_recipe(GetParam());
  const auto specimens = specimens_of(r);
  const auto reference = hashes(r, specimens, narrowest(GetParam()));
  study::MachineOptions machine;
  for (const int threads : {1, 2, 3, 5}) {
    machine = {};
    machine.isa = engine::native_isa();
    machine.threads = threads;
    EXPECT_EQ(hashes(r, specimens, machine), reference) << threads << " threads";
  }
}

/// Hash of a test that goes to another group after every block, into lanes and to one of its own; `stay`: of
/// one that does not.
std::string wanderer(const Recipe& r, const std::shared_ptr<const Specimen>& specimen,
                     const std::shared_ptr<const Specimen>& neighbour, bool stay) {
  engine::GroupOptions options;
  options.precision = r.engine.precision;
  options.isa = engine::native_isa();
  options.interval = static_cast<int>(r.test.history_interval);
  const std::vector<int> lanes = engine::lanes_of(r.engine.precision, options.isa);
  const std::array<int, 3> widths = {lanes[1], lanes.back(), 1};
  std::array<std::unique_ptr<engine::LaneGroup>, 3> groups;
  for (const std::size_t i : {0U, 1U, 2U}) {
    options.lanes = widths[i];
    groups[i] = engine::make_group(specimen->packing, options);
  }
  // In the other group a lane neighbour that is ahead, with contacts and touches of its own.
  const auto other = lab::make_test(neighbour, r, *groups[1], 0);
  for (int block = 0; block < 20; ++block) {
    groups[1]->advance();
    if (other->after_block()) break;
  }
  const auto test = lab::make_test(specimen, r, *groups[0], 1);
  for (std::size_t at = 0;;) {
    groups[at]->advance();
    if (test->after_block()) return test->take_result().hash;
    if (stay) continue;
    at = (at + 1) % groups.size();
    test->move_to(*groups[at], widths[at] == 1 ? 0 : 1);
  }
}

// In whatever phase a test is: settling, preparing, loading, loaded anew after a pre-strain that went too
// far.
TEST_P(OneHash, ForATestThatMovesAfterEveryBlock) {
  const auto check = [](const Recipe& r, const char* what) {
    const auto specimens = specimens_of(r);
    EXPECT_EQ(wanderer(r, specimens[2], specimens[0], false), wanderer(r, specimens[2], specimens[0], true))
        << r.test.kind->name << what;
  };
  Recipe base = small_recipe(GetParam());
  base.test.confining_stress = base.test.normal_stress = 5e6;
  base.test.normal_stiffness = 1e12;
  base.test.shear_gap = 0.002;
  base.test.max_strain = 0.002;
  base.test.platen_speed = 0.4;
  for (const TestDescription* test : laboratory_tests()) {
    base.test.kind = *test;
    check(base, "");
  }
  Recipe r = base;
  r.test.kind = TestKind("biaxial");
  r.test.confinement = Confinement::jacket;
  check(r, ", jacket");
  r.packing.initial_stress = InitialStress::isotropic;
  r.packing.isotropic_stress = 1e6;
  check(r, ", jacket, isotropic stress");
  r = base;
  r.test.kind = TestKind("uniaxial");
  for (const double pre_strain : {5e-4, 2e-2}) {
    r.test.pre_strain = pre_strain;
    r.test.max_strain = pre_strain + 5e-4;
    check(r, ", affine pre-strain");
  }
  r = base;
  r.test.approach_strain = 0.4 * r.test.max_strain, r.test.approach_speed = 3.0 * r.test.platen_speed;
  check(r, ", fast approach");
}

TEST_P(OneHash, ForASpecimenAlone) {
  const Recipe r = small_recipe(GetParam());
  const auto specimens = specimens_of(r);
  study::MachineOptions machine;
  machine.isa = engine::native_isa();
  machine.lanes = engine::native_lanes(GetParam(), machine.isa);
  const auto together = hashes(r, specimens, machine);
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    EXPECT_EQ(hashes(r, {specimens[i]}, machine).front(), together[i]) << specimens[i]->name;
  }
}

TEST_P(OneHash, CoversBreakage) {
  const Recipe r = small_recipe(GetParam());
  study::MachineOptions machine;
  machine.isa = engine::native_isa();
  std::size_t n_cracks = 0;
  for (const TestResult& result : study::run_tests(specimens_of(r), r, machine))
    n_cracks += result.cracks.size();
  EXPECT_GT(n_cracks, 200U);
}

INSTANTIATE_TEST_SUITE_P(Precisions, OneHash,
                         testing::Values(Precision::double_precision, Precision::single_precision),
                         [](const auto& which) {
                           return which.param == Precision::double_precision ? "double_lanes" : "float_lanes";
                         });

}  // namespace
}  // namespace phy
