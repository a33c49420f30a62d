#include "io/rock_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "base/units.hpp"
#include "io/file.hpp"
#include "io/table.hpp"
#include "io/toml_in.hpp"
#include "io/toml_tree.hpp"
#include "records/recipe_schema.hpp"
#include "records/rock_remarks.hpp"

namespace phy {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double most_apart = 5.0;  // standard deviations between two rows of one cell
constexpr std::size_t least_angles = 3;

/// What a column holds. `scatter`: the standard deviation of the property.
enum class Column { theta, beta, confining, diameter, n, value, scatter, other };
struct Head {
  Column kind = Column::other;
  Property property = Property::E;
  std::string name, unit;  ///< name in lower case
  std::string title;       ///< name as it is written, for messages
};

/// The names that columns of values may have, in lower case.
const std::map<std::string, Property>& property_names() {
  static const std::map<std::string, Property> names = {{"e", Property::E},
                                                        {"nu", Property::nu},
                                                        {"ucs", Property::ucs},
                                                        {"dts", Property::direct_tension},
                                                        {"bts", Property::brazilian}};
  return names;
}

Dimension dimension_of(const Head& h) {
  if (h.kind == Column::theta || h.kind == Column::beta) return Dimension::angle;
  if (h.kind == Column::diameter) return Dimension::length;
  if (h.kind == Column::n || h.property == Property::nu) return Dimension::none;
  return Dimension::pressure;
}

/// "E [GPa]", "E (GPa)" and "E_GPa" are the same head.
Head head_of(const std::string& cell) {
  Head h;
  std::size_t open = cell.find_first_of("[(");
  h.name = cell.substr(0, open);
  if (open != cell.npos) {
    h.unit = cell.substr(open + 1, cell.find_first_of("])", open) - open - 1);
  } else if (const std::size_t bar = cell.rfind('_'); bar != cell.npos) {
    const std::string tail = cell.substr(bar + 1);
    for (const Dimension d : {Dimension::pressure, Dimension::angle, Dimension::length})
      if (parse_quantity("1 " + tail, d).ok) h.unit = tail, h.name = cell.substr(0, bar);
  }
  h.title = h.name.substr(0, h.name.find_last_not_of(' ') + 1);
  std::string word;
  for (const char c : h.name)
    word += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  while (!word.empty() && word.back() == '_') word.pop_back();
  h.name = word;
  if (word == "theta") h.kind = Column::theta;
  if (word == "beta") h.kind = Column::beta;
  if (word == "confining") h.kind = Column::confining;
  if (word == "diameter") h.kind = Column::diameter;
  if (word == "n") h.kind = Column::n;
  const bool scatter = word.size() > 3 && word.ends_with("_sd");
  const auto it = property_names().find(scatter ? word.substr(0, word.size() - 3) : word);
  if (it != property_names().end())
    h.kind = scatter ? Column::scatter : Column::value, h.property = it->second;
  return h;
}

/// What can be computed with at all; what is only doubtful, records/rock_remarks.hpp tells.
struct Range {
  double low, high;
  const char* text;
};
Range range_of(const Head& h) {
  switch (h.kind) {
    case Column::theta:
    case Column::beta: return {0.0, 90.0, "0 deg <= angle <= 90 deg"};
    case Column::n: return {1.0, 1e6, "a whole number of specimens, at least 1"};
    case Column::diameter: return {1e-3, 10.0, "1 mm <= diameter of the disc <= 10 m"};
    case Column::confining: return {0.0, 5e9, "0 Pa <= confining pressure <= 5 GPa"};
    case Column::scatter:
      return h.property == Property::nu ? Range{0.0, 1.0, "0 <= SD of nu <= 1"}
                                        : Range{0.0, 1e12, "a standard deviation >= 0"};
    default: break;
  }
  if (h.property == Property::E) return {1e6, 1e12, "1 MPa <= E <= 1000 GPa"};
  if (h.property == Property::nu) return {-0.5, 1.5, "-0.5 <= apparent nu <= 1.5"};
  return {1e3, 5e9, "1 kPa <= strength <= 5 GPa"};
}

/// Reads the cells of a table.
class ReadingReader {
 public:
  ReadingReader(const Table& table, std::string where, std::vector<Problem>& problems,
                std::vector<std::string>& notes)
      : table_(table), where_(std::move(where)), problems_(problems), notes_(notes) {}

