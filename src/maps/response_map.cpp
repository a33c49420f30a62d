#include "maps/response_map.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <tuple>

#include "base/check.hpp"
#include "base/embedded.hpp"
#include "base/nan.hpp"

namespace phy::maps {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double farthest = 1.2;  // a variable is believed, in half ranges
constexpr int n_folds = 5;
// Usual sizes of coefficients, in units of the logarithm, and the scatter of one run: how far each is
// believed.
constexpr double noise = 0.11, slope = 0.4, second = 0.1;
// What makes a point plausible.
constexpr double most_broken = 0.2, largest_nu = 0.6, least_initiation = 0.3;

std::string_view text_of(const MappedModel& model) {
  return embedded(fmt::format("data/maps/{}.csv", model.name));
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0;;) {
    const std::size_t comma = line.find(',', at);
    cells.push_back(line.substr(at, comma - at));
    if (comma == line.npos) return cells;
    at = comma + 1;
  }
}

/// An empty cell is a test without a usable strength.
double number_in(std::string_view cell) {
  double v = nan;
  if (!cell.empty()) std::from_chars(cell.data(), cell.data() + cell.size(), v);
  return v;
}

double clamped(double place) { return std::clamp(place, -farthest, farthest); }

/// 1, the places, and the products of all pairs.
VectorXd features_of(const std::vector<double>& places) {
  const std::size_t n = places.size();
  VectorXd f(static_cast<Eigen::Index>(1 + n + n * (n + 1) / 2));
  Eigen::Index next = 0;
  f[next++] = 1.0;
  for (std::size_t i = 0; i < n; ++i) f[next++] = clamped(places[i]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) f[next++] = clamped(places[i]) * clamped(places[j]);
  return f;
}

/// Where the product of two of n places stands among the features.
std::size_t pair_of(std::size_t n, std::size_t i, std::size_t j) {
  return 1 + n + std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j);
}

/// Points of one packing are left out together: those of one remainder.
int fold_of(const ResponseMap& table, std::size_t row) {
  return static_cast<int>(table.at(row, "point")) % n_folds;
}

/// The inclinations of a column that a table has.
std::vector<std::string> columns_named(const ResponseMap& table, const char* stem) {
  std::vector<std::string> names;
  for (const double theta : mapped_angles) names.push_back(column_at(table.model(), stem, theta));
  return names;
}

}  // namespace

ResponseMap::ResponseMap(const MappedModel& model, std::string_view csv) : model_(&model) {
  while (!csv.empty()) {
    const std::size_t end = std::min(csv.find('\n'), csv.size());
    const std::vector<std::string_view> cells = cells_of(csv.substr(0, end));
    csv.remove_prefix(std::min(end + 1, csv.size()));
    if (columns_.empty()) {
      columns_.assign(cells.begin(), cells.end());
      continue;
    }
    // the tables were taken in when the program was built: a short row is our own bug
    PHY_CHECK(cells.size() == columns_.size(), fmt::format("{}.csv: as many cells as columns", model.name));
    std::vector<double> row;
    for (const std::string_view c : cells) row.push_back(number_in(c));
    rows_.push_back(row);
    std::vector<double> places;
    for (const MapVariable& l : model.variables) places.push_back(l.normalised(at(rows_.size() - 1, l.name)));
    places_.push_back(places);
  }
}

double ResponseMap::at(std::size_t row, const std::string& column) const {
  const auto it = std::find(columns_.begin(), columns_.end(), column);
  PHY_CHECK(it != columns_.end(), fmt::format("{}.csv: a column {}", model_->name, column));
  return rows_[row][static_cast<std::size_t>(it - columns_.begin())];
}

bool ResponseMap::is_dense(std::size_t row) const {
  return at(row, "n_grains") == static_cast<double>(model_->base.packing.n_grains);
}

bool ResponseMap::is_plausible(std::size_t row) const {
  const auto all = [&](const char* stem, const auto& good) {
    const std::vector<std::string> names = columns_named(*this, stem);
    return std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return good(at(row, name)); });
  };
  return all("broken", [](double v) { return v < most_broken; }) &&
         all("nu50", [](double v) { return v < largest_nu; }) &&
         all("sigma_ci/UCS", [](double v) { return v > least_initiation; });
}

const ResponseMap& map_of(const MappedModel& model) {
  static const std::map<std::string_view, ResponseMap> tables = [] {
    std::map<std::string_view, ResponseMap> all;
    for (const MappedModel& f : mapped_models()) all.emplace(f.name, ResponseMap(f, text_of(f)));
    return all;
  }();
  return tables.at(model.name);
}

std::string column_at(const MappedModel& model, const std::string& column, double theta) {
  return model.layered() ? fmt::format("{}({:g})", column, theta) : column;
}

const char* map_column(const MappedModel& model, Property property, ModulusReading reading) {
  const MapColumns& of = measured(property).map;
  if (model.layered() && !of.layered) return nullptr;
  const bool small_strain = !is_strength(property) && reading == ModulusReading::small_strain;
  return small_strain ? of.small_strain : of.as_read;
}

double log_share(Property property) { return std::log(measured(property).share); }

