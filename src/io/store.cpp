#include "io/store.hpp"

#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/units.hpp"
#include "io/new_folder.hpp"
#include "io/scene.hpp"
#include "io/toml_in.hpp"
#include "io/vtk.hpp"
#include "records/quality.hpp"
#include "records/recipe_schema.hpp"

namespace phy::io {
namespace {

using Json = nlohmann::ordered_json;

/// A value that is NaN is written as null.
Json number_json(const Number& n) {
  Json j = {{"value", n.value}, {"unit", n.unit}, {"definition", n.definition}};
  // null alone would leave the reader in doubt whether something is missing.
  if (!n.note.empty())
    j["note"] = n.note;
  else if (!std::isfinite(n.value))
    j["note"] = "could not be determined";
  if (n.upper_bound) j["upper_bound"] = true;
  return j;
}

/// One key of the recipe as a JSON value, in the unit that its name there carries.
Json field_json(const Field& f, const Recipe& recipe, std::size_t index) {
  switch (f.kind) {
    case FieldKind::text: return f.get_text(recipe);
    case FieldKind::boolean: return f.get(recipe, index) != 0.0;
    case FieldKind::choice: return f.choices[static_cast<std::size_t>(f.get(recipe, index))];
    case FieldKind::integer: return static_cast<std::int64_t>(f.get(recipe, index));
    case FieldKind::quantities: {
      // f.list returns a reference to change; the recipe is constant.
      Recipe copy = recipe;
      return f.list(copy);
    }
    default: return f.get(recipe, index);
  }
}

Json recipe_json(const Recipe& recipe) {
  Json j;
  // Made first, so that the list exists also without bedding.
  j["bedding"] = Json::array();
  for (std::size_t i = 0; i < recipe.bedding.size(); ++i) j["bedding"].push_back(Json::object());
  for (const Field& f : recipe_fields()) {
    const std::string key =
        f.dimension == Dimension::none ? f.key : f.key + " [" + inner_unit(f.dimension) + "]";
    if (f.table == "bedding")
      for (std::size_t i = 0; i < recipe.bedding.size(); ++i) {
        if (is_written(f, recipe, i)) j["bedding"][i][key] = field_json(f, recipe, i);
      }
    else
      (f.table.empty() ? j : j[f.table])[key] = field_json(f, recipe, 0);
  }
  return j;
}

/// The grade and every measure beyond its limit, with value, limit and advice: readers in other programs do
/// not have the list of limits.
Json quality_json(const TestResult& result) {
  const std::vector<QualityMark> marks = quality_marks(result.numbers);
  Json j = {{"grade", to_string(grade_of(result))}, {"marks", Json::array()}};
  for (const QualityMark& m : marks)
    j["marks"].push_back({{"number", m.limit->number},
                          {"value", m.value},
                          {"limit", m.bound()},
                          {"least", m.limit->least},
                          {"grade", to_string(m.grade)},
                          {"of", m.limit->of},
                          {"says", m.text()},
                          {"meaning", m.limit->says},
                          {"advice", m.limit->advice}});
  return j;
}

Json packing_json(const SpecimenRecord& record) {
  const PackingReport& r = record.packing;
  return {{"hash", record.packing_hash}, {"n_grains", record.n_grains},
          {"porosity", r.porosity},      {"coordination", r.coordination},
          {"fabric", r.fabric},          {"stress_left [Pa]", r.stress_left},
          {"n_rattlers", r.n_rattlers},  {"mean_overlap", r.mean_overlap},
          {"unbalanced", r.unbalanced},  {"stress_free", record.stress_free}};
}

Json bedding_json(const std::vector<BeddingRecord>& bedding) {
  Json j = Json::array();
  for (const BeddingRecord& b : bedding)
    if (b.report.dispersed)
      j.push_back({{"theta [deg]", b.theta}, {"joint_fraction", b.report.joint_fraction}});
    else
      j.push_back({{"theta [deg]", b.theta},
                   {"overlap_ratio", b.report.overlap_ratio},
                   {"bridge_fraction", b.report.bridge_fraction},
                   {"non_crossing_fraction", b.report.non_crossing_fraction}});
  return j;
}

void add_snapshots(NewFolder& folder, const Recipe& recipe, const Packing& packing,
                   const TestResult& result) {
  std::vector<std::pair<double, std::string>> grains, contacts;
  for (std::size_t i = 0; i < result.snapshots.size(); ++i) {
    const Snapshot& shot = result.snapshots[i];
    const std::string n = std::to_string(i);
    grains.emplace_back(shot.axial_strain, "snapshots/grains_" + n + ".vtp");
    contacts.emplace_back(shot.axial_strain, "snapshots/contacts_" + n + ".vtp");
    folder.add(grains.back().second, grains_vtp(packing, shot));
    folder.add(contacts.back().second, contacts_vtp(packing, shot));
  }
  folder.add("snapshots/cracks.vtp", cracks_vtp(result.cracks, result.history.kind));
  if (recipe.test.events) folder.add("snapshots/events.vtp", events_vtp(result.events, result.history.kind));
  folder.add("grains.pvd", collection_pvd(grains));
  folder.add("contacts.pvd", collection_pvd(contacts));
}

}  // namespace

std::string folder_name(const std::string& name) {
  // Blanks and other characters that need quoting in a shell become one underscore.
  std::string folder;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.')
      folder += c;
    else if (!folder.ends_with('_'))
      folder += '_';
  return folder;
}

std::string result_json(const SpecimenRecord& record) {
  const TestResult& result = record.result;
  Json j;
  j["format"] = result_format;
  j["program"] = record.program;
  j["specimen"] = result.name;
  if (!result.intact) j["theta [deg]"] = result.theta;
  j["outcome"] = {{"status", to_string(result.outcome.status)},
                  {"reason", result.outcome.reason},
                  {"advice", result.outcome.advice}};
  j["quality"] = quality_json(result);
  j["numbers"] = Json::object();
  for (const Number& n : result.numbers) j["numbers"][n.name] = number_json(n);
  j["packing"] = packing_json(record);
  j["bedding"] = bedding_json(record.bedding);
  j["run"] = {{"dt [s]", result.dt},
              {"n_steps", result.n_steps},
              {"n_contacts", result.n_contacts},
              {"n_cracks", result.cracks.size()},
              {"cpu_seconds", result.seconds},
              {"platen_speed [m/s]", record.recipe.test.platen_speed}};
  j["result_hash"] = result.hash;
  // The recipe twice: as the text that runs again, and below as values in SI units for other programs.
  j["recipe"] = write_recipe(record.recipe);
  j["recipe_values"] = recipe_json(record.recipe);
  // Texts may hold bytes that are no UTF-8 (a name from a file system): replaced, so that the file is valid
  // JSON.
  return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

const std::vector<FileObject>& result_keys() {
  static const std::vector<FileObject> objects = {
      {"file",
       {{"format", "version of this file"},
        {"program", "name and version"},
        {"specimen", "its name"},
        {"theta [deg]", "angle of the first bedding set, else of the foliation; absent for intact rock"},
        {"outcome", "how the test ended", "outcome"},
        {"quality", "how far to believe it", "quality"},
        {"numbers", "by name", "numbers"},
        {"packing", "discs before the test", "packing"},
        {"bedding", "per set of planes", "set"},
        {"run", "counts and times", "run"},
        {"result_hash",
         "FNV-1a over the bits of history, cracks and final positions; not over times or threads"},
        {"recipe", "the completed recipe as TOML text"},
        {"recipe_values",
         "the same as values: SI and degrees, the unit in the key, `\"width [m]\": 0.038`"}}},
      {"outcome",
       {{"status", "[all outcomes](what-went-wrong.md)"}, {"reason", "why"}, {"advice", "what to change"}}},
      {"quality",
       {{"grade", "good, warning, untrusted, not assessed, no result"},
        {"marks", "measures beyond a limit", "mark"}}},
      {"mark",
       {{"number", "the measure"},
        {"value", "measured"},
        {"limit", "that it is beyond"},
        {"least", "the limit is a least value"},
        {"grade", "warning or untrusted"},
        {"of", "numbers that it concerns; empty: the whole test"},
        {"says", "the mark as a sentence"},
        {"meaning", "what is wrong"},
        {"advice", "what to change"}}},
      {"numbers", {{"*", "a number of the test", "number"}}},
      {"number",
       {{"value", "null: see `note`"},
        {"unit", "SI or degrees"},
        {"definition", "how it is read"},
        {"note", "why there is no value, or what it is"},
        {"upper_bound", "the value is one; `note` says why"}}},
      {"packing",
       {{"hash", "of the discs"},
        {"n_grains", "number of discs"},
        {"porosity", "share of voids"},
        {"coordination", "mean number of touching neighbours"},
        {"fabric", "mean of cos 2 angle of the contact normals; 0 is isotropic"},
        {"stress_left [Pa]", "locked-in stress"},
        {"n_rattlers", "discs without load"},
        {"mean_overlap", "mean overlap over mean radius"},
        {"unbalanced", "mean unbalanced force over mean contact force"},
        {"stress_free", "overlaps of the packing count as zero force"}}},
      {"set",
       {{"theta [deg]", "angle of the set"},
        {"overlap_ratio", "contact length of the joints of a plane over its length"},
        {"bridge_fraction", "of the contacts that cross a plane, share that is no joint"},
        {"non_crossing_fraction", "of the joints, share whose grains lie on one side"},
        {"joint_fraction", "of an oriented set: contacts that are joints"}}},
      {"run",
       {{"dt [s]", "time step"},
        {"n_steps", "cycles"},
        {"n_contacts", "bonded, joint or touching at the start"},
        {"n_cracks", "at the end"},
        {"cpu_seconds", "of this test"},
        {"platen_speed [m/s]", "of each platen"}}}};
  return objects;
}

void check_result_place(const std::string& folder) { check_place(folder, "result.json", "result"); }

void write_result(const std::string& folder, const Recipe& recipe, const std::string& version,
                  const Specimen& specimen, const TestResult& result) {
  NewFolder place(folder, "result.json", "result");
  place.add("recipe.toml", write_recipe(recipe));
  place.add("history.csv", history_csv(result.history));
  place.add("cracks.csv", cracks_csv(result.cracks, result.history.kind));
  if (recipe.test.events) place.add("events.csv", events_csv(result.events, result.history.kind));
  if (!result.wall.empty()) place.add("opening.csv", wall_csv(result.wall));
  add_snapshots(place, recipe, *specimen.packing, result);
  const SpecimenRecord record = record_of(recipe, version, specimen, result);
  place.add("scene.bin", pack_scene(record.scene, result.history.kind));
  // The folder appears as a whole with publish(), whatever the order of files.
  place.add("result.json", result_json(record));
  place.publish();
}

}  // namespace phy::io