  std::vector<RockReading> read(double confining, bool& bedded) {
    read_heads();
    bedded = find(Column::theta) || find(Column::beta);
    for (const TableRow& row : table_.rows) read_row(row, confining);
    check_repeats();
    return std::move(readings_);
  }

 private:
  const Table& table_;
  std::string where_;
  std::vector<Problem>& problems_;
  std::vector<std::string>& notes_;
  std::vector<Head> heads_;
  std::vector<RockReading> readings_;

  std::string at(int line) const { return where_ + ":" + std::to_string(line); }
  std::optional<std::size_t> find(Column kind, Property p = Property::E) const {
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (heads_[i].kind == kind &&
          (heads_[i].property == p || (kind != Column::value && kind != Column::scatter)))
        return i;
    return std::nullopt;
  }
  void tell(const std::string& key, const std::string& value, const std::string& expected,
            const std::string& remedy) {
    problems_.push_back({at(table_.header_line), key, value, expected, remedy});
  }

  void read_heads() {
    std::vector<std::string> ignored;
    std::map<std::string, std::string> seen;
    for (const std::string& cell : table_.header) {
      const Head h = head_of(cell);
      heads_.push_back(h);
      const Dimension d = dimension_of(h);
      if (h.kind == Column::other) {
        if (!h.unit.empty())
          tell(cell, "",
               "a known column: theta or beta, E, nu, UCS, DTS, BTS, each with _sd, diameter, confining, n",
               "rename it, or take its unit out of the header to have it passed over");
        else if (!h.name.empty())
          ignored.push_back(cell);
        continue;
      }
      if (const auto [it, fresh] = seen.emplace(h.name, h.unit); !fresh)
        tell(cell, "", "one column of this name",
             it->second != h.unit ? "its units are mixed: " + it->second + " and " + h.unit : "");
      if (d == Dimension::none) continue;
      if (!parse_quantity("1 " + h.unit, d).ok)
        tell(cell, h.unit.empty() ? "" : h.unit, "a unit in the header: " + unit_names(d),
             "write for example " + h.title + (d == Dimension::angle ? " [deg]" : " [MPa]"));
    }
    if (find(Column::theta) && find(Column::beta))
      tell("beta", "", "one convention of angles", "keep theta or beta, not both");
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (heads_[i].kind == Column::scatter && !find(Column::value, heads_[i].property))
        tell(table_.header[i], "", "a column of the values themselves", "");
    bool any = false;
    for (const Head& h : heads_) any = any || h.kind == Column::value;
    if (!any) tell("header", "", "at least one of the columns E, nu, UCS, DTS, BTS", "");
    if (find(Column::beta))
      notes_.emplace_back("angles are beta, between load and bedding; theta = 90 deg - beta");
    if (!ignored.empty())
      notes_.push_back("columns passed over: " + fmt::format("{}", fmt::join(ignored, ", ")));
  }

