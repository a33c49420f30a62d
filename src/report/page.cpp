#include "report/page.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "base/check.hpp"
#include "base/embedded.hpp"
#include "base/quote.hpp"
#include "base/units.hpp"
#include "base/version.hpp"
#include "io/base64.hpp"
#include "io/scene.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "records/test_description.hpp"
#include "report/calibration_figures.hpp"
#include "report/event_figures.hpp"
#include "report/figure_json.hpp"
#include "report/methods.hpp"
#include "report/opening_figures.hpp"
#include "report/palette.hpp"
#include "report/run_figures.hpp"
#include "report/specimen_picture.hpp"
#include "report/variation_figures.hpp"

namespace phy::report {
namespace {

using Json = nlohmann::ordered_json;

template <class T, class Items, class Value>
std::string packed(const Items& items, Value value) {
  std::vector<T> numbers;
  for (const auto& item : items) numbers.push_back(static_cast<T>(value(item)));
  return io::base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

Json axes_json(const TestCurve& a) {
  return {{"strain", a.strain},
          {"strain_unit", a.strain_unit},
          {"strain_factor", a.strain_factor},
          {"sign", a.sign}};
}

/// Those of the test's table, the strain at the peak, cracks by kind, and the error of energy.
Json columns_json(const TestDescription& test) {
  std::vector<TableColumn> columns = test.table;
  const TestCurve& curve = test.curve;
  const std::string at_peak = curve.strain + " at peak";
  columns.push_back({at_peak.c_str(), curve.strain_unit.c_str(), "peak_strain", curve.strain_factor, 4});
  for (std::size_t kind = 0; kind < crack_names.size(); ++kind)
    columns.push_back({crack_names[kind], "cracks", crack_numbers[kind], 1.0, 0});
  columns.push_back({"energy error", "", "energy_error", 1.0, 5});
  Json j = Json::array();
  for (const TableColumn& c : columns)
    j.push_back({{"head", c.head},
                 {"unit", c.unit},
                 {"number", c.number},
                 {"scale", c.scale},
                 {"digits", c.digits},
                 {"made_for", c.number == curve.quantity().number}});
  return j;
}

Json cracks_json(const std::vector<CrackEvent>& cracks, double sign) {
  return {{"strain", packed<double>(cracks, [&](const CrackEvent& c) { return sign * c.strain; })},
          {"a", packed<std::uint32_t>(cracks, [](const CrackEvent& c) { return c.a; })},
          {"b", packed<std::uint32_t>(cracks, [](const CrackEvent& c) { return c.b; })},
          {"kind", packed<std::uint8_t>(cracks, crack_kind)},
          {"normal_x", packed<float>(cracks, [](const CrackEvent& c) { return c.normal.x; })},
          {"normal_y", packed<float>(cracks, [](const CrackEvent& c) { return c.normal.y; })},
          {"size", packed<float>(cracks, [](const CrackEvent& c) { return c.size; })}};
}

Json test_json(const SpecimenRecord& t, std::size_t index) {
  Json bedding = Json::array();
  for (std::size_t i = 0; i < t.bedding.size() && i < t.recipe.bedding.size(); ++i)
    // Other planes, and layers about planes, are not drawn by these numbers.
    if (t.recipe.bedding[i].is_regular() && t.recipe.bedding[i].layer_thickness == 0.0)
      bedding.push_back({{"theta", t.bedding[i].theta},
                         {"spacing", t.recipe.bedding[i].spacing},
                         {"offset", t.recipe.bedding[i].offset}});
  return {{"result", Json::parse(io::result_json(t))},
          {"label", t.result.intact ? "intact" : print_number(t.result.theta) + "°"},
          {"end", last_strain(t)},
          {"cracks", cracks_json(t.result.cracks, t.recipe.test.kind->curve.sign)},
          {"bedding", bedding},
          {"scene", t.scene.frames.empty() ? Json(nullptr) : Json("scene-" + std::to_string(index))}};
}

/// What the page draws, in its order; null: nothing of the kind.
Json figures_json(const RunRecord& run, const PageExtras& extras) {
  Json j = {{"calibration", nullptr}, {"study", nullptr}, {"stress_strain", nullptr}};
  if (extras.calibration) j["calibration"] = figure_json(calibration_figure(*extras.calibration));
  if (extras.variation) {
    Json parameters = Json::array();
    for (const VariedParameter& p : extras.variation->parameters)
      parameters.push_back({{"key", p.key}, {"figure", figure_json(parameter_figure(*extras.variation, p))}});
    j["study"] = {{"macro", figure_json(macro_figure(*extras.variation))}, {"parameters", parameters}};
  }
  if (run.tests.empty()) return j;
  j["stress_strain"] = figure_json(stress_strain_figure(run));
  j["damage"] = figure_json(damage_figure(run));
  j["anisotropy"] = figure_json(anisotropy_figure(run, extras.laboratory));
  j["modes"] = figure_json(modes_figure(run));
  j["rose"] = figure_json(rose_figure(run));
  j["events"] = figure_json(events_figure(run, {}));
  j["event_places"] = figure_json(event_places_figure(run));
  j["opening"] = figure_json(opening_figure(run));
  return j;
}

/// Measured properties as people read them.
Json properties_json() {
  Json j = Json::object();
  for (const MeasuredProperty& p : measured_properties())
    j[p.name] = {{"axis", p.axis}, {"unit", p.shown.name}, {"factor", p.shown.factor}};
  return j;
}

/// What was done, for a heading: several runs of one rock differ in it alone.
Json done_json(const Recipe& recipe) {
  const TestDescription& test = *recipe.test.kind;
  const KeptStress& kept = test.kept_stress;
  return {{"kind", test.name},
          {"kept", kept.value != nullptr ? Json(kept.key) : Json(nullptr)},
          {"stress", kept.value != nullptr ? recipe.test.*kept.value : 0.0}};
}

Json report_json(const RunRecord& run, const PageExtras& extras) {
  Json j;
  const SpecimenRecord none;
  const SpecimenRecord& first = run.tests.empty() ? none : run.tests.front();
  j["name"] = !extras.name.empty() ? extras.name : run.tests.empty() ? "no specimens" : first.recipe.name;
  j["program"] = run.tests.empty() ? std::string(phy::program) : first.program;
  j["head"] = extras.head;
  j["axes"] = axes_json(first.recipe.test.kind->curve);
  j["columns"] = columns_json(*first.recipe.test.kind);
  j["done"] = done_json(first.recipe);
  j["properties"] = properties_json();
  j["tests"] = Json::array();
  for (std::size_t i = 0; i < run.tests.size(); ++i) j["tests"].push_back(test_json(run.tests[i], i));
  j["missing"] = Json::array();
  for (const MissingTest& m : run.missing) j["missing"].push_back({{"name", m.name}, {"reason", m.reason}});
  j["figures"] = figures_json(run, extras);
  const auto parsed = [](const std::string& text) {
    return text.empty() ? Json(nullptr) : Json::parse(text);
  };
  j["calibration"] = parsed(extras.calibration_json);
  j["design"] = parsed(extras.design_json);
  j["effects"] = extras.effects;
  j["methods"] = j["calibration"].is_object() ? j["calibration"].value("methods", Json::array())
                                              : Json(methods_text(run));
  j["recipe"] = !extras.recipe.empty() ? extras.recipe
                : run.tests.empty()    ? ""
                                       : io::write_recipe(first.recipe);
  return j;
}

}  // namespace

Json specimens_json(const RunRecord& run) {
  Json list = Json::array();
  for (std::size_t i = 0; i < run.tests.size(); ++i) {
    const SpecimenRecord& t = run.tests[i];
    list.push_back(test_json(t, i));
    if (!t.scene.frames.empty())
      list.back()["scene"] = io::base64(io::pack_scene(t.scene, t.result.history.kind));
    list.back()["sign"] = t.recipe.test.kind->curve.sign;
  }
  return list;
}

std::string report_page(const RunRecord& run, const PageExtras& extras) {
  const std::string_view page = embedded("web/report.html");
  constexpr std::string_view place = "<!--data-->";
  const std::size_t at = page.find(place);
  PHY_CHECK(at != page.npos, "the page has a place for the data");
  std::string text(page.substr(0, at));
  const std::string data = report_json(run, extras).dump(-1, ' ', false, Json::error_handler_t::replace);
  text += "<script type=\"application/json\" id=\"report-data\">" + json_in_script(data) + "</script>\n";
  for (std::size_t i = 0; i < run.tests.size(); ++i)
    if (!run.tests[i].scene.frames.empty())
      text += "<script type=\"text/plain\" id=\"scene-" + std::to_string(i) + "\">" +
              io::base64(io::pack_scene(run.tests[i].scene, run.tests[i].result.history.kind)) +
              "</script>\n";
  return text.append(page.substr(at + place.size()));
}

}  // namespace phy::report
