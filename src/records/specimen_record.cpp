#include "records/specimen_record.hpp"

#include "base/units.hpp"

namespace phy {

SpecimenRecord record_of(const Recipe& recipe, const std::string& version, const Specimen& specimen,
                         const TestResult& result) {
  SpecimenRecord record;
  record.program = "phyllite " + version;
  record.recipe = recipe;
  const Packing& p = *specimen.packing;
  record.packing_hash = p.hash;
  record.n_grains = static_cast<std::int64_t>(p.discs.size());
  record.stress_free = p.stress_free;
  record.packing = p.report;
  for (std::size_t i = 0; i < specimen.bedding.size(); ++i)
    record.bedding.push_back({specimen.bedding[i].theta, specimen.bedding_report.at(i)});
  record.result = result;
  // They are in the scene, in a form that takes a fraction of the room.
  record.result.snapshots.clear();
  record.result.frames.clear();
  record.scene = scene_of(p, result);
  return record;
}

std::string specimen_name(double theta) { return "theta = " + print_number(theta) + " deg"; }

std::vector<std::string> specimen_names(const Recipe& recipe) {
  std::vector<std::string> names;
  for (const double theta : recipe.test.angles) names.push_back(specimen_name(theta));
  // Without a list of angles the layers lie as the recipe has them, and that is one specimen.
  if (names.empty() && layered(recipe)) names.push_back(specimen_name(inclination(recipe)));
  if (recipe.test.intact || !layered(recipe)) names.emplace_back("intact");
  return names;
}

}  // namespace phy
