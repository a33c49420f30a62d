// A rock mechanics laboratory on paper, for tests of the strength stage that need many tests: UCS(theta),
// strength under confinement, direct tension and Brazilian tests of a matrix with one set of bonded joints
// from closed forms, with scatter of packings and of runs, in place of the press. The moduli are Goodman's.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "base/rng.hpp"
#include "calibrate/simulator.hpp"
#include "theory/goodman.hpp"

namespace phy::calibrate {

class PaperPress : public Simulator {
 public:
  double packing_scatter = 0.03, run_scatter = 0.02;
  double first_crack = 0.1;      ///< place in the disc, over the diameter
  double modulus_scatter = 0.0;  ///< of the packings
  double coarse_bias = 0.06;     ///< of the logarithm, for packings of less than 5,000 grains
  std::function<bool(const Recipe&)> peaks = [](const Recipe&) { return true; };
  bool carries_load = true;    ///< false: the direct solution has no answer
  double tangent = 1.0;        ///< E of the press at half of the strength over that at small strain
  double closing = 0.0;        ///< what a stress of 10 MPa on the sides adds to that ratio
  bool stops_statics = false;  ///< the user stops in the middle of the direct solutions
  int n_threads = 1;
  std::int64_t stop_after = -1;  ///< tests, then the user has stopped; -1: never
  std::int64_t n_tests = 0;

  std::vector<ElasticResult> solve(const std::vector<Recipe>& recipes, Statics) override {
    if (stops_statics) throw Stopped{};
    std::vector<ElasticResult> results(recipes.size());
    for (std::size_t i = 0; i < recipes.size(); ++i) {
      const theory::JointedRock rock = rock_of(recipes[i]);
      results[i].E_gauge = modulus(recipes[i]);
      results[i].nu_gauge = theory::goodman_nu(rock, theta_of(recipes[i]));
      if (!carries_load) results[i].E_gauge = results[i].nu_gauge = std::nan("");
    }
    return results;
  }
  std::vector<TestResult> run(const std::vector<Recipe>& recipes) override {
    std::vector<TestResult> results(recipes.size());
    for (std::size_t i = 0; i < recipes.size(); ++i) {
      if (stopped()) continue;
      ++n_tests;
      const Recipe& r = recipes[i];
      const double noise = packing_scatter * draw(r, 0) + run_scatter * draw(r, 1);
      const double bias = r.packing.n_grains < 5000 ? coarse_bias * std::cos(theta_of(r) / 20.0) : 0.0;
      results[i].outcome = {Status::peaked, "", ""};
      if (!peaks(r)) results[i].outcome = {Status::not_peaked, "no drop", "raise test.max_strain"};
      if (r.test.kind == TestKind("direct_tension"))
        results[i].numbers.push_back({"sigma_t", tension(r) * std::exp(noise + bias), "Pa", "", ""});
      else if (r.test.kind == TestKind("brazilian"))
        results[i].numbers = {{"bts", splitting(r) * std::exp(noise + bias), "Pa", "", ""},
                              {"first_crack_x", first_crack, "1", "", ""},
                              {"first_crack_y", 0.0, "1", "", ""}};
      else if (r.test.kind == TestKind("semi_circular_bend"))
        results[i].numbers.push_back(
            {"K_Ic_apparent", toughness(r) * std::exp(noise + bias), "Pa sqrt(m)", "", ""});
      else if (r.test.kind == TestKind("biaxial"))
        results[i].numbers = {{"sigma_1", confined(r) * std::exp(noise + bias), "Pa", "", ""},
                              {"E_tangent", tangent_modulus(r), "Pa", "", ""},
                              {"nu", theory::goodman_nu(rock_of(r), theta_of(r)), "1", "", ""}};
      else
        results[i].numbers = {{"ucs", ucs(r) * std::exp(noise + bias), "Pa", "", ""},
                              {"sigma_ci_strain", initiation(r) * std::exp(noise + bias), "Pa", "", ""},
                              {"E_tangent", tangent_modulus(r), "Pa", "", ""},
                              {"nu", theory::goodman_nu(rock_of(r), theta_of(r)), "1", "", ""}};
    }
    return results;
  }
  int threads() const override { return n_threads; }
  bool stopped() const override { return stop_after >= 0 && n_tests >= stop_after; }

