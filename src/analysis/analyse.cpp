#include "analysis/analyse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/stats.hpp"

namespace phy {
namespace {

using Rows = std::vector<HistoryRow>;
using Strain = double HistoryRow::*;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t enough_rows = 3;

/// The loading branch: rows up to the peak.
struct Loading {
  const Rows& rows;
  std::size_t n_rows = 0;  ///< including the peak
  double ucs = nan;
  double peak_strain = nan;

  explicit Loading(const Rows& all) : rows(all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (n_rows > 0 && !(all[i].axial_stress > ucs)) continue;
      ucs = all[i].axial_stress, peak_strain = all[i].axial_strain, n_rows = i + 1;
    }
    if (!(ucs > 0.0)) n_rows = 0, ucs = nan, peak_strain = nan;
  }
  /// Rows from the first passage of `lo` to the first passage of `hi` (fractions of ucs).
  std::pair<std::size_t, std::size_t> range(double lo, double hi) const {
    std::size_t first = 0;
    while (first < n_rows && rows[first].axial_stress < lo * ucs) ++first;
    std::size_t last = first;
    while (last < n_rows && rows[last].axial_stress <= hi * ucs) ++last;
    return {first, last};
  }
};

Number fitted(const Loading& test, std::string name, std::string unit, std::string definition, Strain x,
              double HistoryRow::*y, double sign, double lo, double hi) {
  Number n{std::move(name), nan, std::move(unit), std::move(definition), ""};
  const auto [first, last] = test.range(lo, hi);
  if (last - first < enough_rows) {
    n.note = "fewer than 3 history rows in the interval; lower test.history_interval";
    return n;
  }
  std::vector<double> xs, ys;
  for (std::size_t i = first; i < last; ++i)
    xs.push_back(test.rows[i].*x), ys.push_back(sign * (test.rows[i].*y));
  const LineFit fit = fit_line(xs, ys);
  n.value = fit.slope;
  if (!std::isfinite(n.value)) n.note = "the strain does not change in the interval";
  return n;
}

Number secant(const Loading& test, std::string name, std::string definition, Strain strain) {
  Number n{std::move(name), nan, "Pa", std::move(definition), ""};
  for (std::size_t i = 0; i < test.n_rows; ++i) {
    if (test.rows[i].axial_stress < 0.5 * test.ucs) continue;
    if (i == 0) break;
    const HistoryRow &a = test.rows[i - 1], &b = test.rows[i];
    const double w = (0.5 * test.ucs - a.axial_stress) / (b.axial_stress - a.axial_stress);
    n.value = 0.5 * test.ucs / (a.*strain + w * (b.*strain - a.*strain));
    return n;
  }
  n.note = "half of the peak is not passed within the history";
  return n;
}

/// Axial stress at an axial strain, between rows.
double stress_at(const Rows& rows, double strain) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].axial_strain < strain) continue;
    const double step = rows[i].axial_strain - rows[i - 1].axial_strain;
    const double w = step > 0.0 ? std::clamp((strain - rows[i - 1].axial_strain) / step, 0.0, 1.0) : 1.0;
    return rows[i - 1].axial_stress + w * (rows[i].axial_stress - rows[i - 1].axial_stress);
  }
  return rows.empty() ? nan : rows.back().axial_stress;
}

void crack_stresses(const Loading& test, const std::vector<CrackEvent>& cracks,
                    const AnalysisOptions& options, std::vector<Number>& out) {
  Number first{"sigma_first_crack", nan, "Pa", "axial stress at the first crack", ""};
  Number ci{"sigma_ci", nan, "Pa",
            "axial stress when the number of cracks reaches max(3, 1 % of the cracks at the peak)", ""};
  std::vector<double> strains;
  for (const CrackEvent& c : cracks)
    if (c.strain <= test.peak_strain) strains.push_back(c.strain);
  const std::size_t wanted = std::max<std::size_t>(3, (strains.size() + 99) / 100);
  const auto place = [&](Number& n, std::size_t count) {
    if (strains.size() < count) {
      n.note = "fewer than " + std::to_string(count) + " cracks before the peak";
      return;
    }
    n.value = stress_at(test.rows, strains[count - 1]);
    if (options.jump_strain > 0.0 && strains[count - 1] <= test.rows.front().axial_strain)
      n.note = "below this value: cracks could not show before the jump start ended";
  };
  if (test.n_rows == 0)
    first.note = ci.note = "no peak";
  else
    place(first, 1), place(ci, wanted);
  out.push_back(ci);
  out.push_back(first);
}

