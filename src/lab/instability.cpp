#include "lab/instability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "records/test_description.hpp"

namespace phy::lab {
namespace {

constexpr double deep = 0.05;       // mean overlap over the mean radius: ordinary are 1e-5 ... 1e-3
constexpr double shattering = 0.5;  // stress of one wave from a platen over the strength of the bonds
constexpr double violent = 0.1;     // kinetic energy over the work
constexpr double squeezed = 0.02;   // stress on the boundary over the contact modulus: rock fails far below
constexpr double undamped = 0.5;    // alpha: below it vibrations last long
constexpr double extreme = 100.0;   // ratio of two stiffnesses

class Suspects {
 public:
  Suspects(const Specimen& specimen, const Recipe& recipe, bool jacket, const HistoryRow& last, bool outran)
      : packing_(*specimen.packing), matrix_(specimen.matrix), bedding_(specimen.bedding), recipe_(recipe) {
    overlaps();
    boundary_stress(jacket);
    speed(last);
    if (recipe.engine.damping < undamped)
      add("raise engine.damping ({:g}): nothing takes vibrations away", recipe.engine.damping);
    stiffnesses();
    if (found_.empty() && outran)
      add("lower test.history_interval ({}): contacts are looked for that often",
          recipe.test.history_interval);
    if (found_.empty())
      add("lower engine.step_safety ({:g}){}", recipe.engine.step_safety,
          recipe.engine.precision == Precision::single_precision ? ", or use engine.precision = \"double\""
                                                                 : "");
  }
  std::string text() const { return fmt::format("{}", fmt::join(found_, "; ")); }

 private:
  const Packing& packing_;
  const MatrixRecipe& matrix_;
  const std::vector<BeddingRecipe>& bedding_;
  const Recipe& recipe_;
  std::vector<std::string> found_;

  template <class... Values>
  void add(fmt::format_string<Values...> format, const Values&... values) {
    found_.push_back(fmt::vformat(format, fmt::make_format_args(values...)));
  }
  void overlaps() {
    // Stress-free overlaps carry no force, however deep.
    if (packing_.stress_free || packing_.report.mean_overlap < deep) return;
    add("{}: discs overlap by {:.2g} of their radius at the start, and push each other",
        recipe_.packing.file.empty()
            ? "lower packing.isotropic_stress, or raise matrix.E_c"
            : "choose packing.initial_stress = \"stress_free\", or discs that overlap less",
        packing_.report.mean_overlap);
  }
  void boundary_stress(bool jacket) {
    const KeptStress& kept = recipe_.test.kind->kept_stress;
    const double stress = kept.value != nullptr ? recipe_.test.*kept.value : 0.0;
    // Rock fails far below, so that such a stress is a slip of the unit.
    if (stress < squeezed * matrix_.E_c) return;
    add("lower test.{}: it is {:.2g} of the contact modulus{}", kept.key, stress / matrix_.E_c,
        jacket ? "; test.confinement = \"walls\" does not drive grains that have come loose, as a jacket does"
               : "");
  }
  void speed(const HistoryRow& last) {
    const TestRecipe& test = recipe_.test;
    const bool approaching = std::fabs(last.axial_strain) < test.approach_strain;
    const char* const key = approaching ? "approach_speed" : "platen_speed";
    const double wave = std::sqrt(matrix_.modulus() * matrix_.density) *
                        (approaching ? test.approach_speed : test.platen_speed);
    const double strength = std::min(matrix_.sigma_c, matrix_.tau_c);
    const double moving = last.boundary_work > 0.0 ? last.kinetic / last.boundary_work : 0.0;
    // rho c v, doubled where it is reflected.
    if (wave > shattering * strength)
      add("lower test.{}: the wave that it sends in carries {:.2g} MPa, and the bonds bear {:.2g}", key,
          wave * 1e-6, strength * 1e-6);
    else if (moving > violent)
      add("lower test.{}: {:.0f} % of its work moves grains", key, 100.0 * moving);
  }
  void ratio(const char* key, double value, const char* of) {
    if (value > extreme || value * extreme < 1.0)
      add("{} is {:.1e} of {}: bring them closer", key, value, of);
  }
  void stiffnesses() {
    // Flat joints have one modulus.
    if (matrix_.model == MatrixModel::parallel_bond)
      ratio("matrix.E_b", matrix_.E_b / matrix_.E_c, "matrix.E_c");
    double radius = 0.0;
    for (const Disc& d : packing_.discs) radius += d.r / static_cast<double>(packing_.discs.size());
    for (const BeddingRecipe& set : bedding_) {
      ratio("bedding k_n", set.k_n * 2.0 * radius / matrix_.modulus(), "the stiffness of a grain");
      ratio("bedding k_s", set.k_s / set.k_n, "bedding k_n");
    }
  }
};

}  // namespace

std::string advice_on_instability(const Specimen& specimen, const Recipe& recipe,
                                  const engine::Boundary& boundary, const HistoryRow& last, bool outran) {
  return Suspects(specimen, recipe, boundary.jacket.sides, last, outran).text();
}

}  // namespace phy::lab
