#include "jobs/rock_base.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/embedded.hpp"
#include "base/spelling.hpp"
#include "base/units.hpp"
#include "report/rock_cards.hpp"
#include "rock/file.hpp"

namespace phy::jobs {
namespace {

constexpr const char* folder = "data/rocks/";
constexpr std::size_t fewest_angles = 3;  // two have no shape beside their ratio
constexpr double farthest = 0.25;         // of curves over their means; beyond it a rock is no neighbour
constexpr Property compared[] = {Property::ucs, Property::E, Property::brazilian};

std::string path_of(const std::string& name, const char* file) { return folder + name + "/" + file; }

void check_known(const std::string& name) {
  const std::vector<std::string> names = base_rocks();
  if (std::ranges::find(names, name) != names.end()) return;
  const std::string near = nearest(name, names);
  throw InputError(Problem{"measured rocks", "name", name, fmt::format("one of {}", fmt::join(names, ", ")),
                           near.empty() ? "" : "did you mean " + near + "?"});
}

bool is_embedded(const std::string& path) {
  const auto files = embedded_below(path);
  return std::ranges::find(files, path) != files.end();
}

/// The name of the table in a rock file, `"../dyn_th26.csv"`, without its quotes.
std::string data_of(std::string_view rock) {
  constexpr std::string_view key = "\ndata = \"";
  const std::size_t begin = rock.find(key) + key.size();
  return std::string(rock.substr(begin, rock.find('"', begin) - begin));
}

/// Where the table lies that a rock file names.
std::string table_path(const std::string& name, const std::string& data) {
  return std::filesystem::path(path_of(name, data.c_str())).lexically_normal().generic_string();
}

using Curve = std::map<double, double>;  // by angle

/// One value per angle, those without confinement or under the least one.
Curve curve_of(const std::vector<Target>& table, Property property) {
  Curve curve;
  for (const Target& t : least_confined(table))
    if (t.property == property && (property == Property::E || t.confining == 0.0))
      curve.emplace(t.theta, t.mean);
  return curve;
}

/// On the straight line between the neighbours; NaN outside.
double at(const Curve& curve, double theta) {
  const auto above = curve.lower_bound(theta);
  if (above == curve.end()) return nan;
  if (above->first == theta) return above->second;
  if (above == curve.begin()) return nan;
  const auto below = std::prev(above);
  return std::lerp(below->second, above->second, (theta - below->first) / (above->first - below->first));
}

/// NaN where they share too few angles.
double difference(const Curve& table, const Curve& base) {
  std::vector<std::pair<double, double>> both;
  double of_table = 0.0, of_base = 0.0;
  for (const auto& [theta, value] : table)
    if (const double other = at(base, theta); !std::isnan(other)) {
      both.emplace_back(value, other);
      of_table += value, of_base += other;
    }
  if (both.size() < fewest_angles) return nan;
  const auto n = static_cast<double>(both.size());
  double sum = 0.0;
  for (const auto& [value, other] : both) sum += std::pow(n * value / of_table - n * other / of_base, 2);
  return std::sqrt(sum / n);
}

struct BaseTable {
  std::string name, title;
  std::vector<Target> targets;
};

/// Read once: a page asks for the nearest with every change of its table.
const std::vector<BaseTable>& base_tables() {
  static const std::vector<BaseTable> tables = [] {
    std::vector<BaseTable> all;
    for (const std::string& name : base_rocks()) {
      const Rock rock = base_rock(name);
      all.push_back({name, rock.name, targets_of(rock)});
    }
    return all;
  }();
  return tables;
}

}  // namespace

std::vector<std::string> base_rocks() {
  std::vector<std::string> names;
  for (const std::string_view path : embedded_below(folder))
    if (path.ends_with("/rock.toml"))
      names.push_back(std::filesystem::path(path).parent_path().filename().string());
  return names;
}

Rock base_rock(const std::string& name) {
  check_known(name);
  const std::string path = path_of(name, "rock.toml");
  const std::string_view text = embedded(path);
  return rock::parse_rock(text, path, {std::string(embedded(table_path(name, data_of(text)))), {}});
}

std::string_view base_card(const std::string& name) {
  check_known(name);
  return embedded(path_of(name, "card.json"));
}

std::vector<BaseFile> base_files(const std::string& name) {
  check_known(name);
  std::string rock(embedded(path_of(name, "rock.toml")));
  const std::string data = data_of(rock);
  rock.replace(rock.find(data), data.size(), "table.csv");
  std::vector<BaseFile> files = {{"rock.toml", rock},
                                 {"table.csv", std::string(embedded(table_path(name, data)))}};
  for (const char* file : {"card.json", "calibrated.toml"})
    if (const std::string path = path_of(name, file); is_embedded(path))
      files.push_back({file, std::string(embedded(path))});
  return files;
}

rock::Start start_like(const std::string& name) {
  const Rock like = base_rock(name);
  const report::CardModel model = report::model_of_card(base_card(name));
  rock::Start start;
  start.layers = model.layers, start.matrix = model.matrix;
  start.size = like.model.specimen;
  if (like.grains_stated) start.grain_size = rounded(grain_size(like.model), 4);
  start.bedded = like.bedded;
  if (like.bedded && !like.model.bedding.empty())
    start.spacing = rounded(like.model.bedding.front().spacing, 4);
  return start;
}

std::optional<Finding> nearest_rock(const std::vector<Target>& table) {
  Finding found{FindingKind::nearest_rock};
  std::vector<std::string> same;
  bool any = false;  // was compared
  for (const Property p : compared) {
    const Curve curve = curve_of(table, p);
    if (curve.size() < fewest_angles) continue;
    const BaseTable* nearest = nullptr;
    double least = farthest;
    for (const BaseTable& other : base_tables()) {
      const Curve base = curve_of(other.targets, p);
      if (base == curve && std::ranges::find(same, other.title) == same.end()) same.push_back(other.title);
      const double d = difference(curve, base);
      any = any || !std::isnan(d);
      if (base != curve && d < least) least = d, nearest = &other;
    }
    if (nearest == nullptr) continue;
    found.cells.push_back({p, nan});
    found.numbers.push_back({"difference", least});
    found.names.insert(found.names.end(), {nearest->title, nearest->name});
  }
  found.numbers.push_back({"farthest", farthest});
  found.names.insert(found.names.end(), same.begin(), same.end());
  return any ? std::optional(found) : std::nullopt;
}

}  // namespace phy::jobs
