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
// Those measured most often at several angles: a neighbour by a rare property would be one of few candidates.
constexpr Property compared[] = {Property::ucs, Property::E, Property::brazilian};

std::string path_of(const std::string& name, const char* file) { return folder + name + "/" + file; }

void check_known(const std::string& name) {
  const std::vector<std::string> names = base_rocks();
  if (std::ranges::find(names, name) != names.end()) return;
  std::vector<std::string> meant;  // whoever types "gneiss" means one of several
  std::ranges::copy_if(names, std::back_inserter(meant),
                       [&](const std::string& n) { return n.find(name) != n.npos; });
  if (const std::string near = nearest(name, names); meant.empty() && !near.empty()) meant = {near};
  throw InputError(Problem{"measured rocks", "name", name, "a measured rock",
                           meant.empty() ? "phyllite rocks lists them"
                                         : fmt::format("did you mean {}?", fmt::join(meant, " or "))});
}

bool is_embedded(const std::string& path) {
  const auto files = embedded_below(path);
  return std::ranges::find(files, path) != files.end();
}

/// The name of the table in a rock file, `"../dyn_th26.csv"`, without its quotes.
// By hand and not by the parser, since the copy has to replace exactly these letters.
std::string data_of(std::string_view rock) {
  constexpr std::string_view key = "\ndata = \"";
  const std::size_t begin = rock.find(key) + key.size();
  return std::string(rock.substr(begin, rock.find('"', begin) - begin));
}

/// Where the table lies that a rock file names.
std::string table_path(const std::string& name, const std::string& data) {
  // Embedded files have names, no folders: ".." must be resolved before the look-up.
  return std::filesystem::path(path_of(name, data.c_str())).lexically_normal().generic_string();
}

using Curve = std::map<double, double>;  // by angle

/// One value per angle, those without confinement or under the least one.
Curve curve_of(const std::vector<Target>& table, Property property) {
  Curve curve;
  for (const Target& t : least_confined(table))
    // Strength rises with confinement too steeply to be compared; E may be measured under a small one.
    if (t.property == property && (property == Property::E || t.confining == 0.0))
      curve.emplace(t.theta, t.mean);
  return curve;
}

/// On the straight line between the neighbours; NaN outside.
double at(const Curve& curve, double theta) {
  const auto above = curve.lower_bound(theta);
  // No extrapolation: beyond its last angle a curve may turn.
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
  // Only the base is interpolated: the table's own angles are what the user knows.
  for (const auto& [theta, value] : table)
    if (const double other = at(base, theta); !std::isnan(other)) {
      both.emplace_back(value, other);
      of_table += value, of_base += other;
    }
  if (both.size() < fewest_angles) return nan;
  const auto n = static_cast<double>(both.size());
  double sum = 0.0;
  // Each over its mean: the shape over the angle is compared, as strength itself scales with the parameters.
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
    if (path.ends_with("/card.json"))  // a rock that was never run has none
      names.push_back(std::filesystem::path(path).parent_path().filename().string());
  return names;
}

Rock base_rock(const std::string& name) {
  check_known(name);
  const std::string path = path_of(name, "rock.toml");
  const std::string_view text = embedded(path);
  // No folder to read the table from: it is handed over as text.
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
  // In the copy both lie in one folder, whatever path the table has in the source tree.
  rock.replace(rock.find(data), data.size(), "table.csv");
  std::vector<BaseFile> files = {{"rock.toml", rock},
                                 {"table.csv", std::string(embedded(table_path(name, data)))}};
  for (const char* file : {"card.json", "calibrated.toml", "model.toml"})
    if (const std::string path = path_of(name, file); is_embedded(path))
      files.push_back({file, std::string(embedded(path))});
  return files;
}

rock::Start start_like(const std::string& name) {
  const Rock like = base_rock(name);
  const report::CardModel model = report::model_of_card(base_card(name));
  rock::Start start;
  start.layers = model.layers, start.matrix = model.matrix;
  // The template has tangent_50 anyhow; a table without E says nothing of its reading.
  if (!of_property(targets_of(like), Property::E).empty() && like.E_is != ModulusReading::tangent_50)
    start.E_is = to_string(like.E_is);
  start.size = like.model.specimen;
  // A grain size that nobody measured is a guess of the program, not a property to pass on.
  if (like.grains_stated) start.grain_size = rounded(grain_size(like.model), 4);
  start.bedded = like.bedded;
  if (like.bedded && !like.model.bedding.empty())
    // Four digits: more would come from the conversion of units alone.
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
      // Users try the program with its own tables: "nearest is itself" would tell them nothing.
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
  // Also without a neighbour: that all are farther than this is an answer.
  found.numbers.push_back({"farthest", farthest});
  found.names.insert(found.names.end(), same.begin(), same.end());
  // Where no curve could be compared, "none is near" would be untrue.
  return any ? std::optional(found) : std::nullopt;
}

}  // namespace phy::jobs
