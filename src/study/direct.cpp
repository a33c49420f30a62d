#include "study/direct.hpp"

#include <algorithm>
#include <utility>

#include "base/hash.hpp"
#include "system/process.hpp"

namespace phy::study {
namespace {

void add_moduli(TestResult& result, const ElasticResult& r) {
  // Both idealisations are stored side by side; the suffix marks contacts that also pull.
  const std::string behind = r.bilateral ? "_pulling" : "";
  const std::string contacts = r.bilateral ? ", linear contacts also pull" : ", linear contacts only push";
  const auto add = [&](const char* name, double value, const char* unit, const char* definition) {
    result.numbers.push_back({name + behind, value, unit, definition + contacts, ""});
  };
  add("E_gauge", r.E_gauge, "Pa",
      "direct solution: platen stress over strain of the middle 60 % of the height");
  add("nu_gauge", r.nu_gauge, "1",
      "direct solution: -lateral / axial strain of the middle 60 % of the height");
  add("E_platen", r.E_platen, "Pa", "direct solution: platen stress over approach of the platens / height");
  add("undecided_contacts", static_cast<double>(r.n_alternating), "1",
      "contacts whose state, open or closed, the solution contradicts");
}

/// Of the packing, and of the first set of bedding.
void add_structure(TestResult& result, const Specimen& specimen) {
  const auto add = [&](const char* name, double value, const char* definition) {
    result.numbers.push_back({name, value, "1", definition, ""});
  };
  add("porosity", specimen.packing->report.porosity, "area not covered by grains");
  add("coordination", specimen.packing->report.coordination, "contacts per grain");
  if (specimen.bedding_report.empty()) return;
  const BeddingReport& bedding = specimen.bedding_report.front();
  if (bedding.dispersed)
    return add("joint_fraction", bedding.joint_fraction, "dispersed joints, of all contacts");
  add("overlap_ratio", bedding.overlap_ratio, "length of joint patches per length of plane, sum(A)/L");
  add("bridge_fraction", bedding.bridge_fraction, "contacts across a plane that are no joints");
  add("non_crossing_fraction", bedding.non_crossing_fraction, "joints that do not cross their plane");
}

/// Over the numbers, as there is no history to cover.
std::string hash_of_numbers(const TestResult& result) {
  Hash h;
  h.add(std::string(to_string(result.outcome.status)));
  for (const Number& n : result.numbers) h.add(n.name), h.add(n.value);
  return h.text();
}

}  // namespace

bool moduli_are_drawn(const Recipe& r) {
  const auto drawn = [](const BeddingRecipe& b) { return b.scatters() || (b.is_drawn() && !b.unjointed()); };
  return r.matrix.unbonded_fraction > 0.0 || r.matrix.gapped_fraction > 0.0 ||
         std::any_of(r.bedding.begin(), r.bedding.end(), drawn);
}

Recipe elastic_recipe(Recipe single) {
  // Back to defaults, so that recipes that differ only here get one fingerprint.
  single.test = {};
  single.engine = {};
  if (!moduli_are_drawn(single)) single.matrix.bond_seed = MatrixRecipe{}.bond_seed;
  return single;
}

TestResult solve_directly(const Specimen& specimen, statics::UniaxialStatics& statics) {
  const double start = system::thread_seconds();
  TestResult result;
  result.name = specimen.name;
  result.intact = !layered(specimen);
  result.theta = result.intact ? 0.0 : inclination(specimen);
  result.outcome = {Status::solved, "", ""};
  statics::ElasticOptions options;
  // Derivatives are for calibrations; a study reads the moduli only.
  options.sensitivities = false;
  for (const bool bilateral : {false, true}) {
    options.bilateral = bilateral;
    const ElasticResult r = statics.solve(specimen, options);
    add_moduli(result, r);
    result.n_contacts = r.n_contacts;
    // One of the two unsolved makes the test unsolved; the first reason is kept.
    if (!r.outcome.ok()) result.outcome.status = Status::unsolved, result.outcome.advice = r.outcome.advice;
    if (result.outcome.reason.empty()) result.outcome.reason = r.outcome.reason;
  }
  if (result.outcome.reason.empty()) result.outcome.reason = "direct elastic solution";
  add_structure(result, specimen);
  result.n_grains = static_cast<std::int64_t>(specimen.packing->discs.size());
  result.seconds = system::thread_seconds() - start;
  result.hash = hash_of_numbers(result);
  return result;
}

}  // namespace phy::study
