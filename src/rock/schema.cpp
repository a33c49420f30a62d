#include "rock/schema.hpp"

#include <initializer_list>

#include "io/file_kinds.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"
#include "records/rock.hpp"
#include "rock/columns.hpp"

namespace phy::rock {
namespace {

Field rock_key(FieldKind kind, const char* key, const char* meaning) {
  Field f;
  f.kind = kind, f.key = key, f.meaning = meaning;
  return f;
}

/// A key of the recipe under another name: unit and range stand there.
Field as_in_recipe(const char* path, const char* table, const char* key, const char* meaning) {
  Field f = *find_field(recipe_fields(), path);
  f.table = table, f.key = key, f.meaning = meaning, f.pfc_name.clear();
  return f;
}

Field choice(const char* key, const char* meaning) { return rock_key(FieldKind::choice, key, meaning); }

template <class Enum>
std::vector<std::string> words_of_all(std::initializer_list<Enum> all) {
  std::vector<std::string> words;
  for (const Enum one : all) words.emplace_back(to_string(one));
  return words;
}

Field without_default(Field f) {
  f.default_text.clear();
  return f;
}

Field report_key(const char* key, const char* meaning) {
  Field f = rock_key(FieldKind::text, key, meaning);
  f.table = "report";
  return f;
}

Field column_key() {
  Field f = rock_key(FieldKind::choice, "\"header\"",
                     "what a column of the table holds, by its header; \"-\" passes it over");
  f.table = "columns", f.choices = column_names(), f.choices.emplace_back("-");
  return f;
}

const Fields& rock_fields() {
  using K = FieldKind;
  static const Fields fields = {
      rock_key(K::text, "name", "name of the rock; default: the file's name"),
      rock_key(K::text, "data", "table of tests (CSV, .xlsx, AGS 4), counted from the folder of this file"),
      rock_key(K::text, "sheet",
               "of a workbook, default: the first; of an AGS 4 file its group, default: RUCS"),
      rock_key(K::text, "recipe",
               "recipe of the model that is calibrated; default: the paper's specimen, magnified to "
               "[specimen]"),
      choice("elastic_reading", "how moduli of cylinders are read in two dimensions")
          .one_of({"plane stress", "plane strain"})
          .by_default("\"plane stress\""),
      choice("E_is",
             "slope that the table's E is; with neither UCS nor E under confinement it is compared at small "
             "strain")
          .one_of(
              words_of_all({ModulusReading::tangent_50, ModulusReading::average, ModulusReading::secant_50,
                            ModulusReading::secant_at_peak, ModulusReading::small_strain}))
          .by_default("\"tangent 50 %\""),
      choice("layers",
             "model of the layers: joints on planes, directions of the bonds, both, or rock bridges; "
             "\"choose\": the best predictor")
          .one_of(words_of_all({LayerModel::choose, LayerModel::planes, LayerModel::directions,
                                LayerModel::planes_and_directions, LayerModel::planes_with_bridges}))
          .by_default("\"choose\""),
      choice(
          "matrix",
          "bonds of the grains; flat joints where UCS is many times the tension; with a recipe the recipe's")
          .one_of({"choose", "parallel_bond", "flat_joint"})
          .by_default("\"choose\""),
      without_default(as_in_recipe(
          "test.confining_stress", "", "confining",
          "takes E and nu under this confining pressure alone; default: under all of the table")),
      without_default(as_in_recipe(
          "packing.radius_min", "", "grain_size",
          "mean diameter of the model's grains; default: as many as in the paper's specimen. K_Ic is fitted "
          "only with it or a recipe")),
      without_default(
          as_in_recipe("packing.seed", "", "first_packing",
                       "seed of the first packing of the calibration; another one shows how far its result "
                       "hangs on packings. Default: the recipe's, else 1")),
      rock_key(K::boolean, "bedded", "the rock has bedding; default: where the table has angles"),
      as_in_recipe("specimen.width", "specimen", "width", "width of the specimens of compression"),
      as_in_recipe("specimen.height", "specimen", "height", "their height, along the load"),
      as_in_recipe("bedding.spacing", "bedding", "spacing",
                   "distance of the planes; default: in proportion to the paper's specimen"),
      as_in_recipe("test.disc_diameter", "brazilian", "diameter",
                   "discs of the BTS column without a diameter of their own; 0: the specimen's smaller side"),
      as_in_recipe("test.loading_angle", "brazilian", "loading_angle", "arc of each jaw; 0: flat platens"),
      report_key("project", "what the report is for, on its first page"),
      report_key("client", "for whom it is, there"),
      report_key("laboratory", "who tested the rock, there"),
      report_key("author", "who wrote the report, there"),
      column_key()};
  return fields;
}

}  // namespace

const io::Schema& rock_schema() {
  static const io::Schema schema{"rock",
                                 "rock",
                                 rock_fields(),
                                 {},
                                 "a key of the recipe: write it there, and recipe = \"model.toml\" here"};
  return schema;
}

ReportHead report_head(const std::string& path) {
  // Not as a rock: what is wrong with its other keys is no matter of a report's first page.
  std::vector<Problem> none;
  const io::TomlValue root = io::parse_toml(io::read_user_file(path, rock_schema().name), path, none);
  ReportHead head;
  if (const io::TomlValue* data = root.find("data")) head.table = data->text;
  const io::TomlValue* report = root.find("report");
  if (report == nullptr) return head;
  for (const Field& f : rock_fields())
    if (const io::TomlValue* value = report->find(f.key);
        f.table == "report" && value != nullptr && value->kind == io::TomlValue::Kind::text)
      head.lines.emplace_back(f.key, value->text);
  return head;
}

}  // namespace phy::rock