  /// Without scatter.
  static double ucs(Recipe r) {
    r.test.confining_stress = 0.0;
    return confined(r);
  }

  /// At half of the strength.
  double tangent_modulus(const Recipe& r) const {
    const double ratio = tangent + closing * r.test.confining_stress / 10e6;
    return ratio * modulus(r);
  }
  double modulus(const Recipe& r) const {
    return theory::goodman_E(rock_of(r), theta_of(r)) * std::exp(modulus_scatter * draw(r, 0));
  }

  /// Cracks begin at a share of the strength that slits take most of.
  static double initiation(const Recipe& r) { return (0.85 - 1.5 * r.matrix.unbonded_fraction) * ucs(r); }

  /// Bonds and friction of the grains, or joints that slide: each has its own friction.
  static double confined(const Recipe& r) {
    const MatrixRecipe& m = r.matrix;
    const double sigma_3 = r.test.confining_stress;
    const double matrix = 2.2 * std::pow(m.sigma_c, 0.7) * std::pow(m.tau_c, 0.3) * (0.85 + 0.25 * m.mu) +
                          (2.0 + 4.0 * m.mu) * sigma_3;
    if (r.bedding.empty()) return matrix;
    const BeddingRecipe& b = r.bedding.front();
    const double a = theta_of(r) * 3.14159265358979323846 / 180.0, s = std::sin(a), c = std::cos(a);
    // sliding resists with cohesion, friction and, in part, the tensile strength of the joints
    const double bonded = b.cohesion * (0.7 + 0.6 * b.mu) + 0.5 * b.sigma_n;
    const double slide = 1.6 * (bonded + 1.5 * b.mu * sigma_3) / (s * c + 0.02) + sigma_3;
    return std::pow(std::pow(matrix, -6.0) + std::pow(slide, -6.0), -1.0 / 6.0);
  }

  /// Bonds in tension, or joints that open or slide.
  static double tension(const Recipe& r) {
    const double matrix = 0.5 * r.matrix.sigma_c;
    if (r.bedding.empty()) return matrix;
    const BeddingRecipe& b = r.bedding.front();
    const double a = theta_of(r) * 3.14159265358979323846 / 180.0, s = std::sin(a), c = std::cos(a);
    const double joint = 1.6 / (c * c / b.sigma_n + s * c / b.cohesion + 1e-9 / b.cohesion);
    return std::pow(std::pow(matrix, -4.0) + std::pow(joint, -4.0), -0.25);
  }

  /// A disc splits along its load: tension a quarter turn away, 1.2 times as strong, size of disc 38 mm.
  static double splitting(const Recipe& r) {
    Recipe turned = r;
    if (!r.bedding.empty()) turned.bedding.front().theta = 90.0 - theta_of(r);
    const double size = r.test.disc_diameter > 0.0 ? std::pow(0.038 / r.test.disc_diameter, 0.2) : 1.0;
    return 1.2 * size * tension(turned);
  }

  /// Of what a disc splits at and the root of the grains (Potyondy & Cundall 2004).
  static double toughness(const Recipe& r) { return 2.2 * splitting(r) * std::sqrt(grain_size(r)); }

 private:
  static double theta_of(const Recipe& r) { return r.bedding.empty() ? 0.0 : r.bedding.front().theta; }
  static theory::JointedRock rock_of(const Recipe& r) {
    const bool flat = r.matrix.model == MatrixModel::flat_joint;
    const double E = 0.9 * (r.matrix.E_c + (flat ? r.matrix.E_c : r.matrix.E_b)) *
                     (1.0 - 0.4 * r.matrix.unbonded_fraction);
    if (r.bedding.empty()) return {E, 1e20, 1e20, 0.25};
    const BeddingRecipe& b = r.bedding.front();
    return {E, 1.8 * b.k_n * b.spacing, 1.8 * b.k_s * b.spacing, 0.25};
  }
  /// Standard normal: of the packing (one number per angle) or of the run.
  static double draw(const Recipe& r, std::uint32_t what) {
    const auto seed = static_cast<std::uint32_t>(r.packing.seed);
    const auto angle = static_cast<std::uint32_t>(theta_of(r));
    const auto run = what == 0 ? 0U : static_cast<std::uint32_t>(r.matrix.tau_c / r.matrix.sigma_c * 1e6);
    return normal(seed + 77U * what, Stream::test, angle, run);
  }
};

}  // namespace phy::calibrate
