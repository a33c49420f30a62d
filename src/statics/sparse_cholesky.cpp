#include "statics/sparse_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace phy::statics {
namespace {

using Rows = std::vector<std::int32_t>;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Rows below the diagonal of each column of the lower triangle, rising.
std::vector<Rows> lower_columns(const SymmetricPattern& pattern) {
  std::vector<Rows> columns(pattern.size());
  for (std::size_t j = 0; j < pattern.size(); ++j)
    for (std::size_t e = index(pattern.column[j]); e < index(pattern.column[j + 1]); ++e)
      if (index(pattern.row[e]) < j) columns[index(pattern.row[e])].push_back(static_cast<std::int32_t>(j));
  return columns;
}

/// to[i] -= sum over k of f[k] from[k][i], the sum taken one after the other.
template <int n>
[[gnu::always_inline]] inline void subtract(double* __restrict to, const double* const* from, const double* f,
                                            std::size_t end) {
  const double* __restrict a = from[0];
  // Unused pointers repeat the first: they are never read.
  const double* __restrict b = from[n > 1 ? 1 : 0];
  const double* __restrict c = from[n > 2 ? 2 : 0];
  const double* __restrict d = from[n > 3 ? 3 : 0];
  const double fa = f[0], fb = f[1], fc = f[2], fd = f[3];
  for (std::size_t i = 0; i < end; ++i) {
    // One after the other and not as a sum of products: the bits are those of column by column.
    double x = to[i] - fa * a[i];
    if constexpr (n > 1) x -= fb * b[i];
    if constexpr (n > 2) x -= fc * c[i];
    if constexpr (n > 3) x -= fd * d[i];
    to[i] = x;
  }
}

/// A column of L less what `n` columns before it make of it. `row`: the first of its rows in `columns`, which
/// are `height` long; `to` begins there.
[[gnu::always_inline]] inline void subtract_columns_as_compiled(double* to, const double* columns,
                                                                std::size_t height, std::size_t n,
                                                                std::size_t row) {
  // Four columns at a time: `to` is then read and written once for four.
  for (std::size_t q = 0; q < n; q += 4) {
    const std::size_t count = std::min<std::size_t>(4, n - q);
    const double* from[4] = {};
    double f[4] = {};
    for (std::size_t k = 0; k < count; ++k) from[k] = columns + (q + k) * height + row, f[k] = from[k][0];
    switch (count) {
      case 1: subtract<1>(to, from, f, height - row); break;
      case 2: subtract<2>(to, from, f, height - row); break;
      case 3: subtract<3>(to, from, f, height - row); break;
      default: subtract<4>(to, from, f, height - row);
    }
  }
}

#if defined(__x86_64__)
/// The same operations, four numbers at a time: the same bits.
[[gnu::target("avx2")]] void subtract_columns_by_avx2(double* to, const double* columns, std::size_t height,
                                                      std::size_t n, std::size_t row) {
  subtract_columns_as_compiled(to, columns, height, n, row);
}
#endif
void subtract_columns(double* to, const double* columns, std::size_t height, std::size_t n, std::size_t row) {
#if defined(__x86_64__)
  // Without fused multiply-adds, so that processors with and without it agree.
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return subtract_columns_by_avx2(to, columns, height, n, row);
#endif
  subtract_columns_as_compiled(to, columns, height, n, row);
}

/// A dense matrix of `n` columns, `height` long, becomes its own factor. False: a pivot is not positive.
bool eliminate(double* columns, std::size_t height, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    double* const column = columns + j * height;
    subtract_columns(column + j, columns, height, j, j);
    // A pivot of zero or less: a mechanism, or stiffnesses too far apart.
    if (!(column[j] > 0.0) || !std::isfinite(column[j])) return false;
    const double pivot = std::sqrt(column[j]), inverse = 1.0 / pivot;
    column[j] = pivot;
    for (std::size_t i = j + 1; i < height; ++i) column[i] *= inverse;
  }
  return true;
}

}  // namespace

SparseCholesky::SparseCholesky(const SymmetricPattern& pattern) {
  find_supernodes(pattern);
  std::vector<std::size_t> node_of;
  std::size_t stored = 0, highest = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    nodes_[k].at = stored;
    node_of.insert(node_of.end(), nodes_[k].n, k);
    stored += nodes_[k].n * nodes_[k].rows.size(), highest = std::max(highest, nodes_[k].rows.size());
  }
  factor_.resize(stored), buffer_.resize(highest);
  find_targets(node_of);
  place_entries(pattern, node_of);
}

