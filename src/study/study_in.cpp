#include "study/study_in.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "base/quote.hpp"
#include "io/file.hpp"
#include "io/file_kinds.hpp"
#include "io/regressions.hpp"
#include "io/table.hpp"
#include "io/toml_in.hpp"
#include "records/specimen_record.hpp"
#include "study/direct.hpp"
#include "study/experiment.hpp"

namespace phy::study {
namespace {

using Kind = io::TomlValue::Kind;
constexpr std::size_t max_problems = 20;
constexpr double max_specimens = 1e6;  // more is taken for a typing error
constexpr double max_seed = 4294967295.0;

std::vector<std::string> designs() {
  std::vector<std::string> names;
  for (int d = 0; d < n_designs; ++d) names.emplace_back(to_string(static_cast<Design>(d)));
  return names;
}
Field top(FieldKind kind, const char* key, const char* meaning) { return make_field(kind, "", key, meaning); }
Field vary(FieldKind kind, const char* key, const char* meaning) {
  return make_field(kind, "vary", key, meaning);
}

Fields study_fields() {
  using K = FieldKind;
  return {
      top(K::text, "name", "name of the study; default: the file's name"),
      top(K::text, "recipe", "recipe that the study starts from, counted from the folder of this file"),
      top(K::choice, "solver",
          "dynamic: the recipe's test, in time; direct: E and nu at small strain by the direct elastic "
          "solution")
          .one_of({to_string(Solver::dynamic), to_string(Solver::direct)})
          .by_default("\"dynamic\""),
      top(K::choice, "design", "points to visit").one_of(designs()).by_default("\"one_at_a_time\""),
      top(K::integer, "samples",
          "points (latin_hypercube, sobol), walks of k + 1 points (morris), blocks of k + 2 (saltelli)")
          .within(1, 100000)
          .by_default("64"),
      top(K::integer, "seed", "seed of the sampled designs").within(0, 4e9).by_default("1"),
      top(K::text, "file", "CSV file of points for the list design: a column per key, its unit in brackets"),
      top(K::integers, "packings", "packing seeds, as replicates; default: the recipe's").within(0, max_seed),
      top(K::integers, "bond_seeds", "seeds of bond strengths, as replicates; default: the recipe's")
          .within(0, max_seed),
      top(K::text, "regressions", "TOML file of lines that others found, compared with this study's"),
      vary(K::text, "key", "what varies: \"bedding.k_n\" (all sets) or \"bedding[1].k_n\""),
      vary(K::values, "values", "levels, with units"),
      vary(K::quantities, "times", "levels as multiples of the recipe's value").within(-unbounded, unbounded),
      vary(K::value, "from", "lower end of a range"),
      vary(K::value, "to", "upper end of a range"),
      vary(K::choice, "scale", "how a range is divided").one_of({"linear", "log"}).by_default("\"linear\""),
      make_field(K::value, "set", "\"table.key\"", "a key of the recipe and its value for the whole study"),
      make_field(K::values, "by_angle", "\"test.key\"",
                 "a key of [test] and its values: one for each of test.angles, then one for the intact "
                 "specimen")};
}

/// The recipe key of that name, "bedding.k_n" or "bedding[1].k_n"; field = nullptr if there is none.
RecipeKey find_key(const std::string& path) {
  RecipeKey key;
  const std::string plain = io::without_index(path);
  if (plain != path) {
    const char *begin = path.data() + path.find('[') + 1, *end = path.data() + path.find(']');
    if (std::from_chars(begin, end, key.set).ptr != end || key.set < 0) return {};
  }
  const Field* field = find_field(recipe_fields(), plain);
  // An index is for bedding sets only.
  if (field != nullptr && (key.set < 0 || field->table == "bedding")) key.field = field;
  return key;
}

/// What to do instead where a key must not vary from point to point; empty where it may. Seeds are set for
/// every replicate and angles for every specimen of a point: factors would clash with them.
std::string instead_of_varying(const RecipeKey& key, const Recipe& base) {
  const std::string path = key.field->path();
  if (path == "packing.seed") return "give the seeds as packings = [1, 2, 3], at the top of the study";
  if (path == "matrix.bond_seed") return "give the seeds as bond_seeds = [1, 2, 3], at the top of the study";
  if (path == "bedding.theta" && key.set <= 0 && !base.test.angles.empty())
    return "test.angles of the base recipe turns the bedding: add the angles there";
  return "";
}

/// What to do about a name that is no key of the recipe; test.stop_at without quotes is a table in a table.
std::string hint_of(const std::string& name) {
  const bool is_table = std::any_of(recipe_fields().begin(), recipe_fields().end(),
                                    [&](const Field& f) { return f.table == name; });
  return is_table ? "name the key too, both inside the quotes: \"" + name + ".key\""
                  : io::recipe_key_hint(name);
}

bool is_scalar(const Field& f) { return f.kind != FieldKind::text && f.kind != FieldKind::quantities; }

class Reader {
 public:
  explicit Reader(const std::string& path)
      : path_(path),
        file_(io::read_user_file(path, study_schema().name), path, study_schema()),
        problems_(file_.problems) {}
  Reader(io::TomlValue keys, const std::string& where, const std::optional<Recipe>& base)
      : path_(where),
        file_(std::move(keys), where, study_schema(), {}),
        problems_(file_.problems),
        given_base_(base) {}

