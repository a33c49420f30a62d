#include "study/study_in.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "base/spelling.hpp"
#include "io/file.hpp"
#include "io/table.hpp"
#include "io/toml_in.hpp"
#include "io/toml_tree.hpp"
#include "study/experiment.hpp"

namespace phy::study {
namespace {

using Kind = io::TomlValue::Kind;
constexpr std::size_t max_told = 20;
constexpr double max_specimens = 1e6;  // a slip of the pen, not a study

/// The recipe key of that name, "bedding.k_n" or "bedding[1].k_n"; field = nullptr if there is none.
RecipeKey find_key(const std::string& path) {
  RecipeKey key;
  std::string plain = path;
  if (const std::size_t open = path.find('['), close = path.find(']'); open < close && close != path.npos) {
    key.set = std::atoi(path.c_str() + open + 1);
    plain.erase(open, close - open + 1);
  }
  for (const Field& f : recipe_fields())
    if (f.path() == plain && (key.set < 0 || f.table == "bedding")) key.field = &f;
  return key;
}

std::string key_hint(const std::string& path) {
  std::vector<std::string> known;
  for (const Field& f : recipe_fields()) known.push_back(f.path());
  const std::string near = nearest(path, known);
  return near.empty() ? "`phyllite recipe --reference` lists all keys" : "did you mean \"" + near + "\"?";
}

/// A value of any key that travels as a number.
bool take_any(const Field& f, const io::TomlValue& v, double& value, std::string& remedy) {
  if (f.kind == FieldKind::boolean) return value = v.number, v.kind == Kind::boolean;
  if (f.kind != FieldKind::choice) return io::take_value(f, v, value, remedy);
  const auto it = std::find(f.choices.begin(), f.choices.end(), v.text);
  value = static_cast<double>(it - f.choices.begin());
  return v.kind == Kind::text && it != f.choices.end();
}

/// Why a key must not vary from point to point, as what to do instead; empty: it may.
std::string instead_of_varying(const RecipeKey& key, const Recipe& base) {
  const std::string path = key.field->path();
  if (path == "packing.seed") return "give the seeds as packings = [1, 2, 3], at the top of the study";
  if (path == "matrix.bond_seed") return "give the seeds as bond_seeds = [1, 2, 3], at the top of the study";
  if (path == "bedding.theta" && key.set <= 0 && !base.test.angles.empty())
    return "test.angles of the base recipe turns the bedding: add the angles there";
  return "";
}

bool is_scalar(const Field& f) { return f.kind != FieldKind::text && f.kind != FieldKind::quantities; }

class Reader {
 public:
  Reader(const std::string& path, std::vector<Problem> so_far, const io::TomlValue& root)
      : problems(std::move(so_far)), path_(path), root_(root) {}

  Study read() {
    check_keys(root_, "", "");
    study_.name = text("name", std::filesystem::path(path_).stem().string());
    if (root_.find("name") == nullptr && !is_plain(study_.name))
      problems.push_back({path_, "name", study_.name, "a name in UTF-8 without control characters",
                          "the file has none: write name = \"...\""});
    read_base();
    read_design();
    if (base_ok_) read_set();
    read_numbers();
    if (base_ok_) {
      read_vary();
      read_list();
      if (problems.empty()) check_points();
    }
    return study_;
  }
  std::vector<Problem> problems;

 private:
  std::string path_;
  const io::TomlValue& root_;
  Study study_;
  bool base_ok_ = false;

  std::string at(std::size_t line) const { return path_ + ":" + std::to_string(line); }
  void tell(const io::TomlValue& v, const std::string& key, const std::string& expected,
            const std::string& remedy) {
    problems.push_back({at(v.line), key, io::as_written(v), expected, remedy});
  }
  std::string beside(const std::string& name) const {
    return (std::filesystem::path(path_).parent_path() / name).string();
  }
  static std::string expected_of(const std::string& table, const std::string& key) {
    for (const StudyKey& k : study_keys())
      if (k.table == table && k.key == key) return k.expected;
    return "";
  }

