#include "verdict/view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "verdict/cells.hpp"

namespace phy::verdict {

namespace {

std::size_t place_of(Part part) { return static_cast<std::size_t>(part); }

}  // namespace

double error_of_laboratory(const Comparison& c) { return c.target.standard_error() / c.target.mean; }
double error_of_model(const Comparison& c) {
  return std::isfinite(c.sd) && c.n_packings > 0 ? c.sd / std::sqrt(c.n_packings) / c.mean : 0.0;
}

double EndRatio::error() const { return std::hypot(error_of_laboratory, error_of_model); }
double EndRatio::difference() const { return std::fabs(std::log(laboratory / model)); }

View::View(const Calibration& c) : of(c) {
  std::vector<Comparison> rows;
  for (const Comparison& fit : c.fitted) {
    const Comparison* unseen = row_of(c.verification, fit.target);
    rows.push_back(unseen != nullptr && unseen->answered() ? *unseen : fit);
  }
  cells = judge_cells(rows);
  for (const JudgedCell& cell : cells)
    if (cell.row.answered())
      misfit[place_of(measured(cell.row.target.property).part)] += std::pow(cell.scaled_miss(), 2.0);
}

std::vector<Comparison> View::answered(Property p) const {
  std::vector<Comparison> some;
  for (const JudgedCell& c : cells)
    if (c.row.target.property == p && c.row.answered()) some.push_back(c.row);
  return some;
}

std::vector<Target> View::strengths() const {
  std::vector<Target> all;
  for (const JudgedCell& c : cells)
    if (is_strength(c.row.target.property)) all.push_back(c.row.target);
  return all;
}

bool View::misses_some(Property p) const {
  return std::any_of(cells.begin(), cells.end(), [&](const JudgedCell& c) {
    return c.row.target.property == p && c.row.answered() && std::fabs(c.scaled_miss()) > 1.0;
  });
}

bool View::meets_some(Property p) const {
  return std::any_of(cells.begin(), cells.end(), [&](const JudgedCell& c) {
    return c.row.target.property == p && c.outcome == Outcome::met;
  });
}

const Comparison* View::at(Property p, double theta) const {
  for (const JudgedCell& c : cells)
    if (c.row.target.property == p && c.row.target.theta == theta && c.row.answered()) return &c.row;
  return nullptr;
}

const Finding* View::in_maps(FindingKind kind, const Target& t) const {
  const auto it = std::find_if(of.reach.begin(), of.reach.end(), [&](const Finding& f) {
    return f.kind == kind && f.cells.front() == cell_of(t);
  });
  return it != of.reach.end() ? &*it : nullptr;
}

const JudgedCell* View::farthest(Part part) const {
  const JudgedCell* worst = nullptr;
  for (const JudgedCell& c : cells)
    if (measured(c.row.target.property).part == part && c.row.answered() &&
        (worst == nullptr || std::fabs(c.scaled_miss()) > std::fabs(worst->scaled_miss())))
      worst = &c;
  return worst;
}

bool View::moduli_alone() const {
  return std::none_of(cells.begin(), cells.end(),
                      [](const JudgedCell& c) { return is_strength(c.row.target.property); });
}

double View::share(Part part) const {
  const double all = std::accumulate(misfit.begin(), misfit.end(), 0.0);
  return all > 0.0 ? misfit[place_of(part)] / all : 0.0;
}

std::optional<EndRatio> View::end_ratio(Property p) const {
  const Comparison* across = at(p, 0.0);
  if (across == nullptr) return {};
  const auto cell = std::find_if(cells.begin(), cells.end(), [&](const JudgedCell& c) {
    return c.row.answered() && c.row.target.theta == 90.0 && same_test(c.row.target, across->target);
  });
  if (cell == cells.end()) return {};
  const Comparison& along = cell->row;
  const EndRatio ratio = {along.target.mean / across->target.mean, along.mean / across->mean,
                          std::hypot(error_of_laboratory(along), error_of_laboratory(*across)),
                          std::hypot(error_of_model(along), error_of_model(*across))};
  return ratio.laboratory > 0.0 && ratio.model > 0.0 ? std::optional(ratio) : std::nullopt;
}

}  // namespace phy::verdict