  Study read() {
    // The order matters: seeds default to those of the base, [set] changes the base that `times` refers to,
    // and points can be checked when all factors are known.
    study_.name = file_.name();
    read_base();
    study_.solver = static_cast<Solver>(file_.number("solver", 0.0));
    study_.design = static_cast<Design>(file_.number("design", 0.0));
    if (base_ok_) read_set();
    read_numbers();
    read_regressions();
    if (base_ok_) {
      read_vary();
      read_list();
      read_by_angle();
      check_bond_seeds();
      // Points are built from factors: with problems left they would only cause messages about consequences.
      if (problems_.empty()) check_points();
    }
    file_.check();
    return study_;
  }

 private:
  const std::string& path_;
  io::Document file_;
  std::vector<Problem>& problems_;
  Study study_;
  std::optional<Recipe> given_base_;  // not in a file
  bool base_ok_ = false;

  void report_problem(const io::TomlValue& v, const std::string& key, const std::string& expected,
                      const std::string& remedy) {
    file_.report_problem(v, key, expected, remedy);
  }

  void read_base() {
    // Nothing can be checked against a missing base: the rest of the file is still read for its own errors.
    if (file_.text("recipe", "").empty()) {
      if (file_.is_known("recipe"))
        problems_.push_back({path_, "recipe", "", "the recipe that the study starts from",
                             "add recipe = \"press.toml\" (counted from the folder of this file)"});
      return;
    }
    const std::optional<Recipe> base =
        given_base_ ? given_base_ : file_.read_named("recipe", io::read_recipe);
    base_ok_ = base.has_value();
    if (base) study_.base = *base;
  }
  void read_numbers() {
    study_.samples = static_cast<std::int64_t>(file_.number("samples", static_cast<double>(study_.samples)));
    study_.seed = static_cast<std::int64_t>(file_.number("seed", static_cast<double>(study_.seed)));
    study_.packings = seeds("packings", study_.base.packing.seed);
    study_.bond_seeds = seeds("bond_seeds", study_.base.matrix.bond_seed);
    if (const io::TomlValue* v = file_.find("packings"); v != nullptr && !study_.base.packing.file.empty())
      report_problem(*v, "packings", "no seeds with packing.file",
                     "an imported packing has no seed; vary nothing here");
  }
  void read_regressions() {
    if (file_.text("regressions", "").empty()) return;
    if (auto found = file_.read_named("regressions", io::read_regressions))
      study_.regressions = std::move(*found);
  }
  std::vector<std::int64_t> seeds(const char* key, std::int64_t base) const {
    std::vector<std::int64_t> list;
    for (const double seed : file_.list(key)) list.push_back(static_cast<std::int64_t>(seed));
    return list.empty() ? std::vector<std::int64_t>{base} : list;
  }