Number crack_damage(const Loading& test) {
  Number n{"sigma_cd", nan, "Pa",
           "axial stress where the volumetric strain (gauge) is largest, before the peak", ""};
  std::size_t best = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < test.n_rows; ++i) {
    const double volume = test.rows[i].axial_strain_gauge + test.rows[i].lateral_strain_gauge;
    if (volume > largest) largest = volume, best = i;
  }
  if (test.n_rows < 2 || best + 1 >= test.n_rows || largest <= 0.0)
    n.note = "the volumetric strain does not turn before the peak";
  else
    n.value = test.rows[best].axial_stress;
  return n;
}

void crack_counts(const Loading& test, const std::vector<CrackEvent>& cracks, std::vector<Number>& out) {
  for (const bool at_peak : {false, true}) {
    for (const CrackMode mode : {CrackMode::tension, CrackMode::shear}) {
      for (const CrackPlace place : {CrackPlace::matrix, CrackPlace::bedding}) {
        const auto count = std::count_if(cracks.begin(), cracks.end(), [&](const CrackEvent& c) {
          return c.mode == mode && c.place == place && (!at_peak || c.strain <= test.peak_strain);
        });
        const std::string what = std::string(mode == CrackMode::tension ? "tension" : "shear") + "_" +
                                 (place == CrackPlace::matrix ? "matrix" : "bedding");
        out.push_back(
            {"cracks_" + what + (at_peak ? "_at_peak" : ""), static_cast<double>(count), "1",
             std::string("bonds broken in ") + what + (at_peak ? " up to the peak" : " in the whole test"),
             ""});
      }
    }
  }
}

void checks(const Loading& test, std::vector<Number>& out) {
  double work = 0.0, error = 0.0, platens = 0.0;
  std::vector<double> differences;
  for (const HistoryRow& r : test.rows) work = std::max(work, r.boundary_work);
  for (const HistoryRow& r : test.rows) error = std::max(error, std::fabs(r.energy_error * r.boundary_work));
  for (std::size_t i = 0; i < test.n_rows; ++i)
    differences.push_back(std::fabs(test.rows[i].stress_top - test.rows[i].stress_bottom) / test.ucs);
  std::sort(differences.begin(), differences.end());
  if (!differences.empty()) platens = differences.back();
  const double usual = differences.empty() ? nan : differences[differences.size() * 95 / 100];
  out.push_back({"energy_error", work > 0.0 ? error / work : nan, "1",
                 "largest energy not accounted for / total boundary work",
                 work > 0.0 ? "" : "no work was done"});
  out.push_back({"platen_difference", differences.empty() ? nan : platens, "1",
                 "largest |top - bottom platen stress| / ucs before the peak",
                 differences.empty() ? "no peak" : ""});
  out.push_back({"platen_difference_95", usual, "1",
                 "|top - bottom platen stress| / ucs not exceeded by 95 % of the rows before the peak",
                 differences.empty() ? "no peak" : ""});
}

}  // namespace

const Number* find(const std::vector<Number>& numbers, const std::string& name) {
  for (const Number& n : numbers)
    if (n.name == name) return &n;
  return nullptr;
}

std::vector<Number> analyse(const History& history, const std::vector<CrackEvent>& cracks,
                            const AnalysisOptions& options) {
  const Loading test(history.rows);
  const std::string no_peak = test.n_rows == 0 ? "the stress never rose above zero" : "";
  const auto gauge = &HistoryRow::axial_strain_gauge;
  const auto platen = &HistoryRow::axial_strain;
  const auto stress = &HistoryRow::axial_stress;
  const auto lateral = &HistoryRow::lateral_strain_gauge;
  std::vector<Number> out;
  out.push_back(
      {"ucs", test.ucs, "Pa", "largest axial stress (mean of both platens over the initial width)", no_peak});
  out.push_back({"peak_strain", test.peak_strain, "1", "axial platen strain at the largest stress", no_peak});
  out.push_back(fitted(test, "E_tangent", "Pa",
                       "slope of stress over gauge strain, 40-60 % of ucs, least squares", gauge, stress, 1.0,
                       0.4, 0.6));
  out.push_back(secant(test, "E_secant", "stress over gauge strain at 50 % of ucs", gauge));
  out.push_back(fitted(test, "nu", "1",
                       "-slope of lateral over axial gauge strain, 40-60 % of ucs, least squares", gauge,
                       lateral, -1.0, 0.4, 0.6));
  out.push_back(fitted(test, "E_small", "Pa",
                       "slope of stress over gauge strain, 5-15 % of ucs, least squares", gauge, stress, 1.0,
                       0.05, 0.15));
  out.push_back(fitted(test, "E_tangent_platen", "Pa", "slope of stress over platen strain, 40-60 % of ucs",
                       platen, stress, 1.0, 0.4, 0.6));
  out.push_back(secant(test, "E_secant_platen", "stress over platen strain at 50 % of ucs", platen));
  crack_stresses(test, cracks, options, out);
  out.push_back(crack_damage(test));
  crack_counts(test, cracks, out);
  checks(test, out);
  return out;
}

}  // namespace phy
