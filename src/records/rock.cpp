#include "records/rock.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/stats.hpp"

namespace phy {
namespace {

constexpr int prior_degrees = 4;  // degrees of freedom that the prior scatter is worth
constexpr int many_degrees = 10;  // with which a table needs no prior to know its scatter
constexpr int most_lent = 10;     // that the prior and the other cells lend to one
// Of angles such as 90 - beta, whose last digits differ by how they came about.
constexpr double same_angle = 1e-6;  // [deg]

/// Sum of squared deviations from means, and the degrees of freedom behind it.
struct Pool {
  double squares = 0.0;
  int degrees = 0;
};

/// Inside the rows of a cell, where these tell it, and between them. A row of n specimens with their SD is
/// worth what the n rows behind it are.
Pool pool_of(const std::vector<const RockReading*>& rows, double mean) {
  Pool pool;
  for (const RockReading* r : rows) {
    // A mean of three with its SD has to count exactly as its three values would.
    if (std::isfinite(r->sd)) pool.squares += (r->n - 1) * r->sd * r->sd, pool.degrees += r->n - 1;
    pool.squares += r->n * (r->value - mean) * (r->value - mean);
  }
  pool.degrees += static_cast<int>(rows.size()) - 1;
  return pool;
}

/// Variance of single specimens of a cell and the degrees of freedom behind it: the scale of an inverse
/// chi-square that begins with the prior (its squares are variance times degrees), learns from the other
/// cells and, as far as these may lend, from the cell's own.
Pool variance_of(const Pool& own, const Pool& others, const Pool& prior) {
  // Scatter may depend on the angle: the other cells may help, but not decide.
  const int common_degrees = prior.degrees + others.degrees, lent = std::min(most_lent, common_degrees);
  const double common = common_degrees > 0 ? (prior.squares + others.squares) / common_degrees : 0.0;
  const int degrees = own.degrees + lent;
  return {(own.squares + lent * common) / degrees, degrees};
}

/// Scatter of a cell, from its own deviations and those of all cells of the property: with what is usual and,
/// where the table knows enough by itself, without.
void set_scatter(Target& t, const Pool& own, const Pool& all) {
  const MeasuredProperty& p = measured(t.property);
  const Pool others = {all.squares - own.squares, all.degrees - own.degrees},
             usual = {prior_degrees * p.usual_scatter * p.usual_scatter, prior_degrees};
  // Pooled relative to the mean: cells of 20 and of 200 MPa scatter by like shares, not by like stresses.
  const double unit = p.absolute ? 1.0 : t.mean;
  const auto [variance, degrees] = variance_of(own, others, usual);
  t.sd = std::sqrt(variance) * unit, t.degrees = degrees, t.sd_assumed = all.degrees < prior_degrees;
  // With fewer the table's own scatter is known no better than what is usual.
  if (all.degrees < many_degrees) return;
  const Pool stated = variance_of(own, others, {});
  t.stated_sd = std::sqrt(stated.squares) * unit, t.stated_degrees = stated.degrees;
}

/// Of one confining stress alone.
AlongBedding along_under(const std::vector<Target>& targets, double confining) {
  AlongBedding along;
  for (const Target& t : targets) {
    // E and nu of one body: mixed from two stresses they would be of none.
    if (is_strength(t.property) || t.confining != confining) continue;
    const Target*& best = t.property == Property::E ? along.E : along.nu;
    // Out of the plane there is always rock along the bedding, whatever the angle in it: the steepest cell is
    // nearest.
    if (best == nullptr || t.theta > best->theta) best = &t;
  }
  return along;
}

/// 1/E_2D = 1/E_theta - h, nu_2D/E_2D = nu_theta/E_theta + h, h = nu^2/E with E and nu of the rock along its
/// bedding, under the same confining stress: the out-of-plane strain is held by the rock between the joints,
/// which add nothing there. Scatter: that of E stays the same share; that of nu is carried by the derivative,
/// in the cell along the bedding with dh/dnu = 2 nu/E.
void to_plane_stress(std::vector<Target>& targets) {
  // A copy: h is of the cylinder, and a cell that was converted already would enter it.
  const std::vector<Target> laboratory = targets;
  std::map<std::pair<double, double>, double> E_lab;  // by angle and confining stress
  for (const Target& t : laboratory)
    if (t.property == Property::E) E_lab[{t.theta, t.confining}] = t.mean;
  for (Target& t : targets) {
    const auto at = E_lab.find({t.theta, t.confining});
    const AlongBedding along = along_bedding(laboratory, t.confining);
    if (is_strength(t.property) || at == E_lab.end() || !along.complete()) continue;
    const Target &E = *along.E, &nu = *along.nu;
    const double held = nu.mean * nu.mean / E.mean;
    const double E_2D = 1.0 / (1.0 / at->second - held);
    if (t.property == Property::E)
      // Specimens go along, so that outliers are looked for in the numbers that are fitted.
      for (double& E_one : t.specimens) E_one = 1.0 / (1.0 / E_one - held);
    if (t.property == Property::nu)
      for (double& nu_one : t.specimens) nu_one = E_2D * (nu_one / at->second + held);
    if (t.property == Property::E) {
      t.stated_sd *= E_2D / t.mean, t.sd *= E_2D / t.mean, t.mean = E_2D;
    } else if (t.property == Property::nu) {
      const double nu_2D = E_2D * (t.mean / at->second + held);
      const double by_held = same_cell(t, nu) ? E_2D * (1.0 + nu_2D) * 2.0 * nu.mean / E.mean : 0.0;
      for (double* sd : {&t.sd, &t.stated_sd}) *sd *= E_2D / at->second + by_held;
      t.mean = nu_2D;
    }
  }
}

/// Confining stress of a reading as the tests of the table are told apart: of those within 5 % the mean.
class ConfiningStresses {
 public:
  explicit ConfiningStresses(const std::vector<RockReading>& readings) {
    std::set<std::pair<Place, int>> rows;  // a specimen's stress counts once, whatever was read of it
    for (const RockReading& r : readings)
      if (counts(r)) rows.emplace(place_of(r), r.line);
    for (auto from = rows.begin(); from != rows.end();) {
      const Place least = from->first;
      Place largest = least;
      double sum = 0.0, n = 0.0;
      for (; from != rows.end() && from->first.first == least.first &&
             same_stress(from->first.second, least.second);
           ++from)
        largest = from->first, sum += largest.second, ++n;
      classes_[largest] = sum / n;
    }
  }
  double of(const RockReading& r) const {
    return counts(r) ? classes_.lower_bound(place_of(r))->second : 0.0;
  }