  /// A key of the recipe that can be set to a number; without a field, and with the problem reported, where
  /// it is none.
  RecipeKey usable(const std::string& name, std::size_t line, const std::string& where) {
    RecipeKey key = find_key(name);
    std::string expected, remedy;
    if (key.field == nullptr)
      expected = "a key of the recipe", remedy = hint_of(name);
    else if (!is_scalar(*key.field))
      expected = "a key with one number, choice or switch", remedy = "give it in the base recipe";
    else if (key.field->table == "bedding" &&
             static_cast<int>(study_.base.bedding.size()) <= std::max(key.set, 0))
      expected = "a bedding set of the base recipe",
      remedy = "the base recipe has " + std::to_string(study_.base.bedding.size());
    if (expected.empty()) return key;
    problems_.push_back({io::at_line(path_, line), where, toml_string(name), expected, remedy});
    return {};
  }
  void read_set() {
    for (const io::TomlValue* table : file_.tables("set"))
      for (std::size_t i = 0; i < table->keys.size(); ++i) {
        const std::string& name = table->keys[i].name;
        const RecipeKey key = usable(name, table->keys[i].line, "set");
        if (key.field == nullptr) continue;
        if (const auto value = value_in(key, table->items[i], "set.\"" + name + "\""))
          key.put(study_.base, *value);
      }
  }

  void read_vary() {
    const std::vector<const io::TomlValue*> tables = file_.tables("vary");
    for (std::size_t i = 0; i < tables.size(); ++i)
      read_factor(*tables[i], "vary[" + std::to_string(i) + "]");
    std::map<std::string, int> count;
    for (const Factor& f : study_.vary)
      if (++count[f.key.path()] == 2)
        problems_.push_back({path_, "vary", f.key.path(), "every key once", "join the two tables"});
  }
  void read_factor(const io::TomlValue& table, const std::string& name) {
    const io::TomlValue* key = table.find("key");
    if (key == nullptr)
      return report_problem(table, name + ".key", "a key of the recipe in quotes",
                            "for example key = \"bedding.k_n\"");
    // An unreadable key has been reported already.
    if (!file_.is_known(name + ".key")) return;
    Factor f;
    f.key = usable(key->text, key->line, name + ".key");
    if (f.key.field == nullptr) return;
    if (const std::string remedy = instead_of_varying(f.key, study_.base); !remedy.empty())
      return report_problem(*key, name + ".key", "a key that varies from point to point", remedy);
    const io::TomlValue *values = table.find("values"), *times = table.find("times"),
                        *from = table.find("from"), *to = table.find("to");
    // Exactly one way of giving levels; from and to belong together.
    const int n_ways = (values != nullptr) + (times != nullptr) + (from != nullptr || to != nullptr);
    if (n_ways != 1 || (from == nullptr) != (to == nullptr))
      return report_problem(table, name, "one of: values; times; from and to",
                            "say once what " + key->text + " takes");
    if (values != nullptr && file_.is_known(name + ".values"))
      f.levels = values_in(f.key, *values, name + ".values");
    if (times != nullptr) read_times(f, *times, name + ".times");
    if (from != nullptr) read_range(f, table, name);
    const bool by_levels = study_.design == Design::one_at_a_time || study_.design == Design::full_factorial;
    // A range has no levels; only designs that sample can take a point of it.
    if (by_levels && f.levels.empty() && from != nullptr && file_.is_known("design"))
      report_problem(*from, name, "values or times with this design",
                     "a range is for latin_hypercube, sobol, morris and saltelli");
    study_.vary.push_back(f);
  }
  /// One value of a key, with the units and the range of the recipe; nothing where it is none, which is
  /// reported.
  std::optional<double> value_in(const RecipeKey& key, const io::TomlValue& v, const std::string& path) {
    double value = 0.0;
    std::string remedy;
    if (io::take_value(*key.field, v, value, remedy)) return value;
    report_problem(v, path, range_text(*key.field), remedy);
    return std::nullopt;
  }
  std::vector<double> values_in(const RecipeKey& key, const io::TomlValue& list, const std::string& path) {
    std::vector<double> values;
    for (const io::TomlValue& v : list.items)
      if (const auto value = value_in(key, v, path)) values.push_back(*value);
    return values;
  }
  void read_times(Factor& f, const io::TomlValue& list, const std::string& name) {
    if (!file_.is_known(name)) return;
    // A multiple of a choice or a switch has no meaning.
    const bool countable = f.key.field->kind == FieldKind::quantity || f.key.field->kind == FieldKind::number;
    if (list.items.empty() || !countable)
      return report_problem(list, name, "a list of factors of a key that is a number",
                            "write [0.5, 1, 2], or use values");
    const double base = f.key.get(study_.base);
    const Field& field = *f.key.field;
    for (const io::TomlValue& v : list.items) {
      const double value = v.number * base;
      if (within_range(field, value))
        f.levels.push_back(value);
      else
        report_problem(v, name, "a factor that keeps " + f.key.path() + " within " + range_text(field), "");
    }
  }
  void read_range(Factor& f, const io::TomlValue& table, const std::string& name) {
    const io::TomlValue *from = table.find("from"), *to = table.find("to");
    if (f.key.field->kind == FieldKind::choice || f.key.field->kind == FieldKind::boolean)
      return report_problem(*from, name, "values for this key", "a range is for numbers");
    const auto low = value_in(f.key, *from, name + ".from"), high = value_in(f.key, *to, name + ".to");
    if (!low || !high) return;
    f.from = *low, f.to = *high;
    if (!(f.from < f.to))
      report_problem(*to, name + ".to", "above from = " + f.key.print(f.from),
                     f.from == f.to ? "give values = [...] for a single one" : "exchange the two");
    f.logarithmic = file_.number(name + ".scale", 0.0) == 1.0;
    if (f.logarithmic && !(f.from > 0.0))
      report_problem(*from, name + ".from", "above 0 on a logarithmic scale", "");
  }

