#include "records/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/nan.hpp"

namespace phy {

const Comparison* row_of(const std::vector<Comparison>& rows, const Target& t) {
  for (const Comparison& c : rows)
    if (same_cell(c.target, t)) return &c;
  return nullptr;
}

std::string particulars(const Target& t) {
  return (t.diameter > 0.0 ? fmt::format(", {:g} mm", t.diameter * 1e3) : "") +
         (t.confining > 0.0 ? fmt::format(", {:.3g} MPa", t.confining * 1e-6) : "");
}

std::string test_name(const Target& t) { return to_string(t.property) + particulars(t); }

std::string cell_name(const Target& t) {
  // In direct shear the bedding lies level in the box: its cells differ by the normal stress alone.
  if (measured(t.property).along_bedding)
    return fmt::format("{}({:.3g} MPa)", to_string(t.property), t.confining * 1e-6);
  return fmt::format("{}({:g}{})", to_string(t.property), t.theta, particulars(t));
}

double interpolated(const std::vector<Comparison>& rows, const Target& t) {
  const Target *below = nullptr, *above = nullptr;
  for (const Comparison& c : rows) {
    const Target& other = c.target;
    if (!same_test(other, t)) continue;
    if (other.theta < t.theta && (below == nullptr || other.theta > below->theta)) below = &other;
    if (other.theta > t.theta && (above == nullptr || other.theta < above->theta)) above = &other;
  }
  // Beyond the tested angles a straight line would be a guess: a yardstick has none there.
  if (below == nullptr || above == nullptr) return nan;
  const double part = (t.theta - below->theta) / (above->theta - below->theta);
  return below->mean + part * (above->mean - below->mean);
}

bool has_tests_of(const Calibration& c, Part part) {
  const auto is_it = [part](const Comparison& row) { return measured(row.target.property).part == part; };
  return std::any_of(c.fitted.begin(), c.fitted.end(), is_it) ||
         std::any_of(c.compared.begin(), c.compared.end(), is_it);
}

const char* to_string(VerdictStatus status) {
  switch (status) {
    case VerdictStatus::calibrated: return "calibrated";
    case VerdictStatus::calibrated_except: return "calibrated except";
    case VerdictStatus::not_calibrated: return "not calibrated";
    case VerdictStatus::not_decided: return "not decided";
    case VerdictStatus::out_of_reach: return "out of reach";
    case VerdictStatus::interrupted: break;
  }
  return "interrupted";
}

}  // namespace phy
