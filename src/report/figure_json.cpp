#include "report/figure_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "report/palette.hpp"

namespace phy::report {
namespace {

using Json = nlohmann::ordered_json;

// web/src/figure.ts reads these words; a number would change its meaning with the order of the enumeration.
constexpr std::array<const char*, 7> marks = {"line", "points", "dots", "text", "band", "boxes", "area"};
constexpr std::array<const char*, 17> roles = {
    "ordered", "listed",   "plain",  "model",  "bare",  "laboratory", "specimen", "interval", "between",
    "theory",  "left_out", "intact", "others", "level", "crack",      "bedding",  "frame"};
constexpr std::array<const char*, 3> keys = {"none", "shared", "inside"};

Json number_json(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

/// To as many digits as a chart can show: all others would only make pages longer.
Json column(const Series& s, double Point::*value) {
  Json numbers = Json::array();
  bool any = false;
  for (const Point& p : s.points) {
    const double v = p.*value;
    any = any || std::isfinite(v);
    numbers.push_back(
        number_json(std::isfinite(v) ? std::strtod(fmt::format("{:.7g}", v).c_str(), nullptr) : v));
  }
  // A column without any number is left empty: most series have no intervals.
  return any ? numbers : Json::array();
}

Json axis_json(const Axis& a) {
  return {{"quantity", a.quantity},
          {"unit", a.unit},
          {"low", number_json(a.low)},
          {"high", number_json(a.high)},
          {"step", a.step},
          {"logarithmic", a.logarithmic},
          {"names", a.names}};
}

Json series_json(const Series& s) {
  Json texts = Json::array();
  // All or none: the page reads columns of equal length.
  if (std::any_of(s.points.begin(), s.points.end(), [](const Point& p) { return !p.text.empty(); }))
    for (const Point& p : s.points) texts.push_back(p.text);
  return {{"name", s.name},
          {"mark", marks.at(static_cast<std::size_t>(s.mark))},
          {"role", roles.at(static_cast<std::size_t>(s.role))},
          {"number", s.number},
          // The colour of print, so that the page does not choose another.
          {"color", hex_color(paper_color(s.role, s.number, s.shade))},
          {"shade", number_json(s.shade)},
          {"strong", s.strong},
          {"right", s.right},
          {"width", s.width},
          {"item", s.item},
          {"x", column(s, &Point::x)},
          {"y", column(s, &Point::y)},
          {"low", column(s, &Point::low)},
          {"high", column(s, &Point::high)},
          {"text", texts}};
}

}  // namespace

Json figure_json(const Figure& figure) {
  Json panels = Json::array();
  for (const Panel& p : figure.panels) {
    Json series = Json::array();
    for (const Series& s : p.series)
      if (!s.points.empty()) series.push_back(series_json(s));
    panels.push_back({{"title", p.title},
                      {"caption", p.caption},
                      {"x", axis_json(p.x)},
                      {"y", axis_json(p.y)},
                      {"right", p.right ? axis_json(*p.right) : Json(nullptr)},
                      {"series", series},
                      {"framed", p.framed},
                      {"aside", p.aside}});
  }
  return {
      {"panels", panels}, {"key", keys.at(static_cast<std::size_t>(figure.key))}, {"aspect", figure.aspect}};
}

}  // namespace phy::report