  /// What belongs to an angle whatever the point: how its specimens are loaded.
  void read_by_angle() {
    for (const io::TomlValue* table : file_.tables("by_angle")) {
      if (study_.solver == Solver::direct)
        report_problem(*table, "by_angle", "no [by_angle] with solver = \"direct\"",
                       "a direct solution knows no loading: leave the table out");
      for (std::size_t i = 0; i < table->keys.size(); ++i) {
        const std::string& name = table->keys[i].name;
        const io::TomlValue& list = table->items[i];
        const RecipeKey key = usable(name, table->keys[i].line, "by_angle");
        if (key.field == nullptr) continue;
        const std::string path = "by_angle.\"" + name + "\"";
        if (const auto [expected, remedy] = instead_by_angle(key, list); !expected.empty())
          report_problem(list, path, expected, remedy);
        else
          study_.by_angle.push_back({key, values_in(key, list, path)});
      }
    }
  }
  /// What is expected of a key of [by_angle] and its list, and what to do; empty where all is well.
  std::pair<std::string, std::string> instead_by_angle(const RecipeKey& key,
                                                       const io::TomlValue& list) const {
    const auto is_this = [&](const auto& other) { return other.key.field == key.field; };
    const std::string path = key.path();
    const TestRecipe& test = study_.base.test;
    if (key.field->table != "test" || path == "test.kind" || path == "test.intact")
      return {"a key of [test] other than kind and intact",
              "the specimens of a point differ in their angle and in how they are loaded"};
    if (std::any_of(study_.vary.begin(), study_.vary.end(), is_this))
      return {"a key that does not vary from point to point", "leave it out here, or out of the parameters"};
    if (test.angles.empty()) return {"test.angles in the base recipe", "use [set] for its one specimen"};
    const std::size_t n = single_recipes(study_.base).size();
    if (list.kind == Kind::list && list.items.size() == n) return {};
    return {"a list of " + std::to_string(n) + " values",
            std::string("one for each of test.angles") +
                (test.intact ? ", then one for the intact specimen" : "") +
                (list.kind == Kind::list ? "; these are " + std::to_string(list.items.size()) : "")};
  }
  /// The table of a list design: a header of keys, with units in brackets, then numbers or words.
  void read_list() {
    const std::string name = file_.text("file", "");
    // A table belongs to the list design and to no other.
    if ((study_.design == Design::list) == name.empty()) {
      // If one of the two could not be read, nothing can be said about the pair.
      if (file_.is_known("file") && file_.is_known("design"))
        problems_.push_back(
            {file_.place("file"), "file", "", "a CSV file exactly with design = \"list\"",
             name.empty() ? "add file = \"points.csv\"" : "leave it out, or set design = \"list\""});
      return;
    }
    if (name.empty()) return;
    if (!study_.vary.empty())
      problems_.push_back(
          {path_, "vary", "", "no [[vary]] with design = \"list\"", "the columns name the keys"});
    const std::string where = file_.beside(name);
    const io::Table table = io::parse_table(io::read_file(where, largest_table), where);
    problems_.insert(problems_.end(), table.problems.begin(), table.problems.end());
    const std::vector<std::string> units = read_header(table, where);
    for (const io::TableRow& row : table.rows)
      // A wrong unit in a header is wrong in every row.
      if (problems_.size() < max_problems) read_row(row, units, where);
  }
  std::vector<std::string> read_header(const io::Table& table, const std::string& file) {
    std::vector<std::string> units;
    for (const std::string& cell : table.header) {
      // "bedding.k_n [GPa/m]": the unit follows the last bracket, as a key may have an index of its own.
      const std::size_t open = cell.rfind(" [");
      Factor f;
      const std::string key = cell.substr(0, open);
      f.key = find_key(key);
      const bool ok = f.key.field != nullptr && is_scalar(*f.key.field) &&
                      (f.key.field->table != "bedding" ||
                       static_cast<int>(study_.base.bedding.size()) > std::max(f.key.set, 0));
      if (!ok)
        problems_.push_back({file + ":" + std::to_string(table.header_line), "column", cell,
                             "a key of the base recipe", io::recipe_key_hint(key)});
      else if (const std::string remedy = instead_of_varying(f.key, study_.base); !remedy.empty())
        problems_.push_back({file + ":" + std::to_string(table.header_line), "column", cell,
                             "a key that varies from point to point", remedy});
      units.push_back(open == cell.npos ? "" : cell.substr(open + 2, cell.size() - open - 3));
      study_.vary.push_back(f);
    }
    return units;
  }
  void read_row(const io::TableRow& row, const std::vector<std::string>& units, const std::string& file) {
    std::vector<double> values;
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      const RecipeKey& key = study_.vary[k].key;
      // The column was reported with the header; every row would repeat it.
      if (key.field == nullptr) return;
      double value = 0.0;
      std::string remedy;
      if (!io::take_value(*key.field, cell_value(*key.field, row.cells[k], units[k]), value, remedy))
        problems_.push_back({file + ":" + std::to_string(row.line), key.path(), row.cells[k],
                             range_text(*key.field), remedy});
      values.push_back(value);
    }
    study_.rows.push_back(values);
  }
  /// A cell as if it stood in TOML, so that units, ranges and messages are those of take_value(): a quantity
  /// becomes text with its unit, a bare number an integer or a float.
  static io::TomlValue cell_value(const Field& f, const std::string& cell, const std::string& unit) {
    io::TomlValue v;
    v.kind = Kind::text, v.text = cell;
    if (f.kind == FieldKind::choice) return v;
    if (f.kind == FieldKind::boolean) {
      if (cell == "true" || cell == "false") v.kind = Kind::boolean, v.number = cell == "true" ? 1.0 : 0.0;
    } else if (f.dimension != Dimension::none) {
      if (!unit.empty()) v.text += " " + unit;
    } else if (const Quantity q = parse_quantity(cell, Dimension::none); q.ok) {
      v.kind = q.value == std::floor(q.value) ? Kind::integer : Kind::number, v.number = q.value;
    }
    return v;
  }

