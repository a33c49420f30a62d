#include "survey/angle_question.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "base/exact_math.hpp"
#include "theory/jaeger.hpp"

namespace phy::survey {
namespace {

constexpr double tables_exchanged = 0.1;  // share of tables whose angles are the complements
constexpr double columns_apart = 0.05;    // share of columns that count otherwise than their table
constexpr double share_isotropic = 0.5;   // of what is expected of a property before its values are seen

/// Logarithm of a property over theta, but for its level.
using Curve = std::function<double(double)>;

/// The curves that layers give a property, and how far to trust them.
struct Sense {
  std::vector<Curve> curves;
  double off;         ///< by which rocks are off the nearest of these curves, relative
  double exceptions;  ///< share of rocks that break the rule
};

double squared(double x) { return x * x; }

/// 0, then from `least` in steps of a factor up to `most`.
std::vector<double> zero_and_steps(double least, double factor, double most) {
  std::vector<double> values = {0.0};
  for (double v = least; v <= most; v *= factor) values.push_back(v);
  return values;
}

/// 1/value grows by what planes yield across them, in proportion to `normal`, and by slip along them.
std::vector<Curve> softened_by_planes(const std::function<double(const SinCos&)>& normal, double most_slip) {
  std::vector<Curve> curves;
  for (const double across : zero_and_steps(0.05, 1.4, 5.0))
    for (const double slip : zero_and_steps(0.1, 1.6, most_slip))
      curves.emplace_back([=](double theta) {
        const SinCos a = sin_cos_degrees(theta);
        return -std::log(1.0 + across * normal(a) + slip * squared(a.sin * a.cos));
      });
  return curves;
}

/// Slip on a plane (Jaeger) below shoulders that lean to either side, with sharp and with round corners: the
/// lower of two strengths by the norm of their inverses.
std::vector<Curve> weak_planes() {
  std::vector<Curve> curves;
  for (const double friction : {10.0, 20.0, 30.0, 40.0}) {
    const theory::Coulomb plane{1.0, friction};
    const double least = theory::weak_plane_minimum(plane, 0.0).sigma_1;
    for (const double depth : zero_and_steps(0.1, 1.36, 0.9))
      for (const double corner : {2.0, 6.0})
        for (const double lean : {-0.1, -0.05, 0.0, 0.05, 0.1})
          curves.emplace_back([=](double theta) {
            const double slip = theory::weak_plane_sigma_1(plane, theta, 0.0) / least;
            const double yields = std::pow((1.0 - depth) * slip, -corner);
            return -std::log1p(yields) / corner + lean * sin_cos_degrees(2.0 * theta).cos;
          });
  }
  return curves;
}

const std::map<Property, Sense>& senses() {
  static const std::map<Property, Sense> all = [] {
    const auto along = [](const SinCos& a) { return squared(a.sin); };
    const auto across = [](const SinCos& a) { return squared(a.cos); };
    const auto strain_across = [](const SinCos& a) { return squared(squared(a.cos)); };
    const Sense slip{weak_planes(), 0.05, 0.01}, split{softened_by_planes(along, 1.0), 0.08, 0.02};
    return std::map<Property, Sense>{
        {Property::E, {softened_by_planes(strain_across, 5.0), 0.04, 0.08}},
        {Property::ucs, slip},
        {Property::confined, slip},
        {Property::direct_tension, {softened_by_planes(across, 1.0), 0.08, 0.02}},
        {Property::brazilian, split},
        {Property::fracture_toughness, split}};
  }();
  return all;
}

/// Cells of one test, as logarithms, with the weights that errors and theory give them.
struct Cells {
  std::vector<double> theta, log_value, weight;
};

Cells cells_of(const std::vector<Target>& test, double off, bool exchanged) {
  Cells cells;
  for (const Target& t : test) {
    cells.theta.push_back(exchanged ? 90.0 - t.theta : t.theta);
    cells.log_value.push_back(std::log(t.mean));
    cells.weight.push_back(1.0 / (squared(t.normal_error() / t.mean) + squared(off)));
  }
  return cells;
}

/// One curve against cells, at the level that suits them best.
struct CurveMisfit {
  double chi_square = 0.0, squares = 0.0;  ///< the latter of relative misses, unweighted
};

CurveMisfit misfit_of(const Curve& curve, const Cells& cells) {
  std::vector<double> distance;
  double weights = 0.0, level = 0.0;
  for (std::size_t i = 0; i < cells.theta.size(); ++i) {
    distance.push_back(cells.log_value[i] - curve(cells.theta[i]));
    weights += cells.weight[i], level += cells.weight[i] * distance[i];
  }
  level /= weights;
  CurveMisfit misfit;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    misfit.chi_square += cells.weight[i] * squared(distance[i] - level);
    misfit.squares += squared(std::expm1(level - distance[i]));
  }
  return misfit;
}

/// How a test lies to the curves of its property.
struct Likeness {
  double log_mean = 0.0;  ///< of exp(-chi^2/2) over the curves
  double squares = 0.0;   ///< of the relative misses of the nearest
};

Likeness likeness(const std::vector<Target>& test, const Sense& sense, bool exchanged) {
  const Cells cells = cells_of(test, sense.off, exchanged);
  const CurveMisfit flat = misfit_of([](double) { return 0.0; }, cells);
  CurveMisfit nearest = flat;
  std::vector<double> chi_squares;
  for (const Curve& curve : sense.curves) {
    const CurveMisfit m = misfit_of(curve, cells);
    if (m.chi_square < nearest.chi_square) nearest = m;
    chi_squares.push_back(m.chi_square);
  }
  // against underflow in units of the nearest
  const auto likely = [&](double chi_square) { return std::exp(0.5 * (nearest.chi_square - chi_square)); };
  double mean = 0.0;
  for (const double c : chi_squares) mean += likely(c) / static_cast<double>(chi_squares.size());
  const double m = share_isotropic * likely(flat.chi_square) + (1.0 - share_isotropic) * mean;
  return {std::log(m) - 0.5 * nearest.chi_square, nearest.squares};
}

/// Cells of one property, test by test: discs of one diameter, strengths under one stress.
std::vector<std::vector<Target>> tests_of(const std::vector<Target>& targets, Property p) {
  std::vector<std::vector<Target>> tests;
  for (const Target& t : of_property(targets, p)) {
    const auto same = [&](const std::vector<Target>& test) { return same_test(test.front(), t); };
    const auto found = std::find_if(tests.begin(), tests.end(), same);
    if (found == tests.end())
      tests.push_back({t});
    else
      found->push_back(t);
  }
  return tests;
}

/// ln(((1 - e) m' + e m)/((1 - e) m + e m')) of d = ln(m'/m).
double bounded(double d, double e) {
  const auto log_of = [e](double x) {  // ln((1 - e) exp(x) + e), x <= 0 or not
    return x > 0.0 ? x + std::log1p(-e + e * std::exp(-x)) : std::log((1.0 - e) * std::exp(x) + e);
  };
  return log_of(d) - d - log_of(-d);
}

/// What one property says.
struct AngleEvidence {
  Property property = Property::E;
  double log_odds = 0.0;    ///< that its angles are the complements of theta, before any prior
  double as_read = 0.0;     ///< root mean square miss of the nearest curve, relative
  double complement = 0.0;  ///< the same with 90 - angle
  bool exchanged = false;   ///< by the likeliest reading of the table
};

AngleEvidence evidence_of(Property p, const Sense& sense, const std::vector<Target>& targets) {
  AngleEvidence found;
  found.property = p;
  double as_read = 0.0, complement = 0.0, log_ratio = 0.0, n = 0.0;
  for (const std::vector<Target>& cells : tests_of(targets, p)) {
    const Likeness here = likeness(cells, sense, false), there = likeness(cells, sense, true);
    log_ratio += there.log_mean - here.log_mean;
    as_read += here.squares, complement += there.squares, n += static_cast<double>(cells.size());
  }
  found.log_odds = bounded(log_ratio, sense.exceptions);
  found.as_read = std::sqrt(as_read / n), found.complement = std::sqrt(complement / n);
  return found;
}

/// Of a reading of n columns by which k are exchanged.
double log_prior(int k, int n) {
  const double q = tables_exchanged, r = columns_apart;
  return std::log((1.0 - q) * std::pow(r, k) * std::pow(1.0 - r, n - k) +
                  q * std::pow(r, n - k) * std::pow(1.0 - r, k));
}

/// Marks what the likeliest reading exchanges.
void mark_exchanged(std::vector<AngleEvidence>& properties) {
  const int n = static_cast<int>(properties.size());
  unsigned best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (unsigned reading = 0; reading < 1U << n; ++reading) {
    double log_p = 0.0;
    int exchanged = 0;
    for (int i = 0; i < n; ++i)
      if ((reading >> i & 1U) != 0) log_p += properties[static_cast<std::size_t>(i)].log_odds, ++exchanged;
    log_p += log_prior(exchanged, n);
    if (log_p > most) most = log_p, best = reading;
  }
  for (int i = 0; i < n; ++i) properties[static_cast<std::size_t>(i)].exchanged = (best >> i & 1U) != 0;
}

Finding finding_of(const std::vector<AngleEvidence>& properties, const std::vector<Target>& targets,
                   bool from_load) {
  const bool all =
      std::all_of(properties.begin(), properties.end(), [](const AngleEvidence& e) { return e.exchanged; });
  Finding f{all ? FindingKind::angles_exchanged : FindingKind::columns_exchanged};
  f.numbers.push_back({"from_load", from_load ? 1.0 : 0.0});
  for (const AngleEvidence& e : properties) {
    f.names.emplace_back(to_string(e.property));
    f.numbers.insert(
        f.numbers.end(),
        {{"exchanged", e.exchanged ? 1.0 : 0.0}, {"as_read", e.as_read}, {"complement", e.complement}});
    if (e.exchanged)
      for (const Target& t : of_property(targets, e.property)) f.cells.push_back(cell_of(t));
  }
  f.advice = all ? Advice::rename_angles : Advice::rows_of_their_own;
  return f;
}

}  // namespace

std::vector<Finding> angle_question(const std::vector<Target>& targets, bool from_load) {
  std::vector<AngleEvidence> properties;
  const std::vector<Target> some = least_confined(targets);
  for (const auto& [property, sense] : senses())
    if (const std::vector<Target> cells = of_property(some, property); std::any_of(
            cells.begin(), cells.end(), [&](const Target& t) { return t.theta != cells.front().theta; }))
      properties.push_back(evidence_of(property, sense, cells));
  mark_exchanged(properties);
  if (std::none_of(properties.begin(), properties.end(), [](const AngleEvidence& e) { return e.exchanged; }))
    return {};
  return {finding_of(properties, some, from_load)};
}

}  // namespace phy::survey
