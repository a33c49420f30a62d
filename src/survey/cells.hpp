// Cells of a table as findings name them: without an angle where the rock has no bedding.
#pragma once
#include "base/nan.hpp"
#include "records/finding.hpp"

namespace phy::survey {

inline Cell cell_in(const Rock& rock, Cell cell) {
  if (!rock.bedded) cell.theta = nan;
  return cell;
}
inline Cell cell_in(const Rock& rock, const Target& t) { return cell_in(rock, cell_of(t)); }
inline Cell cell_in(const Rock& rock, const RockReading& r) {
  return cell_in(rock, Cell{r.property, r.theta, r.confining, r.diameter});
}

}  // namespace phy::survey
