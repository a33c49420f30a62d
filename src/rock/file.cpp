#include "rock/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "base/nan.hpp"
#include "base/quote.hpp"
#include "io/file.hpp"
#include "io/file_kinds.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"
#include "rock/columns.hpp"
#include "rock/schema.hpp"
#include "rock/table.hpp"

namespace phy::rock {
namespace {

// Fewer angles cannot show a minimum between 0 and 90 degrees.
constexpr std::size_t least_angles = 3;

/// Bedding as calibrations predict it; bridges by the crossing rule alone, as they were mapped.
bool is_ideal(const BeddingRecipe& b, const MatrixRecipe& m) {
  const bool bridged = b.rule == BeddingRule::crossing && !b.unjointed() &&
                       find_model(true, LayerModel::planes_with_bridges, m.model) != nullptr &&
                       !m.directional();
  return b.is_regular() && (b.persistence == 1.0 || bridged) && b.sigma_n_sd == 0.0 &&
         b.layer_thickness == 0.0 && (b.bridges || b.rule != BeddingRule::zone);
}

/// Keys of the rock file.
class RockReader {
 public:
  RockReader(std::string_view text, const std::string& path, const RockParts& parts, Rock& rock)
      : path_(path),
        file_(text, path, rock_schema()),
        rock_(rock),
        problems_(file_.problems),
        parts_(parts) {}
  RockReader(io::TomlValue keys, const std::string& where, const RockParts& parts, Rock& rock)
      : path_(where),
        file_(std::move(keys), where, rock_schema(), {}),
        rock_(rock),
        problems_(file_.problems),
        parts_(parts) {}

  void read() {
    // One set of bedding to magnify and complete; a rock without bedding has it removed with its table.
    rock_.model.bedding.resize(1);
    rock_.name = file_.name();
    const bool has_model =
        // In this order: a size magnifies grains and planes, and what is stated of these stays as stated.
        // Each builds on the one before, so the first failure ends it.
        read_recipe_file() && read_size() && read_grain_size() && read_layers() && read_matrix();
    read_disc();
    PackingRecipe& packing = rock_.model.packing;
    packing.seed =
        static_cast<decltype(packing.seed)>(file_.number("first_packing", static_cast<double>(packing.seed)));
    if (file_.number("elastic_reading", 0.0) == 1.0) rock_.reading = ElasticReading::plane_strain;
    rock_.E_is = static_cast<ModulusReading>(static_cast<int>(file_.number("E_is", 0.0)));
    read_table();
    // After everything is read: the checks compare model, size, discs and table.
    if (has_model) check_model(), check_discs();
    file_.check();
  }

 private:
  const std::string& path_;
  io::Document file_;
  Rock& rock_;
  std::vector<Problem>& problems_;
  RockParts parts_;
  std::string table_;       // its path
  bool has_layers_ = true;  // the recipe says what they are

  bool is_given(const std::string& key) const { return file_.find(key) != nullptr; }

