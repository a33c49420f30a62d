#include "io/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/check.hpp"
#include "base/units.hpp"
#include "contact/model.hpp"
#include "io/file.hpp"
#include "io/table.hpp"
#include "records/test_description.hpp"

namespace phy::io {
namespace {

constexpr const char* disc_header = "x [m],y [m],r [m]";

/// One number at the front of `text`, which is moved past it and one `separator`; false if there is none.
bool take(std::string_view& text, char separator, double& value) {
  // Blanks around numbers are allowed, as spreadsheets write them; anything else is not.
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // from_chars does not depend on the locale, and also reads "nan" and "inf", which are no coordinates.
  if (error != std::errc() || !std::isfinite(value)) return false;
  text.remove_prefix(static_cast<std::size_t>(next - text.data()));
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  if (separator == 0) return text.empty();
  if (text.empty() || text.front() != separator) return false;
  text.remove_prefix(1);
  return true;
}

/// The number after "name [m] =" in the comment line, or 0.
double box_side(std::string_view line, std::string_view name) {
  const std::size_t at = line.find(std::string(name) + " [m] =");
  if (at == line.npos) return 0.0;
  std::string_view rest = line.substr(at + name.size() + 6);
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  double value = 0.0;
  std::from_chars(rest.data(), rest.data() + rest.size(), value);
  return std::isfinite(value) ? value : 0.0;
}

const char* word(ContactKind kind) {
  switch (kind) {
    case ContactKind::touching: return "touching";
    case ContactKind::bonded: return "bonded";
    case ContactKind::joint: return "joint";
  }
  return "";
}

}  // namespace

std::string discs_csv(const Packing& packing) {
  // The box is a comment: a table of discs from elsewhere may lack it.
  std::string text = "# width [m] = " + print_number(packing.width) +
                     ", height [m] = " + print_number(packing.height) + "\n" + disc_header + "\n";
  for (const Disc& d : packing.discs)
    text += print_number(d.x) + "," + print_number(d.y) + "," + print_number(d.r) + "\n";
  return text;
}

namespace {

constexpr std::size_t max_reported = 20;  // bad lines in full; the rest is counted

/// Problems of a table of discs, the first ones in full.
struct BadLines {
  std::vector<Problem> problems;
  std::size_t n = 0;
  void add(Problem p) {
    if (++n <= max_reported) problems.push_back(std::move(p));
  }
};

/// Discs whose centre lies on that of an earlier one: the branch between them has no direction. Positions of
/// a file are rounded; below a thousandth of the smaller radius the direction is that of the rounding.
/// Kept in cells of about the distance that matters to discs of their size, so that few share one.
void find_coincident(const std::vector<Disc>& discs, const std::vector<int>& line, const std::string& where,
                     BadLines& bad) {
  constexpr double close = 1e-3, smallest = std::numeric_limits<double>::min();
  using Cells = std::map<std::pair<double, double>, std::vector<std::size_t>>;
  std::map<double, Cells> sizes;  // by the side of the cells; of discs with a place of their own
  const auto earlier = [&](std::size_t i) -> std::optional<std::size_t> {
    const auto cell_of = [&](double side) {
      return std::pair{std::floor(discs[i].x / side), std::floor(discs[i].y / side)};
    };
    // Coincident discs are less than a cell apart, so they lie in the same cell or in one next to it: O(n log
    // n) in place of all pairs.
    for (const auto& [side, cells] : sizes) {
      const auto [cx, cy] = cell_of(side);
      for (const double x : {cx - 1.0, cx, cx + 1.0})
        for (const double y : {cy - 1.0, cy, cy + 1.0}) {
          const auto found = cells.find({x, y});
          if (found == cells.end()) continue;
          for (const std::size_t k : found->second)
            if (norm(Vec2{discs[k].x - discs[i].x, discs[k].y - discs[i].y}) <
                close * std::min(discs[i].r, discs[k].r))
              return k;
        }
    }
    // Only discs that coincide with no other are kept, so that a pile is reported against its first disc.
    const double side = std::max(close * std::exp2(std::ceil(std::log2(discs[i].r))), smallest);
    sizes[side][cell_of(side)].push_back(i);
    return {};
  };
  for (std::size_t i = 0; i < discs.size(); ++i)
    if (const auto k = earlier(i))
      bad.add({where + ":" + std::to_string(line[i]), "disc", "", "a centre of its own",
               "it lies on the disc of line " + std::to_string(line[*k]) + ": remove one of the two"});
}

/// By hand and not by getline: the last line may lack its end, and line ends of Windows are taken off.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

}  // namespace

DiscFile parse_discs(std::string_view given, const std::string& where) {
  DiscFile file;
  BadLines bad;
  const std::string plain = plain_text(given);
  std::string_view text = plain;
  bool header = false;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = take_line(text);
    // The box is looked for above the header only.
    if (line.starts_with('#') && !header) {
      if (const double w = box_side(line, "width"); w > 0.0) file.width = w;
      if (const double h = box_side(line, "height"); h > 0.0) file.height = h;
    }
    if (line.empty() || line.front() == '#') continue;
    const std::string at = where + ":" + std::to_string(number);
    // The header is required word by word: units and order of columns are never guessed.
    if (!header && line != disc_header)
      throw InputError(Problem{at, "header", std::string(line.substr(0, 80)), disc_header,
                               "name the columns so, in this order"});
    if (!std::exchange(header, true)) continue;
    Disc d;
    std::string_view rest = line;
    if (take(rest, ',', d.x) && take(rest, ',', d.y) && take(rest, 0, d.r) && d.r > 0.0)
      file.discs.push_back(d), file.lines.push_back(number);
    else
      bad.add({at, "disc", std::string(line.substr(0, 80)), "three numbers x,y,r with r > 0", ""});
  }
  // After the discs are complete; the line numbers go along for the messages.
  find_coincident(file.discs, file.lines, where, bad);
  if (bad.n > max_reported)
    bad.problems.push_back({where, "", "", "", std::to_string(bad.n - max_reported) + " more bad lines"});
  if (file.discs.empty() && bad.n == 0)
    bad.problems.push_back({where, "disc", "", "at least one line of x,y,r below the header", ""});
  if (!bad.problems.empty()) throw InputError(std::move(bad.problems));
  return file;
}

