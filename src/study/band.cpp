#include "study/band.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quote.hpp"
#include "base/units.hpp"
#include "records/test_description.hpp"
#include "study/table.hpp"

namespace phy::study {
namespace {

bool same_stress(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// A band with the values that will make it.
struct Gathered {
  Band band;
  std::vector<double> values;
  std::vector<double> missed;  ///< of the same draws; NaN: not known
  double missed_sd = nan;
};

/// Of a mixture of normal distributions about `means` that share a standard deviation.
double quantile(const std::vector<double>& means, double sd, double p) {
  constexpr double widest = 8.0, narrowest = 1e-9;
  constexpr int halvings = 100;
  // Without a spread the mixture is made of steps: a thin one keeps the halving defined.
  const double width = std::max(sd, narrowest);
  const auto [least, most] = std::minmax_element(means.begin(), means.end());
  // Eight standard deviations leave 1e-15 outside; a hundred halvings end at the last digit.
  double low = *least - widest * width, high = *most + widest * width;
  for (int i = 0; i < halvings; ++i) {
    const double x = 0.5 * (low + high);
    double below = 0.0;
    for (const double mean : means) below += 0.5 * std::erfc((mean - x) / (std::sqrt(2.0) * width));
    (below < p * static_cast<double>(means.size()) ? low : high) = x;
  }
  return 0.5 * (low + high);
}

/// What the rock has: nothing where a draw does not know it.
void add_rock(Gathered& g) {
  const auto n = static_cast<double>(g.values.size());
  std::vector<double> logs;
  double sum = 0.0;
  for (std::size_t k = 0; k < g.values.size(); ++k) {
    if (!std::isfinite(g.missed[k]) || g.values[k] <= 0.0) return;
    logs.push_back(std::log(g.values[k]) + g.missed[k]), sum += g.missed[k];
  }
  if (logs.empty()) return;
  const auto at = [&](double p) { return std::exp(quantile(logs, g.missed_sd, p)); };
  g.band.factor = std::exp(sum / n), g.band.factor_sd = g.missed_sd;
  // As much outside on either side as beyond the smallest and the largest of n draws: the two bands compare.
  g.band.rock_low = at(1.0 / (n + 1.0)), g.band.rock = at(0.5), g.band.rock_high = at(n / (n + 1.0));
}

Gathered& gathered_at(std::vector<Gathered>& all, const Prediction& p) {
  const auto it = std::find_if(all.begin(), all.end(), [&](const Gathered& g) {
    return g.band.number == p.number && g.band.place.specimen == p.place.specimen &&
           same_stress(g.band.place.sigma_3, p.place.sigma_3);
  });
  return it != all.end() ? *it : all.emplace_back(Gathered{{p.place, p.number, p.unit}, {}, {}});
}

Band finished(Gathered g, std::size_t n_draws) {
  add_rock(g);  // before draws lose their order
  std::vector<double>& v = g.values;
  std::sort(v.begin(), v.end());
  g.band.n = v.size(), g.band.n_without = n_draws - v.size();
  if (!v.empty())
    g.band.low = v.front(), g.band.high = v.back(),
    g.band.median = 0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]);
  return std::move(g.band);
}

}  // namespace

std::vector<Band> bands_of(const std::vector<Predictions>& draws) {
  std::vector<Gathered> all;
  for (const Predictions& draw : draws)
    for (const Prediction& p : draw) {
      Gathered& g = gathered_at(all, p);
      // A draw without the number may have come first, and does not know its unit.
      if (g.band.unit.empty()) g.band.unit = p.unit;
      if (!std::isfinite(p.value)) continue;
      g.values.push_back(p.value), g.missed.push_back(p.missed), g.missed_sd = p.missed_sd;
    }
  std::vector<Band> bands;
  for (Gathered& g : all) bands.push_back(finished(std::move(g), draws.size()));
  return bands;
}

double band_probability(std::size_t n) {
  return n == 0 ? 0.0 : static_cast<double>(n - 1) / static_cast<double>(n + 1);
}

Predictions predictions_of(const TestResult& result, double sigma_3) {
  const Place place{result.name, result.intact, result.theta, sigma_3};
  if (!has_strength(result.outcome.status)) return {{place, result.kind->curve.quantity().number, ""}};
  Predictions all;
  for (const Number& n : result.numbers) all.push_back({place, n.name, n.unit, n.value});
  return all;
}

Predictions predictions_of(const Envelope& envelope) {
  Predictions all;
  for (const SpecimenEnvelope& s : envelope.specimens) {
    const Place place{s.name, s.intact, s.theta};
    const theory::MohrCoulombFit& mc = s.mohr_coulomb;
    const theory::HoekBrownFit& hb = s.hoek_brown;
    all.push_back({place, "cohesion", "Pa", mc.ok ? mc.cohesion.value : nan});
    all.push_back({place, "friction", "deg", mc.ok ? mc.friction.value : nan});
    all.push_back({place, "ucs_hb", "Pa", hb.ok ? hb.ucs.value : nan});
    all.push_back({place, "m_i", "1", hb.ok ? hb.m_i.value : nan});
  }
  return all;
}

std::string bands_csv(const std::vector<Band>& bands) {
  std::string text =
      "specimen,theta [deg],sigma_3 [Pa],number,unit,draws,without,median,low,high,width,"
      "factor,factor_sd,rock,rock_low,rock_high\n";
  for (const Band& b : bands)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", phy::csv_cell(b.place.specimen),
                        b.place.intact ? "" : print_number(b.place.theta), csv_cell(b.place.sigma_3),
                        phy::csv_cell(b.number), phy::csv_cell(b.unit), b.n, b.n_without, csv_cell(b.median),
                        csv_cell(b.low), csv_cell(b.high), csv_cell(b.width()), csv_cell(b.factor),
                        csv_cell(b.factor_sd), csv_cell(b.rock), csv_cell(b.rock_low), csv_cell(b.rock_high));
  return text;
}

}  // namespace phy::study