  /// One cell in SI; NaN if it is empty. False: told.
  bool number(const TableRow& row, std::size_t column, double& value) {
    const Head& h = heads_[column];
    const std::string& cell = row.cells[column];
    value = nan;
    if (cell.empty() || cell == "-") return true;
    const Range range = range_of(h);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
      const bool unit = error == std::errc() && std::isalpha(static_cast<unsigned char>(cell.back())) != 0;
      problems_.push_back({at(row.line), h.title, cell, "a bare number in " + (h.unit.empty() ? "1" : h.unit),
                           unit ? "units stand in the header only: mixed units are not read"
                                : "leave the cell empty where nothing was measured"});
      return false;
    }
    if (const Dimension d = dimension_of(h); d != Dimension::none) {
      const Quantity q = parse_quantity(cell + " " + h.unit, d);
      if (!q.ok) return false;  // the header was told
      value = q.value;
    }
    const bool whole = h.kind != Column::n || value == std::floor(value);
    if (value >= range.low && value <= range.high && whole) return true;
    problems_.push_back({at(row.line), h.title, cell + (h.unit.empty() ? "" : " " + h.unit), range.text,
                         h.kind == Column::theta || h.kind == Column::beta
                             ? "fold the angle: bedding at 120 deg is the mirror image of 60 deg"
                             : ""});
    return false;
  }

  void read_row(const TableRow& row, double confining) {
    std::vector<double> v(heads_.size(), nan);
    bool good = true;
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (heads_[i].kind != Column::other) good = number(row, i, v[i]) && good;
    RockReading r;
    r.line = row.line;
    const auto theta = find(Column::theta), beta = find(Column::beta), n = find(Column::n);
    if (theta || beta) {
      const double angle = v[theta ? *theta : *beta];
      if (good && !std::isfinite(angle))
        problems_.push_back({at(row.line), theta ? "theta" : "beta", "", "an angle in every row", ""}),
            good = false;
      r.theta = theta ? angle : 90.0 - angle;
    }
    if (!good) return;
    if (const auto c = find(Column::confining); c && std::isfinite(v[*c])) r.confining = v[*c];
    if (std::isfinite(confining) && std::fabs(r.confining - confining) > 1e-6 * std::max(1.0, confining))
      return;
    if (n && std::isfinite(v[*n])) r.n = static_cast<int>(v[*n]);
    if (const auto d = find(Column::diameter); d && std::isfinite(v[*d])) r.diameter = v[*d];
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      if (heads_[i].kind != Column::value || !std::isfinite(v[i])) continue;
      r.property = heads_[i].property, r.value = v[i];
      const auto sd = find(Column::scatter, r.property);
      r.sd = sd && v[*sd] > 0.0 ? v[*sd] : nan;
      readings_.push_back(r);
    }
  }

  /// Two rows of one cell that cannot be the same rock.
  void check_repeats() {
    std::set<int> told;
    for (std::size_t i = 0; i < readings_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const RockReading &a = readings_[j], &b = readings_[i];
        if (a.property != b.property || a.theta != b.theta || a.confining != b.confining ||
            a.diameter != b.diameter)
          continue;
        const double sd = std::fmax(a.sd, b.sd);  // passes over a NaN
        if (!(std::fabs(a.value - b.value) > most_apart * sd) || !told.insert(b.line).second) continue;
        problems_.push_back({at(b.line), to_string(b.property), fmt::format("{:g}", b.value),
                             fmt::format("within {:g} SD ({:g}) of line {} ({:g}), SI units", most_apart, sd,
                                         a.line, a.value),
                             "one of the two is a slip, or the rows are two different rocks"});
      }
  }
};

/// One key of the rock file with everything that a message needs.
struct Entry {
  std::string path;  // "specimen.width"
  std::size_t line = 0;
  std::string value;
  bool is_text = false;
};

void flatten(const TomlValue& table, const std::string& above, std::map<std::string, Entry>& entries) {
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    const TomlValue& v = table.items[i];
    const std::string path = above + table.keys[i].name;
    if (v.kind == TomlValue::Kind::table) {
      flatten(v, path + ".", entries);
      continue;
    }
    const bool is_text = v.kind == TomlValue::Kind::text;
    entries[path] = {path, table.keys[i].line, is_text ? v.text : as_written(v), is_text};
  }
}

/// Keys of the rock file.
class RockReader {
 public:
  RockReader(std::string path, Rock& rock, std::vector<Problem>& problems)
      : path_(std::move(path)), rock_(rock), problems_(problems) {}

