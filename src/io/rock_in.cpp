#include "io/rock_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "base/quote.hpp"
#include "base/spelling.hpp"
#include "base/units.hpp"
#include "io/file.hpp"
#include "io/rock_table.hpp"
#include "io/toml_in.hpp"
#include "io/toml_tree.hpp"
#include "records/recipe_schema.hpp"
#include "records/rock_remarks.hpp"

namespace phy::io {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t least_angles = 3;

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
    if (entry("name") == nullptr && !is_plain(rock_.name))
      problems_.push_back({path_, "name", rock_.name, "a name in UTF-8 without control characters",
                           "the file has none: write name = \"...\""});
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
         "# E and nu are compared with those of the model at small strain, before anything breaks.\n"
         "# _sd: standard deviation of single specimens; n: specimens. Other columns without a unit are "
         "passed over.\n"
         "theta [deg],E [GPa],E_sd [GPa],nu,nu_sd,UCS [MPa],UCS_sd [MPa],n\n"
         "0,,,,,,,\n15,,,,,,,\n30,,,,,,,\n45,,,,,,,\n60,,,,,,,\n75,,,,,,,\n90,,,,,,,\n";
}

}  // namespace phy::io
