// Flat joints of 2, 3 and 4 elements against parallel bonds on one packing: thread CPU time of a step of the
// press, and the time step. Lanes of float, 16 with AVX-512, under uniaxial compression, 1,290 discs, equal
// moduli (E_c = 76 GPa against 38 + 38). A block of parallel bonds is timed before every block of flat
// joints; what is told are the quartiles of these ratios, so that a busy machine slows both.
//
// intact: nothing has broken. slits: 30 % of the elements are broken from the start, as interfaces without
// any bond (unbonded_fraction = 0.3 of both models), which the press shuts and shears; nothing else breaks.
// `alike`: one specimen in all lanes, so that 30 % of the interfaces are asked element by element; `unlike`:
// 16 draws, and nearly all are, for each has a slit in some lane.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"
#include "system/process.hpp"

namespace {

using namespace phy;

constexpr int blocks_before = 10, rounds = 31;
const int lanes = engine::native_lanes(Precision::single_precision, engine::native_isa());

/// elements = 0: parallel bonds.
Recipe recipe_of(std::int64_t elements, double slits, std::int64_t bond_seed) {
  Recipe r;
  r.specimen = {0.016, 0.032};
  r.packing.n_grains = 1290;
  r.test.platen_speed = 0.06;
  r.engine.precision = Precision::single_precision;
  MatrixRecipe& m = r.matrix;
  m.mu = 0.5, m.bond_seed = bond_seed, m.unbonded_fraction = slits;
  m.sigma_c = 1e9, m.tau_c = 5e9;  // what does not break keeps its state
  if (elements == 0) return r;
  m.model = MatrixModel::flat_joint;
  m.E_c = 76e9, m.elements = elements;
  return r;
}

/// A group of lanes under the press.
struct Press {
  std::vector<Recipe> recipes;  ///< the tests refer to them
  std::unique_ptr<engine::LaneGroup> group;
  std::vector<std::unique_ptr<lab::Procedure>> tests;

  Press(const Press&) = delete;
  Press(std::int64_t elements, double slits, bool alike) {
    for (int l = 0; l < lanes; ++l) recipes.push_back(recipe_of(elements, slits, alike ? 1 : l + 1));
    const Recipe& first = recipes.front();
    const auto packing = genesis::packing_of(first, genesis::default_cache_folder());
    engine::GroupOptions options;
    options.isa = engine::native_isa();
    options.precision = first.engine.precision;
    options.lanes = lanes;
    options.contacts = &engine::physics_of(first.matrix, first.bedding);
    group = engine::make_group(packing, options);
    for (int l = 0; l < lanes; ++l) {
      const Recipe& r = recipes[static_cast<std::size_t>(l)];
      const auto s = std::make_shared<const Specimen>(genesis::make_specimens(packing, r).front());
      tests.push_back(lab::make_test(s, r, *group, l));
    }
    for (int i = 0; i < blocks_before; ++i) block();
  }
  void block() {
    group->advance();
    for (const auto& t : tests) t->after_block();
  }
  double seconds() {
    const double start = phy::system::thread_seconds();
    block();
    return phy::system::thread_seconds() - start;
  }
};

void compare(std::int64_t elements, double slits, bool alike) {
  Press bonds(0, slits, alike), joints(elements, slits, alike);
  std::vector<double> ratios;
  double sum = 0.0;
  for (int i = 0; i < rounds; ++i) {
    const double one = bonds.seconds(), other = joints.seconds();
    ratios.push_back(other / one), sum += other;
  }
  std::sort(ratios.begin(), ratios.end());
  const double updates = 100.0 * lanes * rounds * static_cast<double>(joints.group->n_contacts(0));
  fmt::print(
      "{} elements, {}, lanes {:6}  {:.2f} ({:.2f} - {:.2f}) times parallel bonds, {:.2f} ns; step {:.3f}\n",
      elements, slits > 0.0 ? "slits " : "intact", alike ? "alike" : "unlike", ratios[rounds / 2],
      ratios[rounds / 4], ratios[3 * rounds / 4], 1e9 * sum / updates,
      joints.group->time_step(0) / bonds.group->time_step(0));
}

}  // namespace

int main() {
  fmt::print("{} lanes of float on {}\n", lanes, engine::to_string(engine::native_isa()));
  for (const std::int64_t elements : {2, 3, 4}) {
    compare(elements, 0.0, true);
    for (const bool alike : {true, false}) compare(elements, 0.3, alike);
  }
}