  /// False: there is no model to check.
  bool read_recipe_file() {
    if (!is_given("recipe")) {
      rock_.notes.emplace_back("the model is the paper's specimen (no recipe named)");
      return true;
    }
    if (!file_.is_known("recipe")) return false;
    const std::optional<Recipe> recipe =
        parts_.recipe ? parts_.recipe : file_.read_named("recipe", io::read_recipe);
    if (!recipe) return false;
    rock_.model = *recipe, rock_.grains_stated = true;
    rock_.notes.insert(rock_.notes.end(), recipe->notes.begin(), recipe->notes.end());
    const auto refuse = [&](const char* expected, const char* remedy) {
      file_.report_problem(*file_.find("recipe"), "recipe", expected, remedy);
      return false;
    };
    // Both problems are reported, not only the first.
    bool good = true;
    if (recipe->bedding.size() > 1)
      good = refuse("at most one set of bedding", "the tables of a rock know one direction of planes");
    if (!std::all_of(recipe->bedding.begin(), recipe->bedding.end(),
                     [&](const BeddingRecipe& b) { return is_ideal(b, recipe->matrix); }))
      good = refuse(
          "planes that are parallel and equally spaced, with joints of one strength, in one matrix; with "
          "persistence below 1 (not 0) by rule = \"crossing\" between bonds without directions",
          "a calibration knows no other bedding: leave out rule = \"oriented\", bridges, spacing_sd, "
          "theta_sd, sigma_n_sd, layer_thickness, and persistence where its rule or matrix is another");
    if (!recipe->packing.file.empty())
      good = refuse("no packing.file",
                    "a file holds one packing, a calibration is verified on others: describe the grains");
    has_layers_ = layered(*recipe);
    // Planes are where the paper has them, unless the recipe says it; read_table() notes that.
    if (!has_layers_) rock_.model.bedding.resize(1), rock_.model.bedding[0].rule = BeddingRule::crossing;
    return good;
  }
  /// Which layers, and how far apart. Joints on the contacts that cross a plane: no thickness to guess.
  bool read_layers() {
    if (!file_.is_known("bedding.spacing") || !file_.is_known("layers")) return false;
    if (is_given("recipe") && has_layers_) {
      rock_.layers = layers_of(rock_.model);
      for (const char* key : {"bedding.spacing", "layers"})
        if (is_given(key))
          problems_.push_back(
              {file_.place(key), key, "", "the layers of the recipe", "leave it out: the recipe says it"});
      return true;
    }
    rock_.layers = static_cast<LayerModel>(static_cast<int>(file_.number("layers", 0.0)));
    BeddingRecipe& b = rock_.model.bedding[0];
    b.rule = BeddingRule::crossing;
    b.spacing = file_.number("bedding.spacing", b.spacing);
    const SpecimenSize& size = rock_.model.specimen;
    if (is_given("bedding.spacing") && b.spacing > std::min(size.width, size.height))
      problems_.push_back({file_.place("bedding.spacing"), "bedding.spacing",
                           fmt::format("{:g} mm", b.spacing * 1e3),
                           fmt::format("at most the smaller side of the specimen, {:g} mm",
                                       std::min(size.width, size.height) * 1e3),
                           "a specimen without layers shows nothing of them"});
    if (is_given("bedding.spacing") && rock_.layers == LayerModel::directions)
      problems_.push_back({file_.place("bedding.spacing"), "bedding.spacing", "", "layers that are planes",
                           "directions of the bonds have no spacing: leave it out"});
    return true;
  }
  /// The matrix of a recipe stays, unless this file asks for another.
  bool read_matrix() {
    if (!file_.is_known("matrix")) return false;
    rock_.matrix = rock_.model.matrix.model;
    if (is_given("matrix") || !is_given("recipe")) {
      const int asked = static_cast<int>(file_.number("matrix", 0.0));
      // Nothing stands for "choose": models with either matrix are compared then.
      rock_.matrix.reset();
      if (asked > 0) rock_.matrix = static_cast<MatrixModel>(asked - 1);
    }
    const MatrixModel stays = rock_.matrix.value_or(rock_.model.matrix.model);
    if (of_parallel_bonds(rock_.layers) && stays == MatrixModel::flat_joint) {
      const char* key = is_given("matrix") ? "matrix" : "recipe";
      problems_.push_back(
          {file_.place(key), key, fmt::format("flat joints, layers = \"{}\"", to_string(rock_.layers)),
           "a model of rock that has both",
           fmt::format("choose matrix = \"parallel_bond\", or layers that flat joints have: {}",
                       fmt::join(layers_of_matrix(stays), ", "))});
    }
    return true;
  }
  /// Where the recipe says its size; of a recipe that says none its name.
  std::string place_of_size() const {
    const std::string file = file_.beside(file_.text("recipe", ""));
    // A recipe that a caller holds stands in no file that could be opened.
    if (parts_.recipe) return file_.text("recipe", "");
    // Problems of the recipe were told when it was read.
    std::vector<Problem> none;
    const io::TomlValue root = io::parse_toml(io::read_file(file), file, none);
    const io::TomlValue* specimen = root.find("specimen");
    return specimen != nullptr ? io::at_line(file, specimen->line) : file;
  }
  bool refuse_second_size(const SpecimenSize& here) {
    const SpecimenSize& there = rock_.model.specimen;
    const std::string key = is_given("specimen.width") ? "specimen.width" : "specimen.height";
    // A dozen across: as coarse as a specimen bears (ten).
    const double coarse = rounded(here.width / 12.5, 2);
    problems_.push_back(
        {file_.place(key), "specimen", "", "",
         fmt::format(
             "the size is {:g} x {:g} mm here, and {:g} x {:g} mm in {}. Delete one. For coarse grains "
             "alone, write grain_size = \"{}\" and no recipe",
             here.width * 1e3, here.height * 1e3, there.width * 1e3, there.height * 1e3, place_of_size(),
             print_quantity(coarse, Dimension::length))});
    return false;
  }
  /// Another size of specimen magnifies the model: as many grains across, planes and zone in proportion.
  bool read_size() {
    if (!file_.is_known("specimen.width") || !file_.is_known("specimen.height")) return false;
    SpecimenSize& size = rock_.model.specimen;
    const double width = file_.number("specimen.width", size.width);
    const double height = file_.number("specimen.height", size.height);
    // Nothing to magnify.
    if (width == size.width && height == size.height) return true;
    if (is_given("recipe")) return refuse_second_size({width, height});
    // Lengths of grains and bedding scale with the width. Number of grains: area over grain area, n W H/r^2,
    // in which the width cancels against one factor of scale.
    const double scale = width / size.width;
    PackingRecipe& p = rock_.model.packing;
    p.radius_min *= scale, p.radius_max *= scale;
    p.n_grains = std::llround(static_cast<double>(p.n_grains) * height / (size.height * scale));
    BeddingRecipe& b = rock_.model.bedding[0];
    b.spacing *= scale, b.zone_thickness *= scale;
    size = {width, height};
    rock_.notes.push_back(
        fmt::format("the model is the paper's specimen magnified to {:g} x {:g} mm: {} grains", width * 1e3,
                    height * 1e3, p.n_grains));
    return true;
  }
  /// Grains as large as somebody has said, in a specimen of the same size: as full of more or fewer of them.
  bool read_grain_size() {
    if (!file_.is_known("grain_size")) return false;
    if (!is_given("grain_size")) return true;
    if (is_given("recipe")) {
      problems_.push_back({file_.place("grain_size"), "grain_size", "", "the grains of the recipe",
                           "leave it out: the recipe says it"});
      return false;
    }
    PackingRecipe& p = rock_.model.packing;
    const double diameter = file_.number("grain_size", 0.0), scale = diameter / phy::grain_size(rock_.model);
    p.radius_min *= scale, p.radius_max *= scale;
    p.n_grains = std::llround(static_cast<double>(p.n_grains) / (scale * scale));
    rock_.grains_stated = true;
    // n grains, and steps as the time that a wave takes across one of them
    const double cost =
        std::pow(static_cast<double>(p.n_grains) / static_cast<double>(PackingRecipe().n_grains), 1.5);
    rock_.notes.push_back(
        fmt::format("grain_size = {:.4g} mm: {} grains in the specimen; a test costs about {:.2g} times as "
                    "much as on the paper's {}",
                    diameter * 1e3, p.n_grains, cost, PackingRecipe().n_grains));
    return true;
  }
  /// Discs of the Brazilian tests: those of the recipe unless said here.
  void read_disc() {
    TestRecipe& test = rock_.model.test;
    test.disc_diameter = file_.number("brazilian.diameter", test.disc_diameter);
    test.loading_angle = file_.number("brazilian.loading_angle", test.loading_angle);
  }

