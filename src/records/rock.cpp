#include "records/rock.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace phy {
namespace {

constexpr double pooled_weight = 10.0;  // degrees of freedom lent by the other angles
constexpr int usual_degrees = 4;        // that the usual scatter is worth beside the table's own
constexpr double same_angle = 1e-6;     // [deg]

/// Scatter of most rocks: relative for moduli and strengths, absolute for nu.
double usual_scatter(Property p) {
  if (p == Property::nu) return 0.03;
  return p == Property::direct_tension || p == Property::brazilian ? 0.15 : 0.05;
}

/// Sums of squared deviations inside and between the rows of a cell, and their degrees of freedom.
struct Pool {
  double squares = 0.0;
  int degrees = 0;
  bool given = false;  ///< the table has an SD
};

Pool pool_of(const std::vector<const RockReading*>& rows, double mean) {
  Pool pool;
  for (const RockReading* r : rows) {
    if (std::isfinite(r->sd)) {
      const int degrees = std::max(1, r->n - 1);
      pool.squares += degrees * r->sd * r->sd, pool.degrees += degrees, pool.given = true;
    }
    pool.squares += r->n * (r->value - mean) * (r->value - mean);
  }
  pool.degrees += static_cast<int>(rows.size()) - 1;
  return pool;
}

/// Variance of single specimens that the scatter seen leaves us with, where `usual` is expected: the mean of
/// a scaled inverse chi-square with `usual_degrees`. A pair that happens to agree cannot make a table exact.
double expected_variance(const Pool& seen, double usual) {
  return (usual_degrees * usual * usual + seen.squares) / (usual_degrees + seen.degrees);
}

/// SD of single specimens in a cell: its own SDs as given; else its replicates, drawn towards `common`.
double scatter_of(const Pool& own, double common) {
  if (own.given) return std::sqrt(own.squares / own.degrees);
  return std::sqrt((own.squares + pooled_weight * common) / (own.degrees + pooled_weight));
}

/// The target whose load runs most nearly along the bedding; nullptr without any.
const Target* along_bedding(const std::vector<Target>& targets, Property p) {
  const Target* best = nullptr;
  for (const Target& t : targets)
    if (t.property == p && (best == nullptr || t.theta > best->theta)) best = &t;
  return best;
}

/// 1/E_2D = 1/E_theta - h, nu_2D/E_2D = nu_theta/E_theta + h, h = nu^2/E with E and nu of the rock along its
/// bedding: the out-of-plane strain is held by the rock between the joints, which add nothing there. Scatter:
/// that of E stays the same share; that of nu is carried by the derivative, in the cell along the bedding
/// with dh/dnu = 2 nu/E.
void to_plane_stress(std::vector<Target>& targets) {
  const Target *E_found = along_bedding(targets, Property::E),
               *nu_found = along_bedding(targets, Property::nu);
  if (E_found == nullptr || nu_found == nullptr) return;
  const Target E = *E_found, nu = *nu_found;
  const double held = nu.mean * nu.mean / E.mean;
  std::map<double, double> E_lab;
  for (const Target& t : targets)
    if (t.property == Property::E) E_lab[t.theta] = t.mean;
  for (Target& t : targets) {
    const auto at = E_lab.find(t.theta);
    if (at == E_lab.end()) continue;
    const double E_2D = 1.0 / (1.0 / at->second - held);
    if (t.property == Property::E)
      for (double& E_one : t.specimens) E_one = 1.0 / (1.0 / E_one - held);
    if (t.property == Property::nu)
      for (double& nu_one : t.specimens) nu_one = E_2D * (nu_one / at->second + held);
    if (t.property == Property::E) {
      t.sd *= E_2D / t.mean, t.mean = E_2D;
    } else if (t.property == Property::nu) {
      const double nu_2D = E_2D * (t.mean / at->second + held);
      const double by_held = t.theta == nu.theta ? E_2D * (1.0 + nu_2D) * 2.0 * nu.mean / E.mean : 0.0;
      t.sd *= E_2D / at->second + by_held, t.mean = nu_2D;
    }
  }
}

}  // namespace

const char* to_string(Property property) {
  constexpr std::array<const char*, n_properties> names = {"E", "nu", "UCS", "DTS", "BTS"};
  return names[static_cast<std::size_t>(property)];
}

void remove_layers(Recipe& model) {
  const MatrixRecipe alike;
  MatrixRecipe& m = model.matrix;
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

const char* to_string(LayerModel model) {
  switch (model) {
    case LayerModel::choose: return "choose";
    case LayerModel::planes: return "planes";
    case LayerModel::directions: return "directions";
    case LayerModel::planes_and_directions: return "planes and directions";
  }
  return "";
}

bool is_strength(Property property) { return property != Property::E && property != Property::nu; }

double Target::standard_error() const { return sd / std::sqrt(static_cast<double>(n)); }

std::vector<Target> targets_of(const Rock& rock) {
  std::map<std::tuple<Property, long, double>, std::vector<const RockReading*>> cells;
  for (const RockReading& r : rock.readings)
    if (r.confining == 0.0 || !is_strength(r.property))
      cells[{r.property, std::lround(r.theta / same_angle),
             r.property == Property::brazilian ? r.diameter : 0.0}]
          .push_back(&r);
  std::vector<Target> targets;
  std::map<Property, Pool> pooled;  // relative, but absolute for nu
  std::vector<Pool> own;
  for (const auto& [key, rows] : cells) {
    Target t;
    t.property = std::get<0>(key), t.theta = rows.front()->theta, t.diameter = std::get<2>(key), t.n = 0;
    for (const RockReading* r : rows) {
      t.mean += r->n * r->value, t.n += r->n;
      if (r->n == 1) t.specimens.push_back(r->value);
    }
    t.mean /= t.n;
    own.push_back(pool_of(rows, t.mean));
    const double scale = t.property == Property::nu ? 1.0 : t.mean * t.mean;
    pooled[t.property].squares += own.back().squares / scale;
    pooled[t.property].degrees += own.back().degrees;
    targets.push_back(t);
  }
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Target& t = targets[i];
    const Pool& all = pooled[t.property];
    const double scale = t.property == Property::nu ? 1.0 : t.mean;
    t.sd = scatter_of(own[i], expected_variance(all, usual_scatter(t.property)) * scale * scale);
    t.sd_assumed = !own[i].given && all.degrees < usual_degrees;
  }
  if (rock.reading == ElasticReading::plane_strain) to_plane_stress(targets);
  return targets;
}

std::vector<Target> of_property(const std::vector<Target>& targets, Property property) {
  std::vector<Target> some;
  for (const Target& t : targets)
    if (t.property == property) some.push_back(t);
  return some;
}

}  // namespace phy