  void read() {
    rock_.model.bedding.resize(1);
    const std::string text = read_file(path_);
    if (text.find_first_not_of(" \t\r\n\xEF\xBB\xBF") == text.npos)
      return problems_.push_back(
          {path_, "", "", "the keys name and data", "the file is empty; `phyllite rock new` writes one"});
    flatten(parse_toml(text, path_, problems_), "", entries_);
    for (const auto& [path, entry] : entries_)
      if (!known().contains(path)) unknown(entry);
    rock_.name = this->text("name", std::filesystem::path(path_).stem().string());
    const std::size_t n_before = problems_.size();
    read_recipe_file();
    read_size();
    read_disc();
    const bool has_model = problems_.size() == n_before;
    read_reading();
    read_table();
    if (has_model) check_model(), check_discs();
    if (problems_.empty())
      for (std::string& remark : remarks_on(rock_)) rock_.notes.push_back(std::move(remark));
  }

 private:
  std::string path_;
  Rock& rock_;
  std::vector<Problem>& problems_;
  std::map<std::string, Entry> entries_;
  std::string table_;        // its path
  bool has_bedding_ = true;  // the recipe says where the planes are

  static const std::set<std::string>& known() {
    static const std::set<std::string> keys = {
        "name",   "data",           "recipe",          "elastic_reading",    "confining",
        "bedded", "specimen.width", "specimen.height", "brazilian.diameter", "brazilian.loading_angle"};
    return keys;
  }
  std::string at(const Entry& e) const { return path_ + ":" + std::to_string(e.line); }
  void unknown(const Entry& e) {
    const std::string near = nearest(e.path, {known().begin(), known().end()});
    problems_.push_back({at(e), e.path, "", "a known key: " + fmt::format("{}", fmt::join(known(), ", ")),
                         near.empty() ? "" : "did you mean \"" + near + "\"?"});
  }
  const Entry* entry(const std::string& key) const {
    const auto it = entries_.find(key);
    return it == entries_.end() ? nullptr : &it->second;
  }
  std::string text(const std::string& key, const std::string& otherwise) {
    const Entry* e = entry(key);
    if (e == nullptr) return otherwise;
    if (!e->is_text) problems_.push_back({at(*e), key, e->value, "text in quotes", ""});
    return e->value;
  }
  double quantity(const std::string& key, Dimension d, double otherwise) {
    const Entry* e = entry(key);
    if (e == nullptr) return otherwise;
    const Quantity q = parse_quantity(e->value, d);
    if (!q.ok)
      problems_.push_back({at(*e), key, e->value, "a number with a unit: " + unit_names(d), q.problem});
    else if (!(q.value > 0.0))
      problems_.push_back({at(*e), key, e->value, "a positive value", ""});
    return q.value > 0.0 ? q.value : otherwise;
  }
  std::string beside(const std::string& file) const {
    return (std::filesystem::path(path_).parent_path() / file).string();
  }
  void collect(const InputError& error) {
    for (const Problem& p : error.problems()) problems_.push_back(p);
  }

  void unreadable(const char* key, const IoError& error) {
    problems_.push_back(
        {at(*entry(key)), key, '"' + entry(key)->value + '"', "a file that can be read", error.what()});
  }

