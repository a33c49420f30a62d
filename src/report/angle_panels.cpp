#include "report/angle_panels.hpp"

#include <algorithm>
#include <cmath>

#include "report/baselines.hpp"
#include "report/words.hpp"

namespace phy::report {

bool same_panel(const Target& a, const Target& b) {
  // Sheared bedding has no angle of its own: its strengths make one curve over the normal stress.
  return measured(a.property).along_bedding ? a.property == b.property : same_test(a, b);
}

double place_in_panel(const Target& t) {
  return measured(t.property).along_bedding ? t.confining * 1e-6 : t.theta;
}

Axis axis_of(Property property) {
  const MeasuredProperty& m = measured(property);
  return {m.axis, m.shown.name};
}

void fit_over_angles(Figure& figure) {
  // What stands beside an angle may lie beyond 90, and the axis must hold it.
  double far = 90.0;  // of the drawn angles
  for (const Panel& p : figure.panels)
    for (const Series& s : p.x.quantity.empty() ? p.series : std::vector<Series>())
      for (const Point& point : s.points) far = std::max(far, point.x);
  constexpr double room = 5.0;  // [deg] for what stands at the ends, and beside them
  for (Panel& p : figure.panels)
    if (p.x.quantity.empty())
      // Laboratories core at multiples of 15 degrees, and readers look for 30, 45 and 60.
      p.x.quantity = "inclination θ", p.x.unit = "°", p.x.low = -room, p.x.high = far + room, p.x.step = 15.0;
  fit_axes(figure);
}

Series laboratory_series() { return {"laboratory, mean and its 95 %", Mark::points, Role::laboratory}; }

Point point_of(const Target& t, double factor) {
  // Of the mean, not of single specimens: the model is judged against the mean.
  const double half = t.half_width();
  return {place_in_panel(t), factor * t.mean, factor * (t.mean - half), factor * (t.mean + half)};
}

Series theory_series(const std::string& name, const AngleCurve& curve, double factor) {
  Series s{name, Mark::line, Role::theory};
  for (std::size_t i = 0; i < curve.theta.size(); ++i)
    s.points.push_back({curve.theta[i], factor * curve.value[i]});
  return s;
}

std::string theory_name(const TheoryCurves& curves, const std::string& fitted_to) {
  // The legend names only theories that gave a curve.
  const std::string by = curves.E.theta.empty()     ? "Jaeger"
                         : curves.ucs.theta.empty() ? "Goodman"
                                                    : "Goodman, Jaeger";
  return by + " fitted to the " + fitted_to;
}

std::string error_beside(double model, const Target* t) {
  // An angle without a laboratory value has no error to be told.
  if (t == nullptr) return "";
  const double off = miss(t->property, model, t->mean);
  return std::string("error ") + (off < 0.0 ? "−" : "+") + miss_text(t->property, std::fabs(off));
}

}  // namespace phy::report
