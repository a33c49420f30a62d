#include "report/page.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "base/check.hpp"
#include "base/embedded.hpp"
#include "base/quote.hpp"
#include "base/units.hpp"
#include "io/base64.hpp"
#include "io/scene.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "records/test_description.hpp"
#include "report/curves.hpp"
#include "report/methods.hpp"
#include "report/palette.hpp"

namespace phy::report {
namespace {

using Json = nlohmann::ordered_json;

template <class T, class Items, class Value>
std::string packed(const Items& items, Value value) {
  std::vector<T> numbers;
  for (const auto& item : items) numbers.push_back(static_cast<T>(value(item)));
  return io::base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

/// Growing while the test loads, whatever the kind of test.
Json history_json(const History& history, const TestCurve& axes) {
  return {{"strain", packed<double>(history.rows, [&](const HistoryRow& r) { return axes.strain_of(r); })},
          {"stress", packed<double>(history.rows, [&](const HistoryRow& r) { return axes.stress_of(r); })}};
}

Json axes_json(const TestDescription& test) {
  const TestCurve& a = test.curve;
  const TestQuantity made_for = a.quantity();
  return {{"strain", a.strain},
          {"strain_unit", a.strain_unit},
          {"strain_factor", a.strain_factor},
          {"stress", a.stress},
          {"sign", a.sign},
          {"strength", a.strength},
          {"strength_label", a.strength_label},
          {"quantity",
           {{"number", made_for.number},
            {"label", made_for.label},
            {"unit", made_for.unit},
            {"factor", made_for.scale}}},
          {"property", test.property() ? to_string(*test.property()) : ""}};
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
  const Rose rose = crack_rose(t.result.cracks);
  const TestCurve& axes = t.recipe.test.kind->curve;
  Json bedding = Json::array();
  for (std::size_t i = 0; i < t.bedding.size() && i < t.recipe.bedding.size(); ++i)
    // Other planes, and layers about planes, are not drawn by these numbers.
    if (t.recipe.bedding[i].is_regular() && t.recipe.bedding[i].layer_thickness == 0.0)
      bedding.push_back({{"theta", t.bedding[i].theta},
                         {"spacing", t.recipe.bedding[i].spacing},
                         {"offset", t.recipe.bedding[i].offset}});
  return {{"result", Json::parse(io::result_json(t))},
          {"label", t.result.intact ? "intact" : print_number(t.result.theta) + "°"},
          {"history", history_json(t.result.history, axes)},
          {"cracks", cracks_json(t.result.cracks, axes.sign)},
          {"rose", {{"bin", rose.bin()}, {"tension", rose.tension}, {"shear", rose.shear}}},
          {"bedding", bedding},
          {"scene", t.scene.frames.empty() ? Json(nullptr) : Json("scene-" + std::to_string(index))}};
}

Json curve_json(const AngleCurve& c) { return {{"note", c.note}, {"theta", c.theta}, {"value", c.value}}; }

Json target_json(const Target& t) {
  return {
      {"property", to_string(t.property)}, {"theta", t.theta}, {"mean", t.mean}, {"sd", t.sd}, {"n", t.n}};
}

Json spread_json(double at, const Summary& s) {
  return {{"at", at}, {"mean", s.mean}, {"half", s.half_width}};
}

Json angles_json(const std::vector<AngleValue>& values) {
  Json j = Json::array();
  for (const AngleValue& v : values)
    if (v.value.n > 0) j.push_back(spread_json(v.theta, v.value));
  return j;
}

Json variation_json(const Variation& v) {
  Json parameters = Json::array();
  for (const VariedParameter& p : v.parameters) {
    Json settings = Json::array(), K_n = Json::array(), K_s = Json::array();
    for (const VariedSetting& s : p.settings)
      settings.push_back(
          {{"text", s.text}, {"base", s.base}, {"E", angles_json(s.E)}, {"ucs", angles_json(s.ucs)}});
    for (const MacroPoint& m : macro_points(v, p)) {
      if (m.K_n.n > 0) K_n.push_back(spread_json(m.factor, m.K_n));
      if (m.K_s.n > 0) K_s.push_back(spread_json(m.factor, m.K_s));
    }
    parameters.push_back({{"key", p.key}, {"settings", settings}, {"K_n", K_n}, {"K_s", K_s}});
  }
  return {{"name", v.name}, {"parameters", parameters}};
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
  j["program"] = run.tests.empty() ? std::string("phyllite ") + PHY_VERSION : first.program;
  j["axes"] = axes_json(*first.recipe.test.kind);
  j["done"] = done_json(first.recipe);
  j["tests"] = Json::array();
  for (std::size_t i = 0; i < run.tests.size(); ++i) j["tests"].push_back(test_json(run.tests[i], i));
  j["missing"] = Json::array();
  for (const MissingTest& m : run.missing) j["missing"].push_back({{"name", m.name}, {"reason", m.reason}});
  const bool of_table = run.tests.empty() || !extras.calibration.empty();  // else of what was tested
  const TheoryCurves curves = of_table ? theory_curves(extras.laboratory) : theory_curves(run);
  j["curves"] = {{"E", curve_json(curves.E)}, {"nu", curve_json(curves.nu)}, {"ucs", curve_json(curves.ucs)}};
  j["laboratory"] = Json::array();
  for (const Target& t : beside(run, extras.laboratory)) j["laboratory"].push_back(target_json(t));
  j["calibration"] = extras.calibration.empty() ? Json(nullptr) : Json::parse(extras.calibration);
  j["variations"] = Json::array();
  if (extras.variation) j["variations"].push_back(variation_json(*extras.variation));
  j["effects"] = extras.effects;
  j["methods"] = j["calibration"].is_object() ? j["calibration"].value("methods", Json::array())
                                              : Json(methods_text(run));
  j["recipe"] = !extras.recipe.empty() ? extras.recipe
                : run.tests.empty()    ? ""
                                       : io::write_recipe(first.recipe);
  return j;
}

}  // namespace

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