std::vector<Disc> read_discs(const std::string& path) { return parse_discs(read_file(path), path).discs; }

std::string contacts_csv(const Specimen& s) {
  std::string text =
      "grain_a,grain_b,kind,set,normal_x,normal_y,gap [m],k_n [N/m per m],k_s [N/m per m],"
      "sigma_c [Pa],tau_c [Pa],k_m [N],x [m],y [m]";
  // Only where strengths of joints are drawn: the tables of all other specimens keep their bytes.
  const bool drawn = std::any_of(s.bedding.begin(), s.bedding.end(),
                                 [](const BeddingRecipe& set) { return set.sigma_n_sd > 0.0; });
  text += drawn ? ",sigma_n [Pa]\n" : "\n";
  const contact::Models& models = contact::models_of(s);
  for (const Contact& c : s.contacts) {
    const Disc &a = s.packing->discs[c.a], &b = s.packing->discs[c.b];
    const Vec2 d{b.x - a.x, b.y - a.y};
    const double gap = norm(d) - a.r - b.r;
    // Middle of the gap or overlap, on the line between the centres.
    const Vec2 branch = (1.0 / norm(d)) * d, point = Vec2{a.x, a.y} + (a.r + 0.5 * gap) * branch;
    const contact::ContactModel& model = models.of(c.kind);
    const Vec2 normal = model.normal(s, c, branch);
    // Stiffness of the intact contact, the one that a test begins with.
    const laws::Tangent<double> k = model.stiffness(s, c, true);
    text += std::to_string(c.a) + "," + std::to_string(c.b) + "," + word(c.kind) + "," +
            std::to_string(c.kind == ContactKind::joint ? s.set_of(c.set) : 0);
    for (const double v :
         {normal.x, normal.y, gap, k.k_n, k.k_s, c.sigma_c, c.tau_c, k.k_m, point.x, point.y})
      text += "," + print_number(v);
    if (drawn)
      text +=
          "," + print_number(c.kind == ContactKind::joint ? s.bedding_of(c.set).sigma_n * c.sigma_n : 0.0);
    text += "\n";
  }
  return text;
}