 private:
  /// Stress on the sides and stress across bedding are two kinds.
  using Place = std::pair<bool, double>;
  std::map<Place, double> classes_;  // mean by the largest

  static Place place_of(const RockReading& r) { return {measured(r.property).along_bedding, r.confining}; }

  static bool counts(const RockReading& r) { return r.confining > 0.0 && measured(r.property).under_stress; }
};

}  // namespace

void remove_layers(Recipe& model) {
  const MatrixRecipe alike;
  MatrixRecipe& m = model.matrix;
  // Directions are layers too: left in, they would make an isotropic rock anisotropic.
  model.bedding.clear();
  m.stiffness_ratio = alike.stiffness_ratio, m.tension_ratio = alike.tension_ratio;
  m.cohesion_ratio = alike.cohesion_ratio, m.cohesion_oblique = alike.cohesion_oblique;
}

const char* to_string(ModulusReading reading) {
  switch (reading) {
    case ModulusReading::tangent_50: return "tangent 50 %";
    case ModulusReading::average: return "average";
    case ModulusReading::secant_50: return "secant 50 %";
    case ModulusReading::secant_at_peak: return "secant at peak";
    case ModulusReading::small_strain: return "small strain";
  }
  return "";
}

ModulusReading modulus_reading_of(const std::string& word) {
  using enum ModulusReading;
  for (const ModulusReading r : {tangent_50, average, secant_50, secant_at_peak, small_strain})
    if (word == to_string(r)) return r;
  throw std::out_of_range("no reading of E: " + word);
}

bool same_stress(double a, double b) { return std::fabs(a - b) <= 0.05 * std::min(a, b); }

bool same_test(const Target& a, const Target& b) {
  return a.property == b.property && a.diameter == b.diameter && a.confining == b.confining;
}

bool same_cell(const Target& a, const Target& b) { return same_test(a, b) && a.theta == b.theta; }

double Target::standard_error() const { return sd / std::sqrt(static_cast<double>(n)); }

double Target::half_width() const {
  return (degrees > 0 ? student_t_95(static_cast<std::size_t>(degrees)) : z_95) * standard_error();
}

double Target::normal_error() const { return half_width() / z_95; }

AlongBedding along_bedding(const std::vector<Target>& targets, double confining) {
  AlongBedding along = along_under(targets, confining);
  std::set<double> stresses;
  for (const Target& t : targets) stresses.insert(t.confining);
  // By growing stress: the least confined body is the nearest to one without.
  for (const double other : stresses)
    if (!along.complete()) along = along_under(targets, other);
  return along;
}

std::vector<Target> targets_of(const Rock& rock) {
  std::map<std::tuple<Property, long, double, double>, std::vector<const RockReading*>> cells;
  const ConfiningStresses stresses(rock.readings);
  for (const RockReading& r : rock.readings)
    // Values under a stress that no test of theirs knows are kept in the table, and fitted by nothing.
    if (r.confining == 0.0 || measured(r.property).under_stress)
      cells[{r.property, std::lround(r.theta / same_angle), measured(r.property).of_discs ? r.diameter : 0.0,
             stresses.of(r)}]
          .push_back(&r);
  std::vector<Target> targets;
  std::map<Property, Pool> pooled;  // in the property's own way, relative or absolute
  std::vector<Pool> own;            // of each cell
  for (const auto& [key, rows] : cells) {
    Target t;
    t.property = std::get<0>(key), t.theta = rows.front()->theta, t.diameter = std::get<2>(key);
    t.confining = std::get<3>(key), t.n = 0;
    for (const RockReading* r : rows) {
      t.mean += r->n * r->value, t.n += r->n;
      // Rows that stand for several, or for a line, are no specimens that could be outliers.
      if (r->n == 1 && !r->derived) t.specimens.push_back(r->value);
    }
    t.mean /= t.n;
    Pool cell = pool_of(rows, t.mean);
    cell.squares /= measured(t.property).absolute ? 1.0 : t.mean * t.mean;
    own.push_back(cell);
    pooled[t.property].squares += cell.squares, pooled[t.property].degrees += cell.degrees;
    targets.push_back(t);
  }
  for (std::size_t i = 0; i < targets.size(); ++i)
    set_scatter(targets[i], own[i], pooled[targets[i].property]);
  if (rock.reading == ElasticReading::plane_strain) to_plane_stress(targets);
  return targets;
}

std::vector<Target> of_property(const std::vector<Target>& targets, Property property) {
  std::vector<Target> some;
  for (const Target& t : targets)
    if (t.property == property) some.push_back(t);
  return some;
}

std::vector<Target> least_confined(const std::vector<Target>& targets) {
  const auto is_lower = [](const Target& t, const Target& than) {
    return t.property == than.property && t.theta == than.theta && t.confining < than.confining;
  };
  std::vector<Target> some;
  for (const Target& t : targets)
    if (is_strength(t.property) ||
        std::none_of(targets.begin(), targets.end(), [&](const Target& other) { return is_lower(other, t); }))
      some.push_back(t);
  return some;
}

}  // namespace phy
