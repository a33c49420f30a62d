#include "study/table.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/analyse.hpp"
#include "records/quality.hpp"

namespace phy::study {
namespace {

/// Names with units of all numbers, in the order of their first appearance.
std::vector<std::pair<std::string, std::string>> numbers_in(
    const std::vector<std::optional<StoredResult>>& rows) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const auto& row : rows)
    if (row)
      for (const Number& n : row->result.numbers)
        // Name and unit together: tests of different kinds may use a name with another unit.
        if (std::find(names.begin(), names.end(), std::pair{n.name, n.unit}) == names.end())
          names.emplace_back(n.name, n.unit);
  return names;
}

/// Grade and names of the measures beyond their limits.
std::string quality_cells(const TestResult& result) {
  const std::vector<QualityMark> marks = quality_marks(result.numbers);
  std::string names;
  for (const QualityMark& m : marks) names += (names.empty() ? "" : " ") + std::string(m.limit->number);
  return std::string(phy::to_string(grade_of(result))) + "," + names;
}

}  // namespace

std::string csv_cell(double v) { return std::isfinite(v) ? print_number(v) : ""; }

std::string csv_head(const RecipeKey& key) {
  return key.path() + (key.field->dimension == Dimension::none ? "" : " [" + key.unit() + "]");
}

std::string csv_cell(const RecipeKey& key, double value) {
  return key.field->kind == FieldKind::choice ? key.print(value) : print_number(value);
}

std::string study_csv(const Plan& plan, const std::vector<std::optional<StoredResult>>& rows) {
  const auto numbers = numbers_in(rows);
  std::string text = "point,packing,bond_seed,theta [deg]";
  for (const ByAngle& b : plan.study.by_angle) text.append(",").append(csv_head(b.key));
  text += ",intact";
  for (const Factor& f : plan.study.vary) text.append(",").append(csv_head(f.key));
  for (const auto& [name, unit] : numbers)
    text.append(",").append(name).append(" [").append(unit).append("]");
  text += ",n_cracks,n_steps,cpu [s],status,reason,quality,marks,result_hash,key\n";
  for (const Run& run : plan.runs) {
    const PlannedTest& test = plan.tests[run.test];
    const bool intact = !layered(test.recipe);
    text += std::to_string(run.point) + "," + std::to_string(run.packing) + "," +
            std::to_string(run.bond_seed) + "," + (intact ? "" : print_number(inclination(test.recipe)));
    for (const ByAngle& b : plan.study.by_angle) text += "," + csv_cell(b.key, b.key.get(test.recipe));
    text += intact ? ",1" : ",0";
    for (std::size_t k = 0; k < plan.study.vary.size(); ++k)
      text += "," + csv_cell(plan.study.vary[k].key, plan.points[run.point].values[k]);
    // A row for every run of the design, also where several runs share one test.
    const std::optional<StoredResult>& row = rows[run.test];
    for (const auto& [name, unit] : numbers) {
      const Number* n = row ? analysis::find(row->result.numbers, name) : nullptr;
      text += "," + (n != nullptr ? csv_cell(n->value) : "");
    }
    if (row)
      text += "," + std::to_string(row->n_cracks) + "," + std::to_string(row->result.n_steps) + "," +
              print_number(row->result.seconds) + "," + phy::to_string(row->result.outcome.status) + "," +
              phy::csv_cell(row->result.outcome.reason) + "," + quality_cells(row->result) + "," +
              row->result.hash + ",";
    // Empty cells keep the table rectangular while the study is running.
    else
      text += ",,,,not run,,,,,";
    text += test.key + "\n";
  }
  return text;
}

std::vector<std::optional<StoredResult>> rows_of(const Plan& plan, const Store& store) {
  std::vector<std::string> keys;
  for (const PlannedTest& t : plan.tests) keys.push_back(t.key);
  return store.rows(keys);
}

}  // namespace phy::study