  /// Of the design, before it is made: a design of a billion points would not fit into memory.
  double n_points() const {
    const double samples = static_cast<double>(study_.samples), k = static_cast<double>(study_.vary.size());
    double product = 1.0;
    for (const Factor& f : study_.vary) product *= static_cast<double>(f.levels.size());
    switch (study_.design) {
      case Design::full_factorial: return product;
      case Design::morris: return samples * (k + 1.0);
      case Design::saltelli: return samples * (k + 2.0);
      case Design::one_at_a_time:
      case Design::list: return 1.0;  // no more than the file has lines
      case Design::latin_hypercube:
      case Design::sobol: return samples;
    }
    return samples;
  }

  /// Without breakage the seed of the bonds counts only where it says which contacts are joints, or have no
  /// bond.
  void check_bond_seeds() {
    const io::TomlValue* v = file_.find("bond_seeds");
    if (v == nullptr || study_.bond_seeds.size() < 2 || study_.solver != Solver::direct) return;
    bool drawn = moduli_are_drawn(study_.base);
    for (const Factor& f : study_.vary)
      // A base without any of these may still get them from a factor.
      for (const char* key : {"bedding.persistence", "bedding.spacing_sd", "bedding.theta_sd",
                              "matrix.unbonded_fraction", "matrix.gapped_fraction"})
        drawn = drawn || (f.key.field != nullptr && f.key.field->path() == key);
    if (!drawn)
      report_problem(*v, "bond_seeds", "one seed with solver = \"direct\"",
                     "nothing breaks there, and neither joints nor missing bonds are drawn: leave it out");
  }