  /// The key of the rock file that a key of the recipe comes from; "" if none was given. It gives the line
  /// for messages.
  std::string said_here(const std::string& path) const {
    if (path == "grain_size") return path;
    if (path == "packing.seed" && is_given("first_packing")) return "first_packing";
    if (path == "test.disc_diameter") return "brazilian.diameter";
    if (path == "test.loading_angle") return "brazilian.loading_angle";
    if (path == "bedding[0].spacing" && is_given("bedding.spacing")) return "bedding.spacing";
    if (path.starts_with("packing.") && is_given("grain_size")) return "grain_size";
    if (is_given("recipe")) return "recipe";
    const bool width = is_given("specimen.width"), height = is_given("specimen.height");
    return width && (path == "specimen.width" || !height) ? "specimen.width"
           : height                                       ? "specimen.height"
                                                          : "";
  }
  using Where = std::function<std::string(const std::string&)>;
  /// Numbers of the model outside the ranges of a recipe.
  std::vector<Problem> out_of_range(const Where& where) const {
    std::vector<Problem> found;
    // The model was computed (magnified), so its numbers have not passed a reader's range checks.
    for (const Field& f : recipe_fields()) {
      if (f.kind != FieldKind::quantity && f.kind != FieldKind::number && f.kind != FieldKind::integer)
        continue;
      // A rock without layers has no set, whose numbers could be asked.
      const std::size_t n = f.table == "bedding" ? rock_.model.bedding.size() : 1;
      for (std::size_t i = 0; i < n; ++i)
        if (!within_range(f, f.get(rock_.model, i)))
          found.push_back({where(f.path()), f.path(), print_field(f, rock_.model, i), range_text(f), ""});
    }
    return found;
  }
  /// Grains too large or too small for a specimen are one mistake, whatever key of the recipe tells it.
  Problem problem_of_grains(const Problem& told) const {
    const bool too_many =
        told.key.starts_with("packing.") && rock_.model.packing.n_grains > PackingRecipe().n_grains;
    return {file_.place("grain_size"), "grain_size",
            print_quantity(file_.number("grain_size", 0.0), Dimension::length),
            fmt::format("grains that suit the specimen and its planes ({} = {}: {})", told.key, told.value,
                        told.expected.empty() ? told.remedy : told.expected),
            too_many ? "state larger grains, or leave it out" : "state smaller grains, or leave it out"};
  }
  bool about_grains(const std::string& key) const {
    return is_given("grain_size") && key.starts_with("packing.");
  }
  /// What `phyllite run` would refuse: the recipe's own ranges and checks, after all of the rock file.
  void check_model() {
    const Where where = [&](const std::string& path) { return file_.place(said_here(path)); };
    std::vector<Problem> found = out_of_range(where);
    // Keys that are out of range take no part in the cross checks: their messages would be consequences.
    std::set<std::string> odd;
    for (const Problem& p : found) odd.insert(p.key);
    const auto cross = [&](bool with_grains) {
      return cross_checks(rock_.model, where, [&](const std::string& key) {
        return !odd.contains(key) && (with_grains || !about_grains(key));
      });
    };
    // A check names the grains where it is about them.
    std::vector<Problem> of_grains = found, all = cross(true), others = cross(false);
    std::erase_if(of_grains, [&](const Problem& p) { return !about_grains(p.key); });
    std::erase_if(found, [&](const Problem& p) { return about_grains(p.key); });
    // Both runs tell what they find in one order, so that whatever only the first has is about the grains.
    for (std::size_t i = 0, next = 0; i < all.size(); ++i)
      if (next < others.size() && to_line(all[i]) == to_line(others[next]))
        ++next;
      else
        of_grains.push_back(all[i]);
    std::move(others.begin(), others.end(), std::back_inserter(found));
    // One of them is enough: the others follow from the same wrong size.
    if (!of_grains.empty()) found.push_back(problem_of_grains(of_grains.front()));
    for (Problem& p : found) {
      const std::string key = said_here(p.key);
      // The user wrote the key of the rock file: it is named in place of the recipe's.
      if ((key.starts_with("brazilian.") || key == "bedding.spacing") && is_given(key)) p.key = key;
      if (key.starts_with("specimen."))
        p.remedy =
            "[specimen] magnifies the paper's specimen, grains and all: nearer to its shape, 1 : 2, or a "
            "recipe with grains of its own";
      problems_.push_back(std::move(p));
    }
  }
  /// The same for every disc of the table.
  void check_discs() {
    const bool grains_told = std::any_of(problems_.begin(), problems_.end(),
                                         [](const Problem& p) { return p.key == "grain_size"; });
    const auto known = [&](const std::string& key) { return !grains_told || !about_grains(key); };
    // Without a diameter of its own the disc is the model's, which has been checked.
    for (const RockReading& r : rock_.readings) {
      if (!measured(r.property).of_discs || r.diameter == 0.0) continue;
      Recipe disc = rock_.model;
      disc.test.disc_diameter = r.diameter;
      disc.test.kind = TestKind(measured(r.property).test);
      std::string where = table_ + ":" + std::to_string(r.line);
      // Everything but the diameter is the model again.
      for (Problem& p : cross_checks(
               disc, [&](const std::string&) { return where; }, known))
        if (p.key == "test.disc_diameter") p.key = "diameter", problems_.push_back(std::move(p));
    }
  }

