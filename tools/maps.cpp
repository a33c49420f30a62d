// What each family of models reaches: runs the tests of data/maps and writes its tables (`make maps`).
//
//   maps FOLDER STORE [FAMILY ...]
//
// Layered families: every point of the Sobol sequence on one packing, five packings in turn, UCS at seven
// inclinations, Brazilian strength at three. Isotropic ones: every point on five packings of two densities,
// UCS, direct tension, Brazilian strength and two confined strengths; and their base recipe in grains of five
// sizes, UCS and tension. Finished tests stay in STORE. Columns that a table in FOLDER has already are kept:
// to have some anew, take them out of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <thread>

#include "analysis/analyse.hpp"
#include "base/check.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/strength_tests.hpp"
#include "io/file.hpp"
#include "io/table.hpp"
#include "lab/brazilian/reading.hpp"
#include "maps/mapped_model.hpp"
#include "study/design.hpp"

namespace phy {
namespace {

using maps::MappedModel;
using maps::MapVariable;

constexpr std::int64_t first_packing = 401, n_packings = 5;
constexpr std::int64_t loose_grains = 1227;   // porosity 0.15
constexpr double quicker = 2.0;               // than the tests of a verification
constexpr double confinement[] = {0.1, 0.3};  // of the UCS that is expected

/// One test, and the columns that it fills.
struct Column {
  std::string name;
  double (*of)(const Recipe&, const TestResult&);
};
struct MapTest {
  std::optional<Recipe> recipe;  ///< none where the table has its columns already
  std::vector<Column> columns;
};
struct MapRow {
  std::int64_t point, packing, n_grains;
  std::vector<double> variables;
  std::vector<MapTest> tests;
};

std::string cell(double v) { return std::isfinite(v) ? fmt::format(",{:.4g}", v) : ","; }

/// What a row begins with: point, packing, grains and variables. A point whose variables are others is
/// another.
std::string head_of(const MapRow& row) {
  std::string text = fmt::format("{},{},{}", row.point + 1, row.packing, row.n_grains);
  for (const double v : row.variables) text += cell(v);
  return text;
}

/// The table as it is: the text of its cells, by the heads of rows and the names of columns.
class Before {
 public:
  Before(const std::string& file, std::size_t n_levers) {
    if (!std::filesystem::exists(file)) return;
    const io::Table table = io::parse_table(io::read_file(file), file);
    for (const io::TableRow& row : table.rows) {
      const auto levers_end = row.cells.begin() + static_cast<std::ptrdiff_t>(3 + n_levers);
      auto& cells = cells_[fmt::format("{}", fmt::join(row.cells.begin(), levers_end, ","))];
      for (std::size_t i = 0; i < table.header.size(); ++i) cells[table.header[i]] = row.cells[i];
    }
  }
  bool has(const MapRow& row, const std::vector<Column>& columns) const {
    const auto at = cells_.find(head_of(row));
    return at != cells_.end() && std::all_of(columns.begin(), columns.end(),
                                             [&](const Column& c) { return at->second.contains(c.name); });
  }
  std::string cell_of(const MapRow& row, const Column& column) const {
    return cells_.at(head_of(row)).at(column.name);
  }