  void read_recipe_file() {
    if (entry("recipe") == nullptr) {
      rock_.notes.emplace_back("the model is the paper's specimen (no recipe named)");
      return;
    }
    try {
      rock_.model = read_recipe(beside(text("recipe", "")));
    } catch (const InputError& error) {
      collect(error);
    } catch (const IoError& error) {
      unreadable("recipe", error);
    }
    if (rock_.model.bedding.size() > 1)
      problems_.push_back({at(*entry("recipe")), "recipe", entry("recipe")->value,
                           "at most one set of bedding",
                           "the tables of a rock know one direction of planes"});
    if (!rock_.model.packing.file.empty())
      problems_.push_back(
          {at(*entry("recipe")), "recipe", entry("recipe")->value, "no packing.file",
           "a file holds one packing, a calibration is verified on others: describe the grains"});
    has_bedding_ = !rock_.model.bedding.empty();
    rock_.model.bedding.resize(1);
  }
  /// Another size of specimen magnifies the model: as many grains across, planes and zone in proportion.
  void read_size() {
    SpecimenSize& size = rock_.model.specimen;
    const double width = quantity("specimen.width", Dimension::length, size.width);
    const double height = quantity("specimen.height", Dimension::length, size.height);
    if (width == size.width && height == size.height) return;
    if (entry("recipe") != nullptr)
      return problems_.push_back(
          {path_, "specimen", "", "the size of the recipe", "leave [specimen] out: the recipe says it"});
    const double scale = width / size.width;
    PackingRecipe& p = rock_.model.packing;
    p.radius_min *= scale, p.radius_max *= scale;
    p.n_grains = std::llround(static_cast<double>(p.n_grains) * height / (size.height * scale));
    BeddingRecipe& b = rock_.model.bedding[0];
    b.spacing *= scale, b.zone_thickness *= scale;
    size = {width, height};
    rock_.notes.push_back(
        fmt::format("the model is the paper's specimen magnified to {:g} x {:g} mm: {} grains, "
                    "bedding every {:g} mm",
                    width * 1e3, height * 1e3, p.n_grains, b.spacing * 1e3));
  }
  /// Discs of the Brazilian tests: those of the recipe unless said here.
  void read_disc() {
    TestRecipe& test = rock_.model.test;
    test.disc_diameter = quantity("brazilian.diameter", Dimension::length, test.disc_diameter);
    if (const Entry* e = entry("brazilian.loading_angle")) {
      const Quantity q = parse_quantity(e->value, Dimension::angle);
      if (q.ok)
        test.loading_angle = q.value;
      else
        problems_.push_back(
            {at(*e), e->path, e->value, "a number with a unit: " + unit_names(Dimension::angle), q.problem});
    }
  }

  /// The key of the rock file behind a key of the recipe; nullptr: nobody gave it.
  const Entry* said_here(const std::string& path) const {
    if (path == "test.disc_diameter") return entry("brazilian.diameter");
    if (path == "test.loading_angle") return entry("brazilian.loading_angle");
    if (entry("recipe") != nullptr) return entry("recipe");
    const Entry *width = entry("specimen.width"), *height = entry("specimen.height");
    return height == nullptr || (path == "specimen.width" && width != nullptr) ? width : height;
  }
  using Where = std::function<std::string(const std::string&)>;
  /// Numbers of the model outside the ranges of a recipe.
  std::vector<Problem> out_of_range(const Where& where) const {
    std::vector<Problem> found;
    for (const Field& f : recipe_fields()) {
      if (f.kind != FieldKind::quantity && f.kind != FieldKind::number && f.kind != FieldKind::integer)
        continue;
      const std::size_t n = f.table == "bedding" ? rock_.model.bedding.size() : 1;
      for (std::size_t i = 0; i < n; ++i)
        if (!within_range(f, f.get(rock_.model, i)))
          found.push_back({where(f.path()), f.path(), print_field(f, rock_.model, i), range_text(f), ""});
    }
    return found;
  }
  /// What `phyllite run` would refuse: the recipe's own ranges and checks, after all of the rock file.
  void check_model() {
    const Where where = [&](const std::string& path) {
      const Entry* e = said_here(path);
      return e != nullptr ? at(*e) : path_;
    };
    std::vector<Problem> found = out_of_range(where);
    std::set<std::string> odd;
    for (const Problem& p : found) odd.insert(p.key);
    for (Problem& p :
         cross_checks(rock_.model, where, [&](const std::string& key) { return !odd.contains(key); }))
      found.push_back(std::move(p));
    for (Problem& p : found) {
      const Entry* e = said_here(p.key);
      if (e != nullptr && e->path.starts_with("brazilian.")) p.key = e->path;
      if (e != nullptr && e->path.starts_with("specimen."))
        p.remedy =
            "[specimen] magnifies the paper's specimen, grains and all: nearer to its shape, 1 : 2, or a "
            "recipe with grains of its own";
      problems_.push_back(std::move(p));
    }
  }
  /// The same for every disc of the table.
  void check_discs() {
    for (const RockReading& r : rock_.readings) {
      if (r.property != Property::brazilian || r.diameter == 0.0) continue;
      Recipe disc = rock_.model;
      disc.test.disc_diameter = r.diameter;
      std::string where = table_ + ":" + std::to_string(r.line);
      for (Problem& p : cross_checks(disc, [&](const std::string&) { return where; }))
        if (p.key == "test.disc_diameter") p.key = "diameter", problems_.push_back(std::move(p));
    }
  }

