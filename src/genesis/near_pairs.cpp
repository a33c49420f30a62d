#include "genesis/near_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace phy::genesis {
namespace {

/// Discs sorted into square cells by counting; within a cell in ascending number.
class CellGrid {
 public:
  CellGrid(const std::vector<Disc>& discs, double size) : size_(size) {
    double x_max = discs[0].x, y_max = discs[0].y;
    x_min_ = x_max;
    y_min_ = y_max;
    for (const Disc& d : discs) {
      x_min_ = std::min(x_min_, d.x);
      x_max = std::max(x_max, d.x);
      y_min_ = std::min(y_min_, d.y);
      y_max = std::max(y_max, d.y);
    }
    n_x_ = column(x_max) + 1;
    n_y_ = row(y_max) + 1;
    start_.assign(static_cast<std::size_t>(n_x_ * n_y_ + 1), 0);
    for (const Disc& d : discs) ++start_[cell(d) + 1];
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    members_.resize(discs.size());
    for (std::uint32_t i = 0; i < discs.size(); ++i) members_[next[cell(discs[i])]++] = i;
  }

  /// Calls visit(j) for every disc in the nine cells around d.
  template <class Visit>
  void around(const Disc& d, Visit visit) const {
    const long c0 = std::max(column(d.x) - 1, 0L), c1 = std::min(column(d.x) + 1, n_x_ - 1);
    const long r0 = std::max(row(d.y) - 1, 0L), r1 = std::min(row(d.y) + 1, n_y_ - 1);
    for (long r = r0; r <= r1; ++r) {
      // The cells of one row lie side by side in memory.
      const auto first = start_[static_cast<std::size_t>(r * n_x_ + c0)];
      const auto last = start_[static_cast<std::size_t>(r * n_x_ + c1 + 1)];
      for (auto k = first; k < last; ++k) visit(members_[k]);
    }
  }

 private:
  long column(double x) const { return static_cast<long>(std::floor((x - x_min_) / size_)); }
  long row(double y) const { return static_cast<long>(std::floor((y - y_min_) / size_)); }
  std::size_t cell(const Disc& d) const { return static_cast<std::size_t>(row(d.y) * n_x_ + column(d.x)); }

  double size_, x_min_ = 0.0, y_min_ = 0.0;
  long n_x_ = 1, n_y_ = 1;
  std::vector<std::uint32_t> start_, members_;
};

}  // namespace

double gap(const Disc& a, const Disc& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return std::sqrt(dx * dx + dy * dy) - (a.r + b.r);
}

std::vector<Pair> near_pairs(const std::vector<Disc>& discs, double reach) {
  std::vector<Pair> pairs;
  if (discs.size() < 2) return pairs;
  double r_max = 0.0;
  for (const Disc& d : discs) r_max = std::max(r_max, d.r);
  const CellGrid grid(discs, 2.0 * r_max + std::max(reach, 0.0));
  pairs.reserve(4 * discs.size());
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    const auto first = static_cast<std::ptrdiff_t>(pairs.size());
    grid.around(discs[i], [&](std::uint32_t j) {
      if (j > i && gap(discs[i], discs[j]) <= reach) pairs.push_back({i, j});
    });
    std::sort(pairs.begin() + first, pairs.end(), [](const Pair& p, const Pair& q) { return p.b < q.b; });
  }
  return pairs;
}

}  // namespace phy::genesis