  std::string place_of(const Point& point) const {
    const std::string at = describe(study_, point);
    return path_ + (at.empty() ? "" : " at " + at);
  }
  /// Those of the recipe of a point, then, where its specimens have values of their own, those of each.
  std::vector<Problem> problems_at(const Point& point) const {
    const Recipe r = recipe_at(study_, point, study_.packings.front(), study_.bond_seeds.front());
    std::vector<Problem> all = cross_checks(r, [&](const std::string&) { return place_of(point); });
    if (study_.by_angle.empty() || !all.empty()) return all;
    const std::vector<Recipe> specimens = specimens_of(study_, r);
    const std::vector<std::string> names = specimen_names(r);
    for (std::size_t i = 0; i < specimens.size(); ++i)
      for (Problem& p :
           cross_checks(specimens[i], [&](const std::string&) { return place_of(point) + ", " + names[i]; }))
        all.push_back(std::move(p));
    return all;
  }

  void check_points() {
    const std::size_t angles = std::max<std::size_t>(1, study_.base.test.angles.size());
    const double replicates = static_cast<double>(study_.packings.size() * study_.bond_seeds.size());
    if (n_points() * replicates * static_cast<double>(angles) > max_specimens) {
      problems_.push_back(
          {path_, "vary", "", "at most a million specimens", "use fewer levels, samples or packings"});
      return;
    }
    // Each point must be a valid recipe by itself; the first replicate stands for all.
    for (const Point& point : points_of(study_)) {
      for (Problem& p : problems_at(point)) problems_.push_back(std::move(p));
      // One slip usually affects all points: enough to see what is wrong.
      if (problems_.size() >= max_problems) return;
    }
  }
};

}  // namespace

const io::Schema& study_schema() {
  static const Fields fields = study_fields();
  static const io::Schema schema{"study",
                                 "study",
                                 fields,
                                 {{"vary", 100}},
                                 "a key of the recipe belongs into a [[vary]] table, or into [set]"};
  return schema;
}

Study read_study(const std::string& path) { return Reader(path).read(); }

Study study_of(io::TomlValue keys, const std::string& where, const std::optional<Recipe>& base) {
  return Reader(std::move(keys), where, base).read();
}

}  // namespace phy::study