  void read_reading() {
    const std::string word = text("elastic_reading", "plane stress");
    if (word == "plane strain")
      rock_.reading = ElasticReading::plane_strain;
    else if (word != "plane stress")
      problems_.push_back(
          {at(*entry("elastic_reading")), "elastic_reading", word, "one of plane stress, plane strain", ""});
  }

  void read_table() {
    if (entry("data") == nullptr)
      return problems_.push_back(
          {path_, "data", "", "the name of the table of tests", "write data = \"tests.csv\""});
    table_ = beside(text("data", ""));
    const std::string& where = table_;
    const std::size_t n_before = problems_.size();
    bool has_angles = false;
    const double confining =
        entry("confining") != nullptr ? quantity("confining", Dimension::pressure, nan) : nan;
    try {
      rock_.readings = parse_readings(read_file(where), where, confining, has_angles, problems_, rock_.notes);
    } catch (const IoError& error) {
      return unreadable("data", error);
    }
    rock_.bedded = has_angles;
    if (const Entry* e = entry("bedded")) {
      rock_.bedded = e->value == "true";
      if (e->value != "true" && e->value != "false")
        problems_.push_back({at(*e), "bedded", e->value, "true or false", ""});
      if (rock_.bedded && !has_angles)
        problems_.push_back(
            {where, "theta", "", "a column of angles, theta or beta", "or write bedded = false"});
    }
    if (!rock_.bedded) {
      rock_.model.bedding.clear(), rock_.model.test.angles.clear();
      for (RockReading& r : rock_.readings) r.theta = 0.0;
      rock_.notes.emplace_back("a rock without bedding");
    } else if (!has_bedding_) {
      rock_.notes.push_back(
          fmt::format("the recipe has no [[bedding]]: planes are the paper's, every {:g} mm",
                      rock_.model.bedding[0].spacing * 1e3));
    }
    if (problems_.size() == n_before) check_content(where);
  }
  void check_content(const std::string& where) {
    std::set<double> angles, pressures;
    bool nu = false, E = false;
    for (const RockReading& r : rock_.readings) {
      angles.insert(r.theta), pressures.insert(r.confining);
      nu = nu || r.property == Property::nu, E = E || r.property == Property::E;
    }
    if (rock_.readings.empty())
      problems_.push_back({where, "", "", "at least one value",
                           entry("confining") != nullptr ? "no row has this confining pressure"
                                                         : "all cells are empty: fill in the table"});
    else if (rock_.bedded && angles.size() < least_angles)
      problems_.push_back({where, "theta", fmt::format("{} angle(s)", angles.size()),
                           "at least three angles for a bedded rock",
                           "test 0, 45 and 90 degrees; or write bedded = false"});
    bool elastic = false, strength = false;  // under confining pressure
    for (const RockReading& r : rock_.readings)
      if (r.confining > 0.0) (is_strength(r.property) ? strength : elastic) = true;
    if (strength) rock_.notes.emplace_back("strengths under confining pressure are kept, not fitted");
    if (pressures.size() > 1 && elastic)
      problems_.push_back({where, "confining", fmt::format("{} pressures", pressures.size()),
                           "E and nu at one confining pressure", "choose one: confining = \"10 MPa\""});
    if (rock_.reading == ElasticReading::plane_strain && E && !nu)
      problems_.push_back({path_, "elastic_reading", "plane strain", "a column nu",
                           "plane strain cannot be converted without it"});
    for (const Target& t : of_property(targets_of(rock_), Property::E))
      if (!(t.mean > 0.0))
        problems_.push_back({where, "nu", "", fmt::format("a nu that leaves E({:g}) positive", t.theta),
                             "nu along the bedding is too large to be read as plane strain"});
  }
};

}  // namespace