  void check_keys(const io::TomlValue& table, const std::string& name, const std::string& prefix) {
    for (const io::TomlValue::Key& key : table.keys) {
      std::vector<std::string> known;
      for (const StudyKey& k : study_keys()) {
        if (k.table == name) known.push_back(k.key);
        if (name.empty() && !k.table.empty()) known.push_back(k.table);
      }
      if (std::find(known.begin(), known.end(), key.name) != known.end()) continue;
      const std::string near = nearest(key.name, known);
      std::string remedy =
          near.empty() ? "`phyllite study --reference` lists all keys" : "did you mean \"" + near + "\"?";
      const bool of_recipe = std::any_of(recipe_fields().begin(), recipe_fields().end(), [&](const Field& f) {
        return f.key == key.name || f.table == key.name;
      });
      if (name.empty() && of_recipe)
        remedy = "a key of the recipe belongs into a [[vary]] table, or into [set]";
      problems.push_back({at(key.line), prefix + key.name, "", "a known key", remedy});
    }
  }

  std::string text(const char* key, const std::string& otherwise) {
    const io::TomlValue* v = root_.find(key);
    if (v == nullptr) return otherwise;
    if (v->kind == Kind::text) return v->text;
    tell(*v, key, "text in quotes", "");
    return otherwise;
  }
  void read_base() {
    const std::string name = text("recipe", "");
    if (name.empty()) {
      if (root_.find("recipe") == nullptr)
        problems.push_back({path_, "recipe", "", "the recipe that the study starts from",
                            "add recipe = \"press.toml\" (counted from the folder of this file)"});
      return;
    }
    try {
      study_.base = io::read_recipe(beside(name));
      base_ok_ = true;
    } catch (const InputError& e) {
      problems.insert(problems.end(), e.problems().begin(), e.problems().end());
    } catch (const IoError& e) {
      tell(*root_.find("recipe"), "recipe", "a file that can be read", e.what());
    }
  }
  void read_design() {
    const io::TomlValue* v = root_.find("design");
    if (v == nullptr) return;
    for (int d = 0; d < n_designs; ++d)
      if (v->kind == Kind::text && v->text == to_string(static_cast<Design>(d)))
        return void(study_.design = static_cast<Design>(d));
    std::vector<std::string> names;
    for (int d = 0; d < n_designs; ++d) names.emplace_back(to_string(static_cast<Design>(d)));
    const std::string near = nearest(v->text, names);
    tell(*v, "design", expected_of("", "design"), near.empty() ? "" : "did you mean \"" + near + "\"?");
  }

  bool whole(const io::TomlValue& v, double least, double most) const {
    return v.kind == Kind::integer && v.number >= least && v.number <= most;
  }
  void read_numbers() {
    if (const io::TomlValue* v = root_.find("samples"))
      whole(*v, 1, 100000) ? void(study_.samples = static_cast<std::int64_t>(v->number))
                           : tell(*v, "samples", expected_of("", "samples"), "");
    if (const io::TomlValue* v = root_.find("seed"))
      whole(*v, 0, 4e9) ? void(study_.seed = static_cast<std::int64_t>(v->number))
                        : tell(*v, "seed", expected_of("", "seed"), "");
    study_.packings = seeds("packings", study_.base.packing.seed);
    study_.bond_seeds = seeds("bond_seeds", study_.base.matrix.bond_seed);
    if (const io::TomlValue* v = root_.find("packings"); v != nullptr && !study_.base.packing.file.empty())
      tell(*v, "packings", "no seeds with packing.file",
           "an imported packing has no seed; vary nothing here");
  }
  std::vector<std::int64_t> seeds(const char* key, std::int64_t base) {
    const io::TomlValue* v = root_.find(key);
    if (v == nullptr) return {base};
    std::vector<std::int64_t> list;
    bool ok = v->kind == Kind::list && !v->items.empty();
    for (const io::TomlValue& item : v->items) {
      ok = ok && whole(item, 0, 4294967295.0);
      const auto seed = static_cast<std::int64_t>(ok ? item.number : 0.0);
      ok = ok && std::find(list.begin(), list.end(), seed) == list.end();
      list.push_back(seed);
    }
    if (!ok) tell(*v, key, expected_of("", key), "for example " + std::string(key) + " = [1, 2, 3]");
    return list;
  }

