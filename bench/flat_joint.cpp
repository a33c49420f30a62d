// Flat joints of 2, 3 and 4 elements against parallel bonds on one packing: thread CPU time of a step of the
// press, and the time step. 16 lanes of float under uniaxial compression, 1,290 discs, equal moduli
// (E_c = 76 GPa against 38 + 38). A block of parallel bonds is timed before every block of flat joints; what
// is told are the quartiles of these ratios, so that a busy machine slows both.
//
// intact: loaded elastically, nothing has broken. broken: the same tests driven on until 30 % of all elements
// have broken, near the peak or behind it, and timed there while they go on breaking (the share at the end of
// the timing is told). `alike`: one specimen in all lanes, which break at the same contacts; `unlike`: 16
// draws of the strengths, so that an interface is asked element by element as soon as it is broken in any
// lane. Parallel bonds are always timed intact: their cost does not depend on what has broken.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "base/clock.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"

namespace {

using namespace phy;

constexpr int lanes = 16, elastic_blocks = 10, rounds = 31;
constexpr double broken_share = 0.3;

Recipe recipe_of(std::int64_t elements, std::int64_t bond_seed) {
  Recipe r;
  r.specimen = {0.016, 0.032};
  r.packing.n_grains = 1290;
  r.test.platen_speed = 0.06;
  r.engine.precision = Precision::single_precision;
  MatrixRecipe& m = r.matrix;
  m.mu = 0.5, m.bond_seed = bond_seed;
  m.sigma_c = 20e6, m.sigma_c_sd = 2e6, m.tau_c = 100e6, m.tau_c_sd = 10e6;
  if (elements == 0) return r;
  m.model = MatrixModel::flat_joint;
  m.E_c = 76e9, m.elements = elements;
  return r;
}

/// A group of lanes under the press.
struct Press {
  std::unique_ptr<engine::LaneGroup> group;
  std::vector<std::unique_ptr<lab::Procedure>> tests;
  double parts = 0.0;  ///< that can break, in all lanes
  std::vector<bool> over = std::vector<bool>(lanes, false);

  Press(std::int64_t elements, bool alike) {
    for (int l = 0; l < lanes; ++l) {
      const Recipe r = recipe_of(elements, alike ? 1 : l + 1);
      const auto packing = genesis::packing_of(r, genesis::default_cache_folder());
      const auto s = std::make_shared<const Specimen>(genesis::make_specimens(packing, r).front());
      if (l == 0) {
        engine::GroupOptions options;
        options.isa = engine::native_isa();
        options.precision = r.engine.precision;
        options.lanes = lanes;
        options.contacts = &engine::physics_of(s->matrix, s->bedding);
        group = engine::make_group(packing, options);
      }
      parts +=
          static_cast<double>(s->contacts.size()) * static_cast<double>(std::max<std::int64_t>(elements, 1));
      tests.push_back(lab::make_test(s, r, *group, l));
    }
    for (int i = 0; i < elastic_blocks; ++i) block();
  }
  /// Tests that have come to their end go on at the speed of their platens.
  void block() {
    group->advance();
    for (std::size_t l = 0; l < lanes; ++l)
      if (!over[l]) over[l] = tests[l]->after_block();
  }
  double broken() {
    double n = 0.0;
    for (int l = 0; l < lanes; ++l) n += static_cast<double>(group->cracks(l).size());
    return n / parts;
  }
  double seconds() {
    const double start = thread_seconds();
    block();
    return thread_seconds() - start;
  }
};

void compare(Press& bonds, Press& joints, const char* state) {
  std::vector<double> ratios;
  double nanoseconds = 0.0;
  for (int i = 0; i < rounds; ++i) {
    const double one = bonds.seconds(), other = joints.seconds();
    ratios.push_back(other / one), nanoseconds += 1e9 * other / rounds;
  }
  std::sort(ratios.begin(), ratios.end());
  const double updates = 100.0 * lanes * static_cast<double>(joints.group->n_contacts(0));
  fmt::print("  {:6}  {:4.1f} % broken  {:.2f} ({:.2f} - {:.2f}) times parallel bonds, {:.2f} ns\n", state,
             100.0 * joints.broken(), ratios[rounds / 2], ratios[rounds / 4], ratios[3 * rounds / 4],
             nanoseconds / updates);
}

}  // namespace

int main() {
  for (const bool alike : {true, false}) {
    fmt::print("{} lanes of float on {}, {}\n", lanes, engine::to_string(engine::native_isa()),
               alike ? "alike" : "unlike");
    for (const std::int64_t elements : {2, 3, 4}) {
      Press bonds(0, alike), joints(elements, alike);
      fmt::print(" {} elements, time step {:.3f} of that of parallel bonds\n", elements,
                 joints.group->time_step(0) / bonds.group->time_step(0));
      compare(bonds, joints, "intact");
      for (int i = 0; i < 1000 && joints.broken() < broken_share; ++i) joints.block();
      Press fresh(0, alike);
      compare(fresh, joints, "broken");
    }
  }
}
