#include "calibrate/twin.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/rng.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/strength_tests.hpp"

namespace phy::calibrate {

std::vector<Comparison> twin_response(const Recipe& truth, const std::vector<double>& angles,
                                      const std::vector<std::int64_t>& seeds, Simulator& simulator,
                                      ModulusReading E_is) {
  const bool at_small_strain = E_is == ModulusReading::small_strain;
  std::vector<Target> moduli, strengths;
  for (const Property p : {Property::E, Property::nu})
    for (const double theta : angles) moduli.push_back({p, theta, 1.0, 1.0, 1, true});
  // the press runs at a speed that suits the strength: a first guess, then the strength found
  for (const double theta : angles)
    strengths.push_back({Property::ucs, theta, 2.0 * truth.matrix.sigma_c, 1.0, 1, true});
  const auto pressed = [&](const std::vector<std::int64_t>& some, std::vector<Comparison>* read) {
    Recipe settings = test_settings(truth, strengths, seeds.front(), simulator);
    // a rock's grains have their own masses, and its table the bits of before
    settings.engine.grain_inertia = truth.engine.grain_inertia;
    settings.engine.step_safety = truth.engine.step_safety;
    TestSeries series(settings, strengths, some.front(), from_rest, simulator);
    series.take(some);
    if (read != nullptr) *read = series.moduli(E_is);
    return series.strengths();
  };
  const std::vector<Comparison> first = pressed({seeds.front()}, nullptr);
  for (std::size_t i = 0; i < strengths.size(); ++i)
    // One specimen is enough for a speed; without a peak the guess stays.
    if (std::isfinite(first[i].mean)) strengths[i].mean = first[i].mean;
  std::vector<Comparison> read;  // E and nu of each angle in turn
  const std::vector<Comparison> ucs = pressed(seeds, at_small_strain ? nullptr : &read);
  std::vector<Comparison> rows;
  if (at_small_strain) rows = elastic_response(truth, moduli, seeds, simulator);
  for (const Target& t : at_small_strain ? std::vector<Target>() : moduli) rows.push_back(*row_of(read, t));
  rows.insert(rows.end(), ucs.begin(), ucs.end());
  return rows;
}

std::vector<RockReading> twin_readings(const std::vector<Comparison>& response, const TwinOptions& options) {
  std::vector<RockReading> readings;
  for (std::size_t k = 0; k < response.size(); ++k)
    for (int i = 0; i < options.n_specimens; ++i) {
      const double factor =
          1.0 + options.noise * normal(options.noise_seed, Stream::calibration, static_cast<std::uint32_t>(k),
                                       static_cast<std::uint32_t>(i));
      RockReading r;
      r.property = response[k].target.property, r.theta = response[k].target.theta,
      r.value = response[k].mean * factor;
      r.line = i;
      readings.push_back(r);
    }
  return readings;
}

std::string readings_csv(const std::vector<RockReading>& readings, bool bedded) {
  std::map<std::pair<double, int>, std::map<Property, double>> rows;
  for (const RockReading& r : readings) rows[{r.theta, r.line}][r.property] = r.value;
  std::string text = std::string(bedded ? "theta [deg]," : "") + "E [GPa],nu,UCS [MPa]\n";
  for (const auto& [at, cells] : rows) {
    const auto cell = [&of = cells](Property p, double unit) {
      const auto it = of.find(p);
      return it == of.end() ? std::string() : fmt::format("{:.4g}", it->second / unit);
    };
    if (bedded) text += fmt::format("{:g},", at.first);
    text +=
        fmt::format("{},{},{}\n", cell(Property::E, 1e9), cell(Property::nu, 1.0), cell(Property::ucs, 1e6));
  }
  return text;
}

}  // namespace phy::calibrate