  void read_table() {
    const auto is_data = [](const Problem& p) { return p.key == "data"; };
    if (!is_given("data") && std::ranges::none_of(problems_, is_data))
      problems_.push_back({path_, "data", "", "the name of the table of tests",
                           "write data = \"tests.csv\"; `phyllite rock new` writes both files"});
    if (!is_given("data") || !file_.is_known("data")) return;
    table_ = parts_.table ? file_.text("data", "") : file_.beside(file_.text("data", ""));
    const std::size_t n_before = problems_.size();
    TableKeys keys{file_.number("confining", nan), file_.text("sheet", ""), columns(), {}};
    if (is_given("bedded")) keys.bedded = file_.number("bedded", 1.0) == 1.0;
    auto readings = file_.read_named("data", [&](const std::string& table) {
      return parse_readings(parts_.table ? *parts_.table : io::read_file(table, largest_table), table_, keys,
                            problems_, rock_.notes);
    });
    if (!readings) return;
    rock_.readings = std::move(readings->values);
    rock_.counts_from_load = readings->counts_from_load;
    settle_E_is(*readings);
    settle_bedding(*readings);
    // Statements about the whole table need all of it.
    if (problems_.size() == n_before) check_content(table_), check_toughness();
  }

  /// A column of angles means bedding, unless the file says otherwise.
  void settle_bedding(const Readings& readings) {
    const bool has_angles = readings.bedded;
    rock_.bedded = file_.number("bedded", has_angles ? 1.0 : 0.0) == 1.0;
    if (rock_.bedded && !has_angles)
      problems_.push_back(
          {table_, "theta", "", "a column of angles, theta or beta", "or write bedded = false"});
    // An empty table, or a column that is asked for already, has a message of its own.
    else if (!rock_.readings.empty() && !has_angles && !is_given("bedded") && !readings.asked_for_angles)
      problems_.push_back(
          {table_, "", "", "",
           "no column of angles: all rows would be one rock without layers. If it has layers, "
           "add theta [deg]; if not, write bedded = false in the rock file"});
    if (!rock_.bedded)
      take_layers_away(has_angles);
    else if (!is_given("bedding.spacing") && !(is_given("recipe") && has_layers_) &&
             rock_.layers != LayerModel::directions)
      rock_.notes.push_back(
          fmt::format("the distance of the layers is not given: {:g} mm is taken ([bedding] spacing says it)",
                      rock_.model.bedding[0].spacing * 1e3));
  }