  /// A key of the recipe that can be set to a number, or nothing with the problem told.
  RecipeKey usable(const std::string& name, std::size_t line, const std::string& where) {
    RecipeKey key = find_key(name);
    std::string expected, remedy;
    if (key.field == nullptr)
      expected = "a key of the recipe", remedy = key_hint(name);
    else if (!is_scalar(*key.field))
      expected = "a key with one number, choice or switch", remedy = "give it in the base recipe";
    else if (key.field->table == "bedding" &&
             static_cast<int>(study_.base.bedding.size()) <= std::max(key.set, 0))
      expected = "a bedding set of the base recipe",
      remedy = "the base recipe has " + std::to_string(study_.base.bedding.size());
    if (expected.empty()) return key;
    problems.push_back({at(line), where, "\"" + name + "\"", expected, remedy});
    return {};
  }
  void read_set() {
    const io::TomlValue* table = root_.find("set");
    if (table == nullptr) return;
    if (table->kind != Kind::table) return tell(*table, "set", "a table", "write [set] on a line of its own");
    for (std::size_t i = 0; i < table->keys.size(); ++i) {
      const std::string& name = table->keys[i].name;
      const RecipeKey key = usable(name, table->keys[i].line, "set");
      double value = 0.0;
      std::string remedy;
      if (key.field == nullptr) continue;
      if (take_any(*key.field, table->items[i], value, remedy))
        key.put(study_.base, value);
      else
        tell(table->items[i], "set.\"" + name + "\"", range_text(*key.field), remedy);
    }
  }

