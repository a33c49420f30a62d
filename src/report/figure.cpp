#include "report/figure.hpp"

#include <algorithm>
#include <cmath>

namespace phy::report {
namespace {

/// Least and largest of what is seen along an axis; nothing seen: 0 and 0.
struct Extent {
  double least = nan, most = nan;
  void add(double v) {
    if (!std::isfinite(v)) return;
    least = std::fmin(least, v), most = std::fmax(most, v);
  }
};

/// A multiple of 1, 2 or 5 times a power of ten, not below `value`, in some six steps from 0.
double round_above(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value / 6.0)));
  double step = 10.0 * power;
  for (const double times : {5.0, 2.0, 1.0})
    if (6.0 * times * power >= value) step = times * power;
  constexpr double rounding = 1e-9;  // 0.3 is three steps of 0.1
  return step * std::ceil(value / step - rounding);
}

void fit(Axis& axis, const Extent& seen) {
  const double most = std::isfinite(seen.most) ? seen.most : 0.0;
  if (axis.logarithmic) {
    // Whole decades: ticks of a logarithmic axis stand at powers of ten only.
    if (!std::isfinite(axis.low)) axis.low = std::pow(10.0, std::floor(std::log10(seen.least)));
    if (!std::isfinite(axis.high)) axis.high = std::pow(10.0, std::ceil(std::log10(most)));
    return;
  }
  // From zero: a cut axis makes small differences of strength look large.
  if (!std::isfinite(axis.low)) axis.low = seen.least < 0.0 ? -round_above(-seen.least) : 0.0;
  // An axis needs a length, even where nothing is seen: gnuplot refuses an empty range.
  if (!std::isfinite(axis.high)) axis.high = most > 0.0 ? round_above(most) : axis.low < 0.0 ? 0.0 : 1.0;
}

}  // namespace

void fit_axes(Panel& panel) {
  Extent x, y, right;
  for (const Series& s : panel.series)
    for (const Point& p : s.points) {
      x.add(p.x);
      // Bars count as seen; an interval that leaves the picture would look shorter than it is.
      for (const double v : {p.y, p.low, p.high}) (s.right ? right : y).add(v);
    }
  fit(panel.x, x), fit(panel.y, y);
  if (panel.right) fit(*panel.right, right);
}

void fit_axes(Figure& figure) {
  for (Panel& p : figure.panels) fit_axes(p);
}

std::vector<const Series*> named_series(const std::vector<const Panel*>& panels) {
  std::vector<const Series*> named;
  for (const Panel* panel : panels)
    for (const Series& s : panel->series) {
      const auto same = [&](const Series* other) { return other->name == s.name; };
      // Panels share names: each stands once in the key. Series without points would be entries that nobody
      // finds.
      if (!s.name.empty() && !s.points.empty() && std::none_of(named.begin(), named.end(), same))
        named.push_back(&s);
    }
  return named;
}

std::vector<const Panel*> panels_of(const Figure& figure) {
  std::vector<const Panel*> panels;
  for (const Panel& p : figure.panels) panels.push_back(&p);
  return panels;
}

}  // namespace phy::report