Bracket bracket_of(Property property, double theta) {
  const std::span<const double> mapped =
      measured(property).of_discs ? std::span<const double>(mapped_disc_angles) : mapped_angles;
  if (theta > 90.0) theta = 180.0 - theta;  // the layers are mirror images, and so are their strengths
  std::size_t i = 0;
  // at an angle that was mapped the share is 0 or 1, so that nothing of the other column counts
  while (i + 2 < mapped.size() && mapped[i + 1] < theta) ++i;
  return {mapped[i], mapped[i + 1], (theta - mapped[i]) / (mapped[i + 1] - mapped[i])};
}

MapRegression::MapRegression(const MapRegression& low, const MapRegression& high, double share) {
  for (std::size_t i = 0; i < low.coefficients_.size(); ++i)
    coefficients_.push_back(std::lerp(low.coefficients_[i], high.coefficients_[i], share));
}

MapRegression::MapRegression(const ResponseMap& table, const std::string& column, int fold)
    : MapRegression(
          table, [&](std::size_t row) { return std::log(table.at(row, column)); }, fold) {}

MapRegression::MapRegression(const ResponseMap& table, const std::function<double(std::size_t)>& log_answer,
                             int fold) {
  MatrixXd A;
  VectorXd b;
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    const double y = log_answer(row);
    if (!std::isfinite(y) || !table.is_dense(row) || (fold >= 0 && fold_of(table, row) == fold)) continue;
    const VectorXd f = features_of(table.places(row));
    // ridge: coefficients of a usual size cost as much as the scatter of one run
    if (A.size() == 0) {
      VectorXd size = VectorXd::Constant(f.size(), second);
      size[0] = 1.0, size.segment(1, static_cast<Eigen::Index>(table.places(row).size())).setConstant(slope);
      A = (noise * size.cwiseInverse()).cwiseAbs2().asDiagonal();
      b = VectorXd::Zero(f.size());
    }
    A.selfadjointView<Eigen::Lower>().rankUpdate(f);
    b += f * y;
  }
  PHY_CHECK(A.size() > 0, fmt::format("{}.csv: answers to learn from", table.model().name));
  const VectorXd c = A.selfadjointView<Eigen::Lower>().ldlt().solve(b);
  coefficients_.assign(c.begin(), c.end());
}

double MapRegression::at(std::span<const double> places) const {
  const std::size_t n = places.size();
  const double *slopes = coefficients_.data() + 1, *pairs = slopes + n;
  double sum = coefficients_.front();
  for (std::size_t i = 0; i < n; ++i) {
    double slope_here = slopes[i];
    // half of the pairs: (i, j) and (j, i) are one feature
    for (std::size_t j = 0; j <= i; ++j) slope_here += *pairs++ * clamped(places[j]);
    sum += slope_here * clamped(places[i]);
  }
  return sum;
}

MapRegression MapRegression::over(const std::vector<std::size_t>& open,
                                  std::span<const double> places) const {
  const std::size_t n = places.size();
  PHY_CHECK(coefficients_.size() == pair_of(n, n, 0), "a place for each variable");
  // pairs of an open and a closed variable become part of the open one's slope
  std::vector<double> closed(places.begin(), places.end());
  for (const std::size_t k : open) closed[k] = 0.0;
  MapRegression some = *this;
  some.coefficients_ = {at(closed)};
  for (const std::size_t k : open) {
    double slope_there = coefficients_[1 + k];
    for (std::size_t j = 0; j < n; ++j) slope_there += coefficients_[pair_of(n, k, j)] * clamped(closed[j]);
    some.coefficients_.push_back(slope_there);
  }
  for (std::size_t a = 0; a < open.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b)
      some.coefficients_.push_back(coefficients_[pair_of(n, open[a], open[b])]);
  return some;
}

const MapRegression& regression_of(const MappedModel& model, const std::string& what,
                                   const std::function<double(std::size_t)>& log_answer, int fold) {
  static std::mutex mutex;  // several models are compared at once
  static std::map<std::tuple<std::string, std::string, int>, std::unique_ptr<MapRegression>> made;
  const std::scoped_lock lock(mutex);
  std::unique_ptr<MapRegression>& one = made[{model.name, what, fold}];
  if (!one) one = std::make_unique<MapRegression>(map_of(model), log_answer, fold);
  return *one;
}

const MapRegression& regression_of(const MappedModel& model, const std::string& column, int fold) {
  return regression_of(
      model, column, [&](std::size_t row) { return std::log(map_of(model).at(row, column)); }, fold);
}

double MapRegression::left_out_error(const ResponseMap& table, const std::string& column) {
  double squares = 0.0;
  int n = 0;
  // a fifth of the points at a time, each with all of its packings
  for (int fold = 0; fold < n_folds; ++fold) {
    const MapRegression others(table, column, fold);
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
      const double y = std::log(table.at(row, column));
      if (!std::isfinite(y) || !table.is_dense(row) || fold_of(table, row) != fold) continue;
      const double e = y - others.at(table.places(row));
      squares += e * e, ++n;
    }
  }
  return std::sqrt(squares / n);
}

}  // namespace phy::maps