  void read_vary() {
    const io::TomlValue* tables = root_.find("vary");
    if (tables == nullptr) return;
    if (tables->kind != Kind::list)
      return tell(*tables, "vary", "tables", "write [[vary]] above the keys of each parameter");
    for (std::size_t i = 0; i < tables->items.size(); ++i) {
      const io::TomlValue& table = tables->items[i];
      const std::string name = "vary[" + std::to_string(i) + "]";
      if (table.kind != Kind::table) {
        tell(table, name, "a table", "");
        continue;
      }
      check_keys(table, "vary", name + ".");
      read_factor(table, name);
    }
    std::map<std::string, int> count;
    for (const Factor& f : study_.vary)
      if (++count[f.key.path()] == 2)
        problems.push_back({path_, "vary", f.key.path(), "every key once", "join the two tables"});
  }
  void read_factor(const io::TomlValue& table, const std::string& name) {
    const io::TomlValue* key = table.find("key");
    if (key == nullptr || key->kind != Kind::text)
      return tell(key != nullptr ? *key : table, name + ".key", "a key of the recipe in quotes",
                  "for example key = \"bedding.k_n\"");
    Factor f;
    f.key = usable(key->text, key->line, name + ".key");
    if (f.key.field == nullptr) return;
    if (const std::string remedy = instead_of_varying(f.key, study_.base); !remedy.empty())
      return tell(*key, name + ".key", "a key that varies from point to point", remedy);
    const io::TomlValue *values = table.find("values"), *times = table.find("times"),
                        *from = table.find("from"), *to = table.find("to");
    const int n_ways = (values != nullptr) + (times != nullptr) + (from != nullptr || to != nullptr);
    if (n_ways != 1 || (from == nullptr) != (to == nullptr))
      return tell(table, name, "one of: values; times; from and to", "say once what " + key->text + " takes");
    if (values != nullptr) read_values(f, *values, name + ".values");
    if (times != nullptr) read_times(f, *times, name + ".times");
    if (from != nullptr) read_range(f, table, name);
    const bool by_levels = study_.design == Design::one_at_a_time || study_.design == Design::full_factorial;
    if (by_levels && f.levels.empty() && from != nullptr)
      tell(*from, name, "values or times with this design",
           "a range is for latin_hypercube, sobol, morris and saltelli");
    study_.vary.push_back(f);
  }
  bool value_in(const Factor& f, const io::TomlValue& v, const std::string& name, double& value) {
    std::string remedy;
    if (take_any(*f.key.field, v, value, remedy)) return true;
    tell(v, name, range_text(*f.key.field), remedy);
    return false;
  }
  void read_values(Factor& f, const io::TomlValue& list, const std::string& name) {
    if (list.kind != Kind::list || list.items.empty())
      return tell(list, name, "a list of values", "write [value, value, ...]");
    for (const io::TomlValue& v : list.items)
      if (double value = 0.0; value_in(f, v, name, value)) f.levels.push_back(value);
  }
  void read_times(Factor& f, const io::TomlValue& list, const std::string& name) {
    const bool countable = f.key.field->kind == FieldKind::quantity || f.key.field->kind == FieldKind::number;
    if (list.kind != Kind::list || list.items.empty() || !countable)
      return tell(list, name, "a list of factors of a key that is a number",
                  "write [0.5, 1, 2], or use values");
    const double base = f.key.get(study_.base);
    const Field& field = *f.key.field;
    for (const io::TomlValue& v : list.items) {
      const double value = v.number * base;
      if ((v.kind == Kind::integer || v.kind == Kind::number) && io::within_range(field, value))
        f.levels.push_back(value);
      else
        tell(v, name, "a factor that keeps " + f.key.path() + " within " + range_text(field), "");
    }
  }
  void read_range(Factor& f, const io::TomlValue& table, const std::string& name) {
    const io::TomlValue *from = table.find("from"), *to = table.find("to"), *scale = table.find("scale");
    if (f.key.field->kind == FieldKind::choice || f.key.field->kind == FieldKind::boolean)
      return tell(*from, name, "values for this key", "a range is for numbers");
    if (!value_in(f, *from, name + ".from", f.from) || !value_in(f, *to, name + ".to", f.to)) return;
    if (!(f.from < f.to)) tell(*to, name + ".to", "above from = " + f.key.print(f.from), "exchange the two");
    if (scale == nullptr) return;
    f.logarithmic = scale->text == "log";
    if (!f.logarithmic && scale->text != "linear")
      tell(*scale, name + ".scale", expected_of("vary", "scale"), "");
    if (f.logarithmic && !(f.from > 0.0)) tell(*from, name + ".from", "above 0 on a logarithmic scale", "");
  }

