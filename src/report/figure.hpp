// What a picture shows, before anyone draws it: panels with axes and named series, in the units that people
// read. The makers (run_figures, calibration_figures, variation_figures) know rock and records; those who
// draw (gnuplot_figure for files, terminal_plot, the page) know neither. So a figure shows the same wherever
// it is seen. Symbols are written plainly, "σ_ci": whoever can sets them in italics, with what follows "_"
// low.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/nan.hpp"

namespace phy::report {

struct Axis {
  std::string quantity = {};     ///< "axial strain"
  std::string unit = {};         ///< "%"; empty: none
  double low = nan, high = nan;  ///< its ends, by fit_axes() where the maker leaves them open
  double step = 0.0;             ///< between its numbers; 0: as there is room
  bool logarithmic = false;
  std::vector<std::string> names = {};  ///< of 0, 1, 2, ... in place of numbers

  std::string label() const { return unit.empty() ? quantity : quantity + " [" + unit + "]"; }
};

enum class Mark {
  line,    ///< through the points
  points,  ///< a symbol each, with a bar from low to high where these are known
  dots,    ///< small ones
  text,    ///< of the points, above them
  band,    ///< from low to high, between the points too
  boxes,   ///< from low to high, Series::width wide
  area     ///< inside the closed line through the points
};

/// What a series is to the reader; each way of drawing has one look for each.
enum class Role {
  ordered,  ///< one of several in an order: Series::shade is its place
  listed,   ///< one of several without an order
  plain,
  model,
  bare,  ///< the model without what it misses of a table
  laboratory,
  specimen,  ///< single ones of the laboratory
  interval,
  between,  ///< the interval at every angle between those of the table
  theory,
  left_out,  ///< predicted without the value
  intact,
  others,   ///< what others found
  level,    ///< stresses of damage and strength
  crack,    ///< by kind, numbered as crack_names
  bedding,  ///< direction of the planes
  frame
};

struct Point {
  double x = 0.0, y = nan;
  double low = nan, high = nan;
  std::string text = {};  ///< of Mark::text; else what is to be said of the point beside its numbers
};

struct Series {
  std::string name = {};  ///< in the key, once for all series of the name; empty: not there
  Mark mark = Mark::points;
  Role role = Role::plain;
  std::size_t number = 0;  ///< among its like: tells symbols, dashes or colours apart
  double shade = nan;      ///< 0 ... 1
  bool strong = false;     ///< the one that the others are seen beside
  bool right = false;      ///< belongs to the axis on the right
  double width = 0.0;      ///< of boxes, in units of x
  int item = -1;           ///< the specimen that it is of; -1: of none alone
  std::vector<Point> points = {};
};

struct Panel {
  std::string title = {};    ///< what tells it from its neighbours; may be empty
  std::string caption = {};  ///< a sentence or more
  Axis x = {}, y = {};
  std::optional<Axis> right = std::nullopt;  ///< from 0, as y is then
  std::vector<Series> series = {};
  bool framed = true;  ///< with axes; else to one scale in both directions
  bool aside = false;  ///< for a second look: a page folds it away
};

/// Where names stand: nowhere, once for all panels, or in each.
enum class Key { none, shared, inside };

struct Figure {
  std::vector<Panel> panels = {};
  Key key = Key::shared;
  double aspect = 0.85;  ///< height over width of a panel's axes
};

/// The ends that a maker has left open: from 0, or the smallest value if that is less, to a round number
/// above the largest; of a logarithmic axis whole powers of ten.
void fit_axes(Panel& panel);
void fit_axes(Figure& figure);

/// One series of each name, in the order in which they come.
std::vector<const Series*> named_series(const std::vector<const Panel*>& panels);
std::vector<const Panel*> panels_of(const Figure& figure);

}  // namespace phy::report