namespace {

/// The lines of a table below its header; `where` and the line number go to `read` for messages.
void each_line(std::string_view text, const std::string& where, std::string_view header,
               const std::function<bool(std::string_view)>& read) {
  // A line without its end may have been a longer one.
  if (!text.ends_with('\n'))
    throw IoError(where + ": " + (text.empty() ? "is empty" : "ends in the middle of a line") +
                  "; bring it back from a copy, or make the result anew");
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    // The header must match exactly; later a damaged or truncated line is an error, not a shorter history.
    if (number == 1 ? line == header : read(line)) continue;
    throw IoError(where + ":" + std::to_string(number) + ": is no line of this table; expected the columns " +
                  std::string(header));
  }
}

/// The word up to the next comma; `text` is moved past it.
std::string_view take_word(std::string_view& text) {
  const std::size_t end = std::min(text.find(','), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

/// Also "nan" and "inf", as they were written.
template <class T>
bool take_number(std::string_view& text, T& value) {
  const std::string_view word = take_word(text);
  const auto r = std::from_chars(word.data(), word.data() + word.size(), value);
  // The whole word must be the number.
  return r.ec == std::errc() && r.ptr == word.data() + word.size();
}

std::string history_header(TestKind kind) {
  std::string text;
  for (const HistoryColumn& c : kind->columns) text += (text.empty() ? "" : ",") + heading(c);
  return text;
}

std::string crack_header(TestKind kind) {
  return "step [1],time [s]," + heading(kind->loading_column()) +
         ",grain_a,grain_b,mode,place,x [m],y [m],normal_x,normal_y,size [m],energy [J/m]";
}

constexpr const char* wall_header =
    "moment,angle [deg],borne_stress [Pa],hoop [Pa],radial [Pa],shear [Pa],inwards [m],breakout [m]";

/// A moment of a slice of rock is one per metre of its thickness: N m / m.
std::string event_header(TestKind kind) {
  return "time [s]," + heading(kind->loading_column()) +
         ",duration [s],n_cracks,x [m],y [m],M_xx [N],M_xy [N],M_yy [N],moment [N],thickness [m],magnitude,"
         "volume_share [%],source,energy [J/m]";
}

/// The one of the heads of all tests that a table begins with; of none: that of the first.
template <class Header>
std::string header_of(std::string_view text, const Header& header) {
  const std::string_view first = text.substr(0, text.find('\n'));
  for (const TestDescription* test : laboratory_tests())
    if (first == header(*test)) return header(*test);
  return header(TestKind());
}

}  // namespace

std::string history_csv(const History& history) {
  std::string text = history_header(history.kind) + "\n";
  for (const HistoryRow& row : history.rows) {
    bool first = true;
    for (const HistoryColumn& c : history.kind->columns) {
      text += (first ? "" : ",") + print_number(row.*c.value);
      first = false;
    }
    text += "\n";
  }
  return text;
}

std::string cracks_csv(const std::vector<CrackEvent>& cracks, TestKind kind) {
  std::string text = crack_header(kind) + "\n";
  for (const CrackEvent& c : cracks) {
    text += std::to_string(c.step) + "," + print_number(c.time) + "," + print_number(c.strain) + "," +
            std::to_string(c.a) + "," + std::to_string(c.b) + "," +
            (c.mode == CrackMode::tension ? "tension" : "shear") + "," +
            (c.place == CrackPlace::matrix ? "matrix" : "bedding");
    for (const double v : {c.position.x, c.position.y, c.normal.x, c.normal.y, c.size, c.energy})
      text += "," + print_number(v);
    text += "\n";
  }
  return text;
}

std::string events_csv(const std::vector<AcousticEvent>& events, TestKind kind) {
  std::string text = event_header(kind) + "\n";
  for (const AcousticEvent& e : events) {
    text += print_number(e.time) + "," + print_number(e.strain) + "," + print_number(e.duration) + "," +
            std::to_string(e.n_cracks);
    for (const double v : {e.position.x, e.position.y, e.tensor.xx, e.tensor.xy, e.tensor.yy, e.moment,
                           e.thickness, e.magnitude, e.volume_share})
      text += "," + print_number(v);
    text += std::string(",") + to_string(e.type) + "," + print_number(e.energy) + "\n";
  }
  return text;
}

std::string wall_csv(const std::vector<WallPoint>& wall) {
  std::string text = std::string(wall_header) + "\n";
  for (const WallPoint& p : wall) {
    text += std::string(to_string(p.moment));
    for (const double v : {p.angle, p.borne_stress, p.hoop, p.radial, p.shear, p.inwards, p.breakout})
      text += "," + print_number(v);
    text += "\n";
  }
  return text;
}

History parse_history(std::string_view text, const std::string& where) {
  History history;
  const std::string_view header = text.substr(0, text.find('\n'));
  for (const TestDescription* test : laboratory_tests())  // the columns name the test
    if (header == history_header(*test)) history.kind = *test;
  each_line(text, where, history_header(history.kind), [&](std::string_view line) {
    HistoryRow row;
    for (const HistoryColumn& c : history.kind->columns)
      if (!take_number(line, row.*c.value)) return false;
    history.rows.push_back(row);
    return line.empty();
  });
  return history;
}

std::vector<CrackEvent> parse_cracks(std::string_view text, const std::string& where) {
  std::vector<CrackEvent> cracks;
  each_line(text, where, header_of(text, crack_header), [&](std::string_view line) {
    CrackEvent c;
    bool ok = take_number(line, c.step) && take_number(line, c.time) && take_number(line, c.strain) &&
              take_number(line, c.a) && take_number(line, c.b);
    const std::string_view mode = take_word(line), place = take_word(line);
    c.mode = mode == "shear" ? CrackMode::shear : CrackMode::tension;
    c.place = place == "bedding" ? CrackPlace::bedding : CrackPlace::matrix;
    for (double* v : {&c.position.x, &c.position.y, &c.normal.x, &c.normal.y, &c.size, &c.energy})
      ok = ok && take_number(line, *v);
    cracks.push_back(c);
    return ok && line.empty();
  });
  return cracks;
}

std::vector<AcousticEvent> parse_events(std::string_view text, const std::string& where) {
  std::vector<AcousticEvent> events;
  each_line(text, where, header_of(text, event_header), [&](std::string_view line) {
    AcousticEvent e;
    bool ok = take_number(line, e.time) && take_number(line, e.strain) && take_number(line, e.duration) &&
              take_number(line, e.n_cracks);
    for (double* v : {&e.position.x, &e.position.y, &e.tensor.xx, &e.tensor.xy, &e.tensor.yy, &e.moment,
                      &e.thickness, &e.magnitude, &e.volume_share})
      ok = ok && take_number(line, *v);
    // A word that is no source makes the line unreadable instead of an event of shear.
    const std::optional<SourceType> type = source_type_of(take_word(line));
    e.type = type.value_or(SourceType::shear);
    ok = ok && type && take_number(line, e.energy);
    events.push_back(e);
    return ok && line.empty();
  });
  return events;
}

std::vector<WallPoint> parse_wall(std::string_view text, const std::string& where) {
  std::vector<WallPoint> wall;
  each_line(text, where, wall_header, [&](std::string_view line) {
    WallPoint p;
    const std::string_view word = take_word(line);
    const auto* moment = std::find_if(std::begin(all_wall_moments), std::end(all_wall_moments),
                                      [&](WallMoment m) { return word == to_string(m); });
    bool ok = moment != std::end(all_wall_moments);
    if (ok) p.moment = *moment;
    for (double* v : {&p.angle, &p.borne_stress, &p.hoop, &p.radial, &p.shear, &p.inwards, &p.breakout})
      ok = ok && take_number(line, *v);
    wall.push_back(p);
    return ok && line.empty();
  });
  return wall;
}

}  // namespace phy::io
