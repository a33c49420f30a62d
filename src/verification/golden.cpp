#include "verification/golden.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/check.hpp"
#include "base/embedded.hpp"
#include "base/hash.hpp"
#include "base/least_squares.hpp"
#include "base/parallel.hpp"
#include "base/rng.hpp"
#include "base/stats.hpp"
#include "contact/model.hpp"
#include "contact/models.hpp"
#include "genesis/packing.hpp"
#include "records/test_description.hpp"
#include "study/experiment.hpp"
#include "study/worker.hpp"

namespace phy::verification {
namespace {

/// 8 x 16 mm, planes every 2 mm at 30 degrees, weak enough to break soon.
Recipe scene() {
  Recipe r;
  r.name = "golden";
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  r.matrix.sigma_c = r.matrix.tau_c = 40e6;
  r.bedding.resize(1);
  r.bedding[0].spacing = 0.002;
  r.bedding[0].theta = 30.0;
  r.test.platen_speed = 0.2;
  r.test.n_snapshots = 2;
  r.test.confining_stress = r.test.normal_stress = r.test.vertical_stress = 5e6;
  r.test.shear_gap = 0.002;
  return r;
}

struct Model {
  const char* name;
  void (*choose)(MatrixRecipe&);
};

/// A matrix for every line of the list of contact models, in its order.
constexpr std::array<Model, std::tuple_size_v<contact::Combinations>> models = {
    {{"parallel_bond", [](MatrixRecipe&) {}},
     {"directions",
      [](MatrixRecipe& m) { m.stiffness_ratio = 1.8, m.tension_ratio = 2.0, m.unbonded_fraction = 0.1; }},
     {"flat_joint", [](MatrixRecipe& m) {
        m.model = MatrixModel::flat_joint;
        m.sigma_c = 20e6, m.sigma_c_sd = 2e6, m.tau_c_sd = 4e6;
        m.unbonded_fraction = 0.1, m.gapped_fraction = 0.05, m.initial_gap = 1e-7;
      }}}};

std::vector<GoldenTest> make_tests() {
  std::vector<GoldenTest> all;
  for (const TestDescription* kind : laboratory_tests())
    for (std::size_t i = 0; i < models.size(); ++i)
      for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
        PHY_CHECK(models[i].choose != nullptr, "every contact model has a golden scene");
        Recipe r = scene();
        models[i].choose(r.matrix);
        PHY_CHECK(contact::combination_of(r.matrix, r.bedding) == i,
                  "golden scenes are in the order of models");
        r.test.kind = *kind;
        // Tests that never stop by themselves would take most of the time.
        if (kind->runs_to_end) r.test.max_strain = 0.004;
        r.engine.precision = precision;
        const bool single = precision == Precision::single_precision;
        all.push_back({std::string(kind->name) + "/" + models[i].name + (single ? "/float" : "/double"), r});
      }
  return all;
}

/// The value of a line of the recorded numbers; empty: there is none.
std::string recorded(const std::string& name) {
  const std::string_view text = embedded("tests/recorded.txt");
  const std::string key = name + " ";
  // A line begins with its name: one name may be the end of another.
  std::size_t at = text.starts_with(key) ? 0 : text.find("\n" + key);
  if (at == text.npos) return "";
  at += text.starts_with(key) ? key.size() : key.size() + 1;
  return std::string(text.substr(at, std::min(text.find('\n', at), text.size()) - at));
}

GoldenHash held(const std::string& name, const std::string& hash) {
  return {"golden/" + name, hash, recorded("golden/" + name)};
}

/// Of a covariance, through logarithms, a product of matrices and a factorisation: no test of rock has these.
/// Eigen takes as many unknowns in several blocks, whose sizes must be the same everywhere.
std::string hash_of_covariance() {
  constexpr std::uint32_t n = 150, rows = n + 5;
  Eigen::MatrixXd A(rows, n);
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < rows; ++i) A(i, j) = std::log(uniform(1, Stream::test, i, j));
  const Eigen::MatrixXd covariance = inverse_of_squares(A);
  Hash hash;
  hash.bytes(covariance.data(), static_cast<std::size_t>(covariance.size()) * sizeof(double));
  return hash.text();
}

/// Of quantiles and chances, which Boost sums by what it knows of the system.
std::string hash_of_quantiles() {
  Hash hash;
  for (std::size_t degrees = 1; degrees < 300; ++degrees) {
    const double between = 1.0 + 0.37 * static_cast<double>(degrees);
    const double values[] = {student_t_95(degrees), chi_square_99(degrees), student_t_one_sided_95(between),
                             student_t_chance(0.01 * between, between)};
    hash.bytes(values, sizeof values);
  }
  return hash.text();
}

}  // namespace

const std::vector<GoldenTest>& golden_tests() {
  static const std::vector<GoldenTest> all = make_tests();
  return all;
}

std::vector<GoldenHash> golden_hashes(const study::MachineOptions& machine, const std::atomic<bool>* stop) {
  const std::vector<GoldenTest>& tests = golden_tests();
  const Recipe& any = tests.front().recipe;
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(any.specimen, any.packing, any.matrix));
  std::vector<GoldenHash> hashes(tests.size() + 3);
  // The packing comes first: where it differs, those of all tests do.
  hashes.front() = held("packing", packing->hash);
  hashes.end()[-2] = held("covariance", hash_of_covariance());
  hashes.back() = held("quantiles", hash_of_quantiles());
  study::MachineOptions alone = machine;
  // Tests run side by side already, each on a thread of its own.
  alone.threads = 1;
  study::Hooks hooks;
  hooks.stop = stop;
  for_all(tests.size(), machine.threads, [&] {
    return [&](std::size_t i) {
      const Recipe& r = tests[i].recipe;
      const TestResult result = study::run_tests({study::specimen_of(packing, r)}, r, alone, hooks).front();
      hashes[i + 1] = held(tests[i].name, result.hash);
    };
  });
  // Hashes of tests that were cut short would look like another program.
  if (stop != nullptr && stop->load()) hashes.clear();
  return hashes;
}

}  // namespace phy::verification
