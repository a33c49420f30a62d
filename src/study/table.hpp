// The results of a study as one tidy table: a row per specimen of the design, units in the header.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/quote.hpp"
#include "study/plan.hpp"
#include "study/store.hpp"

namespace phy::study {

/// CSV with the point, the seeds, the specimen (with the keys by angle), every varied key, the outcome and
/// every number that any specimen has ("ucs [Pa]"). Empty cells: not finished, or not determined. `rows`
/// belong to plan.tests.
std::string study_csv(const Plan& plan, const std::vector<std::optional<StoredResult>>& rows);

/// Cells of such tables, as csv_cell() of a text; NaN is an empty cell.
std::string csv_cell(double value);
std::string csv_cell(const RecipeKey& key, double value);
std::string csv_head(const RecipeKey& key);  ///< "bedding.k_n [Pa/m]"

/// The rows of all tests of the plan.
std::vector<std::optional<StoredResult>> rows_of(const Plan& plan, const Store& store);

}  // namespace phy::study
