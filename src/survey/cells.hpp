// Cells of a table as findings name them: without an angle where the rock has no bedding.
#pragma once
#include <utility>
#include <vector>

#include "base/nan.hpp"
#include "records/finding.hpp"

namespace phy::survey {

inline Cell cell_in(const Rock& rock, Cell cell) {
  if (!rock.bedded) cell.theta = nan;
  return cell;
}
/// The same of findings of rooms that do not know the rock.
inline std::vector<Finding> cells_in(const Rock& rock, std::vector<Finding> findings) {
  for (Finding& f : findings)
    for (Cell& cell : f.cells) cell = cell_in(rock, cell);
  return findings;
}
inline Cell cell_in(const Rock& rock, const Target& t) { return cell_in(rock, cell_of(t)); }
inline Cell cell_in(const Rock& rock, const RockReading& r) {
  return cell_in(rock, Cell{r.property, r.theta, r.confining, r.diameter});
}

}  // namespace phy::survey