  /// The table of a list design: a header of keys, with units in brackets, then numbers or words.
  void read_list() {
    const std::string name = text("file", "");
    const io::TomlValue* v = root_.find("file");
    if ((study_.design == Design::list) == name.empty()) {
      problems.push_back(
          {v != nullptr ? at(v->line) : path_, "file", "", "a CSV file exactly with design = \"list\"",
           name.empty() ? "add file = \"points.csv\"" : "leave it out, or set design = \"list\""});
      return;
    }
    if (name.empty()) return;
    if (!study_.vary.empty())
      problems.push_back(
          {path_, "vary", "", "no [[vary]] with design = \"list\"", "the columns name the keys"});
    const std::string where = beside(name);
    const io::Table table = io::parse_table(io::read_file(where), where);
    problems.insert(problems.end(), table.problems.begin(), table.problems.end());
    const std::vector<std::string> units = read_header(table, where);
    for (const io::TableRow& row : table.rows)
      if (problems.size() < max_told) read_row(row, units, where);
  }
  std::vector<std::string> read_header(const io::Table& table, const std::string& file) {
    std::vector<std::string> units;
    for (const std::string& cell : table.header) {
      const std::size_t open = cell.rfind(" [");
      Factor f;
      const std::string key = cell.substr(0, open);
      f.key = find_key(key);
      const bool ok = f.key.field != nullptr && is_scalar(*f.key.field) &&
                      (f.key.field->table != "bedding" ||
                       static_cast<int>(study_.base.bedding.size()) > std::max(f.key.set, 0));
      if (!ok)
        problems.push_back({file + ":" + std::to_string(table.header_line), "column", cell,
                            "a key of the base recipe", key_hint(key)});
      else if (const std::string remedy = instead_of_varying(f.key, study_.base); !remedy.empty())
        problems.push_back({file + ":" + std::to_string(table.header_line), "column", cell,
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
      if (key.field == nullptr) return;
      double value = 0.0;
      std::string remedy;
      if (!take_any(*key.field, cell_value(*key.field, row.cells[k], units[k]), value, remedy))
        problems.push_back({file + ":" + std::to_string(row.line), key.path(), row.cells[k],
                            range_text(*key.field), remedy});
      values.push_back(value);
    }
    study_.rows.push_back(values);
  }
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

  void check_points() {
    double n = study_.design == Design::full_factorial ? 1.0 : static_cast<double>(study_.samples);
    if (study_.design == Design::full_factorial)
      for (const Factor& f : study_.vary) n *= static_cast<double>(f.levels.size());
    n *= static_cast<double>(study_.packings.size() * study_.bond_seeds.size());
    if (n > max_specimens) {
      problems.push_back(
          {path_, "vary", "", "at most a million specimens", "use fewer levels, or a sampled design"});
      return;
    }
    for (const Point& point : points_of(study_)) {
      const Recipe r = recipe_at(study_, point, study_.packings.front(), study_.bond_seeds.front());
      for (Problem& p :
           cross_checks(r, [&](const std::string&) { return path_ + " at " + describe(study_, point); }))
        problems.push_back(std::move(p));
      if (problems.size() >= max_told) return;
    }
  }
};

}  // namespace

const std::vector<StudyKey>& study_keys() {
  static const std::vector<StudyKey> keys = {
      {"", "name", "text", "name of the study; default: the file's name"},
      {"", "recipe", "a file", "recipe that the study starts from, counted from the folder of this file"},
      {"", "design",
       "one of \"one_at_a_time\" \"full_factorial\" \"list\" \"latin_hypercube\" \"sobol\" \"morris\" "
       "\"saltelli\"",
       "points to visit; default one_at_a_time"},
      {"", "samples", "1 <= value <= 100000",
       "points (latin_hypercube, sobol), walks of k + 1 points (morris), blocks of k + 2 (saltelli); default "
       "64"},
      {"", "seed", "0 <= value <= 4000000000", "seed of the sampled designs; default 1"},
      {"", "file", "a CSV file", "points of the list design: a column per key, its unit in brackets"},
      {"", "packings", "a list of different whole numbers",
       "packing seeds, as replicates; default: the recipe's"},
      {"", "bond_seeds", "a list of different whole numbers",
       "seeds of bond strengths, as replicates; default: the recipe's"},
      {"vary", "key", "a key of the recipe", "what varies: \"bedding.k_n\" (all sets) or \"bedding[1].k_n\""},
      {"vary", "values", "a list of values", "levels, with units"},
      {"vary", "times", "a list of numbers", "levels as multiples of the recipe's value"},
      {"vary", "from", "a value", "lower end of a range"},
      {"vary", "to", "a value", "upper end of a range"},
      {"vary", "scale", "one of \"linear\" \"log\"", "how a range is divided; default linear"},
      {"set", "\"table.key\"", "a value", "a key of the recipe and its value for the whole study"},
  };
  return keys;
}

Study read_study(const std::string& path) {
  std::vector<Problem> problems;
  const io::TomlValue root = io::parse_toml(io::read_file(path), path, problems);
  Reader reader(path, std::move(problems), root);
  Study study = reader.read();
  if (!reader.problems.empty()) throw InputError(std::move(reader.problems));
  return study;
}

}  // namespace phy::study