  /// Angles of a rock without bedding have no meaning: all rows become replicates.
  void take_layers_away(bool has_angles) {
    remove_layers(rock_.model), rock_.model.test.angles.clear();
    // Under this word the list of models has rock without layers.
    rock_.layers = LayerModel::planes;
    // A table without angles has a message of its own.
    for (const char* key : {"bedding.spacing", "layers"})
      if (is_given(key) && is_given("bedded"))
        problems_.push_back({file_.place(key), key, "", "a rock with bedding",
                             "bedded = false says otherwise: leave it out"});
    // Cells are told apart by the angle: left in, it would split one rock into several.
    for (RockReading& r : rock_.readings) r.theta = 0.0;
    const auto sheared = std::find_if(rock_.readings.begin(), rock_.readings.end(),
                                      [](const auto& r) { return measured(r.property).along_bedding; });
    if (sheared != rock_.readings.end())
      problems_.push_back({table_ + ":" + std::to_string(sheared->line), to_string(sheared->property), "",
                           "a rock with bedding",
                           "bedding is what shears: take such rows out, or give the others their theta"});
    rock_.notes.emplace_back("a rock without bedding");
    if (has_angles) rock_.notes.emplace_back("the angles of the table are not used, since bedded = false");
  }

  void check_toughness() {
    bool any = false, compressed = false;
    for (const RockReading& r : rock_.readings) {
      compressed = compressed || is_compressive(r.property);
      any = any || (r.property == Property::fracture_toughness && r.confining == 0.0);
    }
    if (any && !compressed)
      rock_.notes.emplace_back(
          "K_Ic is kept, not used: without a strength in compression no strength is calibrated");
    if (any && compressed && !rock_.grains_stated)
      rock_.notes.emplace_back(
          "K_Ic is not fitted: at the same strengths a model's grows with the root of the grains' size. "
          "State them to have it fitted: grain_size = \"1.2 mm\" (how many grains that makes is "
          "said), or a recipe");
  }
  /// The headers that the file names, with our names for them.
  std::map<std::string, std::string> columns() {
    std::map<std::string, std::string> named;
    const Field& field = *find_field(rock_schema().fields, "columns.\"header\"");
    for (const io::TomlValue* table : file_.tables("columns"))
      for (std::size_t i = 0; i < table->keys.size(); ++i) {
        double choice = 0.0;
        std::string remedy;
        if (io::take_value(field, table->items[i], choice, remedy))
          named[table->keys[i].name] = field.choices[static_cast<std::size_t>(choice)];
        else
          file_.report_problem(table->items[i], "columns.\"" + table->keys[i].name + '"', range_text(field),
                               remedy);
      }
    return named;
  }
  /// A header may say what E is; the file may not say otherwise.
  void settle_E_is(const Readings& readings) {
    // To some laboratories E50 is a tangent, to others a secant: the name tells nothing, so the choice is
    // said.
    if (readings.E_title == "E50" && !is_given("E_is"))
      rock_.notes.push_back(
          fmt::format("E50 is taken as \"{}\"; a secant is E_is = \"secant 50 %\"", to_string(rock_.E_is)));
    if (!readings.E_is || !file_.is_known("E_is")) return;
    if (!is_given("E_is")) {
      rock_.E_is = *readings.E_is;
      rock_.notes.push_back(
          fmt::format("E_is = \"{}\", as the header {} says", to_string(rock_.E_is), readings.E_title));
    } else if (rock_.E_is != *readings.E_is) {
      file_.report_problem(
          *file_.find("E_is"), "E_is",
          fmt::format("what the header {} says, \"{}\"", readings.E_title, to_string(*readings.E_is)),
          "change one of the two: they are different moduli");
    }
  }
  void check_content(const std::string& where) {
    std::set<double> angles;
    bool nu = false, E = false;
    std::set<Property> kept;  // of tests that no calibration does
    for (const RockReading& r : rock_.readings) {
      // Direct shear stands at 0 by convention, which is no inclination that was tested.
      if (!measured(r.property).along_bedding) angles.insert(r.theta);
      // Said, because such a row is a value of the table and yet not found in the result.
      if (r.confining > 0.0 && !measured(r.property).under_stress) kept.insert(r.property);
      nu = nu || r.property == Property::nu, E = E || r.property == Property::E;
    }
    if (rock_.readings.empty())
      problems_.push_back({where, "", "", "at least one value", "all cells are empty: fill in the table"});
    else if (rock_.bedded && angles.size() < least_angles)
      problems_.push_back({where, "theta", fmt::format("{} angle(s)", angles.size()),
                           "at least three angles for a bedded rock", "test 0, 45 and 90 degrees"});
    for (const Property p : kept)
      rock_.notes.push_back(fmt::format("{} under confining pressure is kept, not fitted", to_string(p)));
    for (const MeasuredProperty& p : measured_properties())
      if (p.share != 1.0 && std::any_of(rock_.readings.begin(), rock_.readings.end(),
                                        [&](const RockReading& r) { return r.property == p.property; }))
        rock_.notes.push_back(fmt::format("{}: {}", p.name, p.meaning));
    if (rock_.reading == ElasticReading::plane_strain && E && !nu)
      problems_.push_back({path_, "elastic_reading", "plane strain", "a column nu",
                           "plane strain cannot be converted without it"});
    // Converting plane strain readings uses nu, and too large a nu leaves no positive E.
    // On the means, as they are fitted: one odd specimen does not spoil a cell.
    for (const Target& t : of_property(targets_of(rock_), Property::E))
      if (!(t.mean > 0.0))
        problems_.push_back({where, "nu", "", fmt::format("a nu that leaves E({:g}) positive", t.theta),
                             "nu along the bedding is too large to be read as plane strain"});
  }
};

}  // namespace

Rock read_rock(const std::string& path) {
  return parse_rock(io::read_user_file(path, rock_schema().name), path, {});
}

Rock parse_rock(std::string_view text, const std::string& path, const RockParts& parts) {
  Rock rock;
  RockReader(text, path, parts, rock).read();
  return rock;
}

Rock rock_of(io::TomlValue keys, const std::string& where, const RockParts& parts) {
  Rock rock;
  RockReader(std::move(keys), where, parts, rock).read();
  return rock;
}

}  // namespace phy::rock
