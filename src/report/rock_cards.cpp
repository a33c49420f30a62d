#include "report/rock_cards.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/text_table.hpp"
#include "io/json.hpp"
#include "records/measured_property.hpp"

namespace phy::report {
namespace {

using Json = nlohmann::ordered_json;

Json parsed(std::string_view card) { return io::parse_json<Json>(card); }

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// "5.1 %", of an error of nu "0.02"; a range where several calibrations differ.
std::string error_text(const std::string& property, const std::vector<double>& values) {
  // Absolute, as its tolerance: a share of 0.2 would look like a gross error.
  const bool share = property != "nu";
  const double scale = share ? 100.0 : 1.0;
  const int digits = share ? 1 : 3;
  const auto [low, high] = std::ranges::minmax(values);
  std::string text = fmt::format("{:.{}f}", median(values) * scale, digits);
  if (values.size() > 1)
    text += fmt::format(" ({:.{}f} - {:.{}f})", low * scale, digits, high * scale, digits);
  return text + (share ? " %" : "");
}

/// "UCS and BTS, 7 angles".
std::string measured_text(const Json& card) {
  const Json& measured = card.at("measured");
  const std::string text =
      fmt::format("{}", fmt::join(measured.at("properties").get<std::vector<std::string>>(), ", "));
  const int angles = measured.at("angles");
  // Rock without layers has no angles.
  return angles == 0 ? text : fmt::format("{}; {} angles", text, angles);
}

/// Errors on unseen packings by property; empty: none.
Json errors_of(const Json& card) { return card.value("errors", Json::object()); }

std::string errors_text(const Json& card) {
  std::vector<std::string> items;
  const Json errors = errors_of(card);
  for (const auto& [property, values] : errors.items())
    items.push_back(fmt::format("{} {}", property, error_text(property, values.get<std::vector<double>>())));
  return items.empty() ? "-" : fmt::format("{}", fmt::join(items, ", "));
}

/// Of values left out: the model's error over the best curve's.
std::string ratios_text(const Json& card) {
  std::vector<std::string> items;
  const Json left_out = card.value("left_out", Json::object());
  for (const auto& [property, of] : left_out.items())
    if (const auto ratios = of.at("ratio").get<std::vector<double>>(); !ratios.empty())
      items.push_back(fmt::format("{} {:.2f}", property, median(ratios)));
  return items.empty() ? "-" : fmt::format("{}", fmt::join(items, ", "));
}

/// "UCS 45", "sigma_1 at 6 MPa, 45".
std::string cell_text(const Json& cell) {
  const double stress = cell.value("confining [Pa]", 0.0);
  std::string text = cell.at("property");
  if (stress > 0.0) text += fmt::format(" at {:g} MPa", stress * 1e-6);
  const Json& theta = cell.at("theta [deg]");
  return theta.is_null() ? text
                         : fmt::format("{}{} {:g}", text, stress > 0.0 ? "," : "", theta.get<double>());
}

/// How the model's specimens fail, a row per kind of test and angle.
std::string failure_text(const Json& card, int terminal_width) {
  std::vector<Json> rows;
  for (const Json& cell : card.value("cells", Json::array()))
    if (cell.contains("failure")) rows.push_back(cell);
  // A table of dashes would only push the verdict off the screen.
  const auto nothing = [](const Json& cell) {  // without bedding and without a plane
    return cell.at("failure").at("bedding_share").is_null() && cell.at("failure").at("planes") == 0;
  };
  if (std::ranges::all_of(rows, nothing)) return "";
  const auto number = [](const char* key, double unit) {
    return [key, unit](const Json& cell) {
      const Json& of = cell.at("failure");
      return !of.contains(key) || of.at(key).is_null()
                 ? std::string("-")
                 : fmt::format("{}", std::lround(of.at(key).get<double>() * unit));
    };
  };
  Column test = column_of("how the model fails", "", rows, cell_text);
  test.left = true;
  Columns columns = {column_of("cracks along bedding", "%", rows, number("bedding_share", 100.0)),
                     column_of("failure plane", "deg", rows, number("angle [deg]", 1.0)),
                     column_of("seen in", "", rows, [](const Json& cell) {
                       const Json& of = cell.at("failure");
                       return fmt::format("{} of {}", of.at("planes").get<int>(), of.at("tests").get<int>());
                     })};
  // Few papers measure the failure plane; the column is there for those.
  if (rows.front().at("failure").contains("laboratory [deg]"))
    columns.push_back(column_of("laboratory", "deg", rows, number("laboratory [deg]", 1.0)));
  return "\n" + text_table(test, {columns}, terminal_width);
}

std::string prediction_text(const Json& p) {
  const std::string what = p.at("text");
  // A prediction is written down before it is run, so that it can fail.
  if (!p.contains("rms")) return fmt::format("Predicted: {}: not run yet.\n", what);
  return fmt::format(
      "Planned before it was run{}, {}: rms error {}, mean {:+.1f} %; {} of {} in the band. "
      "Yardstick: {}, {:.1f} %.\n",
      // Blind: nothing was run with the measured values before.
      p.value("blind", false) ? ", blind" : "", what, error_text("", p.at("rms").get<std::vector<double>>()),
      100.0 * median(p.at("mean").get<std::vector<double>>()), p.at("inside").get<int>(),
      p.at("of").get<int>(), p.at("yardstick").get<std::string>(),
      100.0 * p.at("yardstick_rms").get<double>());
}

std::string course_text(const Json& card) {
  return fmt::format(
      "\nLayers: {}. First packings: {}. Verdicts: {}. {} tests, {:.0f} s of CPU, phyllite {}.\n",
      card.at("layers").get<std::string>(), fmt::join(card.at("seeds").get<std::vector<int>>(), ", "),
      fmt::join(card.at("statuses").get<std::vector<std::string>>(), "; "), card.at("tests").get<int>(),
      card.at("cpu_s").get<double>(), card.at("program").get<std::string>());
}

}  // namespace

std::string rock_list(const std::vector<std::string_view>& cards, int terminal_width) {
  std::vector<Json> all;
  for (const std::string_view card : cards) all.push_back(parsed(card));
  const auto column = [&](const char* head, const auto& cell) {
    Column c = column_of(head, "", all, cell);
    c.left = true;
    return c;
  };
  const auto word = [](const char* key) {
    return [key](const Json& j) { return j.at(key).get<std::string>(); };
  };
  Columns errors;  // a property each: together they are wider than a terminal
  for (const MeasuredProperty& p : measured_properties()) {
    const auto has = [&](const Json& j) { return errors_of(j).contains(p.name); };
    if (std::ranges::none_of(all, has)) continue;
    errors.push_back(column(fmt::format("error of {}", p.name).c_str(), [&](const Json& j) {
      return has(j) ? error_text(p.name, errors_of(j)[p.name].get<std::vector<double>>()) : std::string("-");
    }));
  }
  return text_table(
      column("rock", word("name")),
      {{column("kind", word("kind")), column("measured", measured_text),
        column("verdict", [](const Json& j) { return j.at("verdict").at("status").get<std::string>(); }),
        column("left out, over best curve", ratios_text)},
       errors},
      terminal_width);
}

std::string rock_card(std::string_view text, int terminal_width) {
  const Json card = parsed(text);
  std::string out =
      fmt::format("{} ({})\n", card.at("title").get<std::string>(), card.at("kind").get<std::string>());
  const Json& verdict = card.at("verdict");
  // A rock that was not calibrated has a status alone.
  if (verdict.contains("sentence")) out += verdict.at("sentence").get<std::string>() + "\n";
  for (const Json& line : verdict.at("lines")) out += line.get<std::string>() + "\n";
  if (card.contains("errors")) {
    out += fmt::format(
        "\nMeasured: {}\nErrors on unseen packings (rms): {}\nLeft out, over the best curve: {}\n",
        measured_text(card), errors_text(card), ratios_text(card));
  }
  for (const Json& p : card.value("predictions", Json::array())) out += prediction_text(p);
  if (card.contains("errors")) out += course_text(card);
  const std::string failure = failure_text(card, terminal_width);
  // The table is fitted to the terminal already; broken again, its columns would fall apart.
  out = wrapped(out, terminal_width, 2) + failure;
  std::string rest = "\n";
  for (const Json& caution : card.at("cautions")) rest += "- " + caution.get<std::string>() + "\n";
  for (const Json& source : card.at("sources"))
    rest += fmt::format("Source: {} ({})\n", source.at("cite").get<std::string>(),
                        source.at("licence").get<std::string>());
  return out + wrapped(rest, terminal_width, 2);
}

CardModel model_of_card(std::string_view text) {
  const Json card = parsed(text);
  return {card.value("layers", ""), card.value("matrix", "")};
}

}  // namespace phy::report
