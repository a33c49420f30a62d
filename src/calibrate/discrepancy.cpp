#include "calibrate/discrepancy.hpp"

#include <algorithm>
#include <utility>

namespace phy::calibrate {
namespace {

// What models with planes or directions miss of measured rocks beyond scatter: a few per cent to a fifth.
constexpr double usual_size = 0.1;

/// Strengths in compression, whatever the stress on the sides, have one discrepancy.
Property kind_of(Property property) { return is_compressive(property) ? Property::ucs : property; }

}  // namespace

Discrepancy::Discrepancy(std::vector<StrengthResidual> residuals, std::size_t left_out)
    : residuals_(std::move(residuals)) {
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const Target& target = residuals_[i].target;
    // The group is made even if its only member is left out: it then knows its prior alone, which is the
    // answer.
    Group& group = groups_[kind_of(target.property)];
    if (i != left_out) group.members.push_back(i), group.strength += target.mean;
  }
  for (auto& [kind, group] : groups_) {
    // That group without members would divide zero by zero.
    group.strength /= static_cast<double>(std::max<std::size_t>(1, group.members.size()));
    std::vector<AngleCell> cells;
    for (const std::size_t i : group.members)
      cells.push_back(
          {place_of(residuals_[i].target), residuals_[i].value, residuals_[i].noise, residuals_[i].unknown});
    group.process.emplace(cells, usual_size);
  }
}

const Discrepancy::Group& Discrepancy::group_of(Property property) const {
  return groups_.at(kind_of(property));
}

bool Discrepancy::knows(Property property) const { return groups_.count(kind_of(property)) > 0; }

AnglePlace Discrepancy::place_of(const Target& test) const {
  return {test.theta, test.confining > 0.0 ? test.confining / group_of(test.property).strength : 0.0};
}

Discrepancy::Term Discrepancy::term_of(const Group& group, const AngleProcess::Prediction& prediction) const {
  Term term{std::vector<double>(residuals_.size(), 0.0), prediction.mean, prediction.variance};
  for (std::size_t j = 0; j < group.members.size(); ++j)
    term.weights[group.members[j]] = prediction.weights[static_cast<Eigen::Index>(j)];
  return term;
}

Discrepancy::Term Discrepancy::of(std::size_t residual) const {
  const StrengthResidual& own = residuals_[residual];
  const Group& group = group_of(own.target.property);
  const auto member = std::find(group.members.begin(), group.members.end(), residual);
  if (member != group.members.end())
    return term_of(group, group.process->of_cell(static_cast<std::size_t>(member - group.members.begin())));
  Term term = at(own.target);
  // At a stranger the stand-in's own error comes on top; of a member the process has counted it.
  term.variance += own.unknown;
  return term;
}

Discrepancy::Term Discrepancy::at(const Target& test) const {
  const Group& group = group_of(test.property);
  return term_of(group, group.process->at(place_of(test)));
}

double Discrepancy::of_draw(const Term& term, std::size_t draw) const {
  double sum = 0.0;
  // The same weights for all draws: the process is fitted once, at the estimate, and linear in the residuals.
  for (std::size_t j = 0; j < residuals_.size(); ++j) sum += term.weights[j] * residuals_[j].of_draws[draw];
  return sum;
}

}  // namespace phy::calibrate