 private:
  std::map<std::string, std::map<std::string, std::string>> cells_;
};

double number(const TestResult& r, const std::string& name) {
  const Number* n = has_strength(r.outcome.status) ? analysis::find(r.numbers, name) : nullptr;
  return n != nullptr ? n->value : std::nan("");
}
template <const char* const& name>
double over_sigma_c(const Recipe& r, const TestResult& t) {
  return number(t, name) / r.matrix.sigma_c;
}
constexpr const char* ucs = "ucs";
constexpr const char* bts = "bts";
constexpr const char* dts = "sigma_t";
constexpr const char* q_max = "q_max";

double broken_share(const Recipe& r, const TestResult& t) {
  double n = 0.0;
  for (const char* kind : {"tension_matrix", "shear_matrix", "tension_bedding", "shear_bedding"})
    n += number(t, fmt::format("cracks_{}_at_peak", kind));
  const double elements =
      r.matrix.model == MatrixModel::flat_joint ? static_cast<double>(r.matrix.elements) : 1.0;
  return n / elements / static_cast<double>(t.n_contacts);
}
/// 1: the first crack lies in the central third of the disc.
double is_central(const Recipe&, const TestResult& t) {
  const double x = number(t, "first_crack_x"), y = number(t, "first_crack_y");
  return std::isfinite(x) ? std::fmax(std::fabs(x), std::fabs(y)) <= lab::central_third : std::nan("");
}
double E_small(const Recipe& r, const TestResult& t) { return number(t, "E_small") / r.matrix.E_c; }

std::vector<Column> compression_columns(const std::string& at) {
  return {{"E_small/E_c" + at, E_small},
          {"E50/E_c" + at,
           [](const Recipe& r, const TestResult& t) { return number(t, "E_tangent") / r.matrix.E_c; }},
          {"nu50" + at, [](const Recipe&, const TestResult& t) { return number(t, "nu"); }},
          {"UCS/sigma_c" + at, over_sigma_c<ucs>},
          {"sigma_ci/UCS" + at,
           [](const Recipe&, const TestResult& t) { return number(t, "sigma_ci") / number(t, "ucs"); }},
          {"broken" + at, broken_share}};
}
std::vector<Column> disc_columns(const std::string& at) {
  return {{"BTS/sigma_c" + at, over_sigma_c<bts>}, {"central" + at, is_central}};
}

/// UCS that a recipe may have [Pa], for the speed of the platens: of the matrix, or of its planes.
double expected_ucs(const Recipe& r, double theta) {
  const MatrixRecipe& m = r.matrix;
  const double ratio = m.tau_c / m.sigma_c;
  const double sound = m.model == MatrixModel::flat_joint
                           ? 1.4 * m.sigma_c * std::pow(ratio, 0.85)
                           : 2.2 * m.sigma_c * std::sqrt(std::fmin(ratio, 2.0));
  const bool oblique = !r.bedding.empty() && theta > 15.0 && theta < 80.0;
  if (!oblique) return sound;
  const BeddingRecipe& b = r.bedding[0];
  return std::fmin(sound, std::lerp(sound, 4.0 * b.cohesion, b.persistence));
}

std::vector<Target> expected(const Recipe& r, bool layered) {
  std::vector<Target> list;
  for (const double theta : maps::mapped_angles)
    if (layered || theta == 0.0) list.push_back({Property::ucs, theta, expected_ucs(r, theta), 1.0, 1, true});
  if (!layered) list.push_back({Property::direct_tension, 0.0, 0.6 * r.matrix.sigma_c, 1.0, 1, true});
  for (const double theta : maps::mapped_disc_angles)
    if (layered || theta == 0.0)
      list.push_back({Property::brazilian, theta, 0.6 * r.matrix.sigma_c, 1.0, 1, true});
  return list;
}

std::vector<Column> columns_of(const Target& t, bool layered) {
  const std::string at = layered ? fmt::format("({:g})", t.theta) : "";
  if (t.property == Property::ucs) return compression_columns(at);
  if (t.property == Property::brazilian) return disc_columns(at);
  return {{"DTS/sigma_c" + at, over_sigma_c<dts>}, {"E_t/E_c" + at, E_small}};
}

/// The test of one strength, of compression at a speed at which a wave crosses the specimen fifty times until
/// its own peak, of tension a hundred times. `modulus`: of the point at that inclination.
Recipe test_of(const Recipe& point, const Target& target, std::int64_t packing, double modulus) {
  const std::vector<Target> alone = {target};
  const bool compression = target.property == Property::ucs;
  const Recipe ready = compression ? calibrate::test_settings(point, alone, {modulus})
                                   : calibrate::test_settings(point, {}, std::vector<double>());
  Recipe r = calibrate::StrengthTests(ready, alone, {modulus}).of(ready, 0, packing, calibrate::from_rest);
  if (compression) r.test.platen_speed *= quicker;
  return r;
}

std::vector<Column> confined_columns(std::size_t i) {
  return {{fmt::format("sigma_3/sigma_c #{}", i + 1),
           [](const Recipe& r, const TestResult&) { return r.test.confining_stress / r.matrix.sigma_c; }},
          {fmt::format("q/sigma_c #{}", i + 1), over_sigma_c<q_max>}};
}

/// Whether the test of a target is run: the row lacks its columns, or those of the confined tests that go
/// with UCS.
bool is_wanted(const Target& t, bool layered, bool confined, const MapRow& row, const Before& before) {
  std::vector<Column> columns = columns_of(t, layered);
  for (std::size_t i = 0; i < std::size(confinement) && !layered && confined && t.property == Property::ucs;
       ++i)
    for (const Column& c : confined_columns(i)) columns.push_back(c);
  return !before.has(row, columns);
}

/// `moduli`: of the targets that are wanted.
std::vector<MapTest> tests_of(const Recipe& point, bool layered, bool confined, const MapRow& row,
                              const std::vector<double>& moduli, const Before& before) {
  std::vector<MapTest> tests;
  auto modulus = moduli.begin();
  for (const Target& t : expected(point, layered)) {
    tests.push_back({{}, columns_of(t, layered)});
    if (is_wanted(t, layered, confined, row, before))
      tests.back().recipe = test_of(point, t, row.packing, *modulus++);
  }
  for (std::size_t i = 0; i < std::size(confinement) && !layered && confined; ++i) {
    MapTest t{tests.front().recipe, confined_columns(i)};  // wanted with those of UCS
    if (t.recipe) {
      t.recipe->test.kind = TestKind("biaxial");
      t.recipe->test.confining_stress = confinement[i] * expected_ucs(point, 0.0);
    }
    tests.push_back(t);
  }
  return tests;
}

struct Place {
  std::int64_t number;
  bool at_base;
  std::vector<double> variables;
};

/// The sequence over all variables, then the one over those that do not stay at the base.
std::vector<Place> places_of(const MappedModel& family) {
  std::vector<Place> places;
  for (const bool at_base : {false, true}) {
    const auto moves = [&](const MapVariable& l) { return !(at_base && l.at_base); };
    const auto d =
        static_cast<std::size_t>(std::count_if(family.variables.begin(), family.variables.end(), moves));
    const int n = at_base ? family.n_at_base : family.n_points;
    for (const auto& u : study::sobol_sequence(d, static_cast<std::size_t>(n))) {
      Place place{static_cast<std::int64_t>(places.size()), at_base, {}};
      auto next = u.begin();
      for (const MapVariable& l : family.variables)
        place.variables.push_back(moves(l) ? l.from_normalised(2.0 * *next++ - 1.0) : l.get(family.base));
      places.push_back(place);
    }
  }
  return places;
}

/// A row without its tests, and the recipe of its point.
struct Begun {
  MapRow row;
  Recipe recipe;
  bool confined;
};

std::vector<Begun> begin_map(const MappedModel& family) {
  std::vector<Begun> begun;
  for (const Place& place : places_of(family)) {
    Recipe r = family.base;
    for (std::size_t i = 0; i < family.variables.size(); ++i) family.variables[i].set(r, place.variables[i]);
    for (std::int64_t k = 0; k < (family.layered() ? 1 : 2 * n_packings); ++k) {
      const std::int64_t packing = first_packing + (family.layered() ? place.number : k) % n_packings;
      if (k >= n_packings) r.packing.n_grains = loose_grains;
      begun.push_back({{place.number, packing, r.packing.n_grains, place.variables, {}}, r, !place.at_base});
    }
  }
  return begun;
}

/// The base recipe of a family in grains of other sizes, the same specimen and porosity.
std::vector<Begun> begin_sizes(const MappedModel& family) {
  std::vector<Begun> begun;
  for (const std::int64_t n : {330, 660, 1321, 2642, 5284}) {
    Recipe r = family.base;
    const double size = std::sqrt(static_cast<double>(r.packing.n_grains) / static_cast<double>(n));
    r.packing.n_grains = n, r.packing.radius_min *= size, r.packing.radius_max *= size;
    for (std::int64_t k = 0; k < n_packings; ++k)
      begun.push_back({{0, first_packing + k, n, {}, {}}, r, false});
  }
  return begun;
}

/// All solutions of all rows together.
std::vector<MapRow> rows_of(const MappedModel& family, std::vector<Begun> begun, const Before& before,
                            calibrate::Simulator& simulator) {
  const auto wanted = [&](const Begun& b) {
    std::vector<Target> targets = expected(b.recipe, family.layered());
    std::erase_if(
        targets, [&](const Target& t) { return !is_wanted(t, family.layered(), b.confined, b.row, before); });
    return targets;
  };
  std::vector<Recipe> specimens;
  for (const Begun& b : begun)
    for (const Target& t : wanted(b))
      specimens.push_back(calibrate::single_at(b.recipe, t.theta, b.row.packing));
  const std::vector<ElasticResult> solved = simulator.elastic(specimens, calibrate::Statics::two_sided);
  std::vector<MapRow> rows;
  auto next = solved.begin();
  for (Begun& b : begun) {
    std::vector<double> moduli;
    for (std::size_t n = wanted(b).size(); n > 0; --n) moduli.push_back(next++->E_gauge);
    b.row.tests = tests_of(b.recipe, family.layered(), b.confined, b.row, moduli, before);
    rows.push_back(std::move(b.row));
  }
  return rows;
}

/// Rows of the second sequence have no confined tests, which come last.
std::string table_of(const MappedModel& family, const std::vector<MapRow>& rows,
                     const std::vector<TestResult>& results, const Before& before) {
  std::string text = "point,packing,n_grains";
  for (const MapVariable& l : family.variables) text += fmt::format(",{}", l.name);
  std::size_t n_columns = 0, next = 0;
  for (const MapTest& t : rows.front().tests)
    for (const Column& c : t.columns) text += "," + c.name, ++n_columns;
  text += "\n";
  for (const MapRow& row : rows) {
    text += head_of(row);
    std::size_t n = 0;
    for (const MapTest& t : row.tests) {
      for (const Column& c : t.columns)
        text += t.recipe ? cell(c.of(*t.recipe, results[next])) : "," + before.cell_of(row, c), ++n;
      next += t.recipe ? 1 : 0;
    }
    text += std::string(n_columns - n, ',') + "\n";
  }
  return text;
}

void make_table(const MappedModel& family, const std::vector<Begun>& begun, const std::string& folder,
                calibrate::Simulator& simulator) {
  std::printf("%s: preparing\n", family.name);
  std::fflush(stdout);
  const std::string file = fmt::format("{}/{}.csv", folder, family.name);
  const Before before(file, family.variables.size());
  const std::vector<MapRow> rows = rows_of(family, begun, before, simulator);
  std::vector<Recipe> recipes;
  for (const MapRow& row : rows)
    for (const MapTest& t : row.tests)
      if (t.recipe) recipes.push_back(*t.recipe);
  std::printf("%s: %zu tests\n", family.name, recipes.size());
  std::fflush(stdout);
  const std::vector<TestResult> results = simulator.test(recipes);
  io::write_file(file, table_of(family, rows, results, before));
}

/// The map of a family and, without layers, its base in grains of other sizes.
void make_tables(const MappedModel& family, const std::string& folder, calibrate::Simulator& simulator) {
  make_table(family, begin_map(family), folder, simulator);
  if (family.layered()) return;
  const std::string name = fmt::format("{}-sizes", family.name);
  MappedModel sized = family;
  sized.name = name.c_str(), sized.variables.clear();
  make_table(sized, begin_sizes(family), folder, simulator);
}

}  // namespace
}  // namespace phy

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: maps FOLDER STORE [FAMILY ...]\n"), 2;
  const std::vector<std::string> names(argv + 3, argv + argc);
  const auto simulator = phy::calibrate::make_simulator(
      {static_cast<int>(std::thread::hardware_concurrency()), argv[2], nullptr, nullptr});
  for (const phy::maps::MappedModel& f : phy::maps::mapped_models())
    if (names.empty() || std::find(names.begin(), names.end(), f.name) != names.end())
      phy::make_tables(f, argv[1], *simulator);
}