void SparseCholesky::find_supernodes(const SymmetricPattern& pattern) {
  const std::vector<Rows> lower = lower_columns(pattern);
  std::vector<std::vector<std::size_t>> children(pattern.size());  // supernodes with this first row below
  Rows rows, together;
  for (std::size_t j = 0; j < pattern.size(); ++j) {
    // Rows of column j of L: its own, and those that the supernodes before it leave.
    rows.assign(1, static_cast<std::int32_t>(j));
    rows.insert(rows.end(), lower[j].begin(), lower[j].end());
    for (const std::size_t child : children[j]) {
      const Supernode& c = nodes_[child];
      together.clear();
      std::set_union(rows.begin(), rows.end(), c.rows.begin() + static_cast<std::ptrdiff_t>(c.n),
                     c.rows.end(), std::back_inserter(together));
      rows.swap(together);
    }
    // What the last supernode leaves is among these rows; where it is all of them, the column is one more.
    const bool follows = !children[j].empty() && children[j].back() + 1 == nodes_.size();
    if (follows && nodes_.back().rows.size() - nodes_.back().n == rows.size())
      ++nodes_.back().n;
    else
      nodes_.push_back({static_cast<std::int32_t>(j), 1, rows, 0, 0});
    const Supernode& s = nodes_.back();
    if (s.rows.size() > s.n) children[index(s.rows[s.n])].push_back(nodes_.size() - 1);
  }
}

void SparseCholesky::find_targets(const std::vector<std::size_t>& node_of) {
  for (Supernode& s : nodes_) {
    s.first_target = targets_.size();
    for (std::size_t begin = s.n; begin < s.rows.size();) {
      const std::size_t node = node_of[index(s.rows[begin])];
      std::size_t end = begin;
      while (end < s.rows.size() && node_of[index(s.rows[end])] == node) ++end;
      targets_.push_back({node, begin, end, places_.size()});
      // The rows of a supernode are among those of every later one that it meets, from there on.
      const Rows& rows = nodes_[node].rows;
      std::size_t place = 0;
      for (std::size_t i = begin; i < s.rows.size(); ++i) {
        while (rows[place] != s.rows[i]) ++place;
        places_.push_back(static_cast<std::int32_t>(place));
      }
      begin = end;
    }
  }
}

void SparseCholesky::place_entries(const SymmetricPattern& pattern, const std::vector<std::size_t>& node_of) {
  entries_.reserve(pattern.row.size());
  for (std::size_t j = 0; j < pattern.size(); ++j)
    for (std::size_t e = index(pattern.column[j]); e < index(pattern.column[j + 1]); ++e) {
      // Entry (i, j) above the diagonal is (j, i) below it.
      const std::int32_t i = pattern.row[e];
      const Supernode& s = nodes_[node_of[index(i)]];
      const auto row = std::lower_bound(s.rows.begin(), s.rows.end(), static_cast<std::int32_t>(j));
      entries_.push_back(s.at + index(i - s.first) * s.rows.size() +
                         static_cast<std::size_t>(row - s.rows.begin()));
    }
}

bool SparseCholesky::factorise(const std::vector<double>& values) {
  std::fill(factor_.begin(), factor_.end(), 0.0);
  for (std::size_t e = 0; e < entries_.size(); ++e) factor_[entries_[e]] = values[e];
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (!eliminate(factor_.data() + nodes_[k].at, nodes_[k].rows.size(), nodes_[k].n)) return false;
    subtract_from_later(k);
  }
  return true;
}

void SparseCholesky::subtract_from_later(std::size_t node) {
  const Supernode& s = nodes_[node];
  const std::size_t height = s.rows.size(),
                    end = node + 1 < nodes_.size() ? nodes_[node + 1].first_target : targets_.size();
  for (std::size_t t = s.first_target; t < end; ++t) {
    const Target& target = targets_[t];
    const Supernode& later = nodes_[target.node];
    const std::int32_t* const places = places_.data() + target.first_place;
    for (std::size_t row = target.begin; row < target.end; ++row) {
      const std::size_t n = height - row;
      // First into a dense column, then spread over the rows: the inner loop stays without indirection.
      std::fill_n(buffer_.begin(), n, 0.0);
      subtract_columns(buffer_.data(), factor_.data() + s.at, height, s.n, row);
      double* const column = factor_.data() + later.at + index(s.rows[row] - later.first) * later.rows.size();
      const std::int32_t* const place = places + (row - target.begin);
      for (std::size_t i = 0; i < n; ++i) column[place[i]] += buffer_[i];
    }
  }
}

void SparseCholesky::solve(std::vector<double>& b) const {
  for (const Supernode& s : nodes_) {  // L y = b
    const double* column = factor_.data() + s.at;
    for (std::size_t j = 0; j < s.n; ++j, column += s.rows.size()) {
      const double x = b[index(s.rows[j])] / column[j];
      b[index(s.rows[j])] = x;
      for (std::size_t i = j + 1; i < s.rows.size(); ++i) b[index(s.rows[i])] -= column[i] * x;
    }
  }
  for (std::size_t k = nodes_.size(); k-- > 0;) {  // L^T x = y
    const Supernode& s = nodes_[k];
    for (std::size_t j = s.n; j-- > 0;) {
      const double* const column = factor_.data() + s.at + j * s.rows.size();
      double x = b[index(s.rows[j])];
      for (std::size_t i = j + 1; i < s.rows.size(); ++i) x -= column[i] * b[index(s.rows[i])];
      b[index(s.rows[j])] = x / column[j];
    }
  }
}

}  // namespace phy::statics