std::vector<RockReading> parse_readings(std::string_view text, const std::string& where, double confining,
                                        bool& bedded, std::vector<Problem>& problems,
                                        std::vector<std::string>& notes) {
  Table table = parse_table(text, where);
  for (Problem& p : table.problems) problems.push_back(std::move(p));
  for (std::string& note : table.notes) notes.push_back(fmt::format("{}: {}", where, note));
  bedded = false;
  if (table.header_line == 0) return {};
  return ReadingReader(table, where, problems, notes).read(confining, bedded);
}

Rock read_rock(const std::string& path) {
  Rock rock;
  std::vector<Problem> problems;
  try {
    RockReader(path, rock, problems).read();
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) problems.push_back(p);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return rock;
}

std::string rock_template(const std::string& name) {
  return "# A rock for `phyllite calibrate`. What is not measured stays out of the table: empty cells are "
         "fine.\n"
         "# `phyllite rock check` tells what the data determine before anything runs.\n"
         "name = \"" +
         name +
         "\"\n"
         "data = \"" +
         name +
         ".csv\"        # the table of tests, beside this file\n"
         "\n"
         "# Moduli of cylinders are read as plane stress; \"plane strain\" converts them (needs nu).\n"
         "elastic_reading = \"plane stress\"\n"
         "\n"
         "# confining = \"10 MPa\"          # of a table with several confining pressures, the one to use\n"
         "# bedded = false                # a rock without bedding needs no column of angles\n"
         "# recipe = \"model.toml\"         # grain size, bedding rule, spacing, press (`phyllite recipe "
         "--template`);\n"
         "#                               # without it: the paper's specimen, magnified to the size below\n"
         "\n"
         "[specimen]                      # of the compression tests\n"
         "width = \"38 mm\"\n"
         "height = \"76 mm\"\n"
         "\n"
         "# [brazilian]                   # discs of the BTS column, unless a column diameter [mm] says "
         "otherwise\n"
         "# diameter = \"38 mm\"           # default: the smaller side of the specimen\n"
         "# loading_angle = \"10 deg\"     # arc of each jaw; \"0 deg\": flat platens\n";
}

std::string rock_table_template() {
  return "# One row per angle, or per angle and test; repeated rows are replicates. Units stand in the "
         "header.\n"
         "# theta: inclination of the bedding, load along y: 0 = bedding across the load, 90 = along it.\n"
         "# Or a column beta [deg], the angle between load and bedding (beta = 90 - theta). Three angles at "
         "least.\n"
         "# Also known: DTS [MPa] (direct tension), BTS [MPa] (Brazilian; diameter [mm] of its disc), each "
         "with "
         "_sd;\n"
         "# confining [MPa]. The load, or the pull of DTS, is along y in every test.\n"
         "# _sd: standard deviation of single specimens; n: specimens. Other columns without a unit are "
         "passed over.\n"
         "theta [deg],E [GPa],E_sd [GPa],nu,nu_sd,UCS [MPa],UCS_sd [MPa],n\n"
         "0,,,,,,,\n15,,,,,,,\n30,,,,,,,\n45,,,,,,,\n60,,,,,,,\n75,,,,,,,\n90,,,,,,,\n";
}

}  // namespace phy
