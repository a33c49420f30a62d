#include "calibrate/discrepancy.hpp"

#include <algorithm>

namespace phy::calibrate {
namespace {

// What models with planes or directions miss of measured rocks beyond scatter: a few per cent to a fifth.
constexpr double usual_size = 0.1;

/// Strengths in compression, whatever the stress on the sides, have one discrepancy.
Property kind_of(Property property) { return is_compressive(property) ? Property::ucs : property; }

}  // namespace

Discrepancy::Discrepancy(const std::vector<Target>& targets, const std::vector<Residual>& residuals,
                         std::size_t left_out)
    : targets_(targets) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    unknown_.push_back(residuals[i].unknown);
    Group& group = groups_[kind_of(targets[i].property)];
    if (i != left_out) group.members.push_back(i), group.strength += targets[i].mean;
  }
  for (auto& [kind, group] : groups_) {
    group.strength /= static_cast<double>(std::max<std::size_t>(1, group.members.size()));
    std::vector<AngleCell> cells;
    for (const std::size_t i : group.members)
      cells.push_back({place_of(targets[i], targets[i].theta), residuals[i].value, residuals[i].noise,
                       residuals[i].unknown});
    group.process.emplace(cells, usual_size);
  }
}

const Discrepancy::Group& Discrepancy::group_of(Property property) const {
  return groups_.at(kind_of(property));
}

AnglePlace Discrepancy::place_of(const Target& test, double theta) const {
  return {theta, test.confining > 0.0 ? test.confining / group_of(test.property).strength : 0.0};
}

double Discrepancy::Term::mean(const std::vector<Residual>& residuals) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < weights.size(); ++j) sum += weights[j] * residuals[j].value;
  return sum;
}

Discrepancy::Term Discrepancy::of(std::size_t target) const {
  const Group& group = group_of(targets_[target].property);
  const auto member = std::find(group.members.begin(), group.members.end(), target);
  const bool seen = member != group.members.end();
  const AngleProcess::Prediction p =
      seen ? group.process->of_cell(static_cast<std::size_t>(member - group.members.begin()))
           : group.process->at(place_of(targets_[target], targets_[target].theta));
  Term term{std::vector<double>(targets_.size(), 0.0), p.variance + (seen ? 0.0 : unknown_[target])};
  for (std::size_t j = 0; j < group.members.size(); ++j)
    term.weights[group.members[j]] = p.weights[static_cast<Eigen::Index>(j)];
  return term;
}

Discrepancy::Value Discrepancy::at(const Target& test, double theta) const {
  const AngleProcess::Prediction p = group_of(test.property).process->at(place_of(test, theta));
  return {p.mean, p.variance};
}

}  // namespace phy::calibrate
