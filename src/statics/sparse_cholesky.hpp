// The Cholesky factor of a large sparse matrix: K = L L^T, by supernodes.
//
// Columns of L with the same rows below them form a supernode: three movements of a grain, then of ever more
// grains at once. It is a small dense matrix. As soon as it is eliminated, its part of every later column is
// computed densely and subtracted there, to places that were looked up once for the pattern (right-looking).
// The work is in dense loops, three times as fast as column by column through lists of indices
// (docs/decisions/0017). Rejected: Eigen's dense products, whose blocks depend on the processor's caches, and
// with them the last bits; CHOLMOD (GPL); supernodes that take in a few zeros (no faster).
//
// All loops have a fixed order. The order of elimination is the caller's: a fill-reducing one in postorder is
// expected, others are right and slow.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace phy::statics {

/// Upper triangle of a symmetric matrix, diagonal included: rows of the entries column by column, rising.
struct SymmetricPattern {
  std::vector<std::int32_t> column = {0};  ///< first entry of each column, n + 1
  std::vector<std::int32_t> row;
  std::size_t size() const { return column.size() - 1; }
};

class SparseCholesky {
 public:
  SparseCholesky() = default;
  explicit SparseCholesky(const SymmetricPattern& pattern);

  /// `values`: in the order of the pattern. False: the matrix is not positive definite to rounding.
  bool factorise(const std::vector<double>& values);
  /// Solves K x = b in place, after a factorisation that succeeded.
  void solve(std::vector<double>& b) const;

 private:
  /// Columns first ... first + n - 1 of L, dense. `rows`: theirs, then those below, rising.
  struct Supernode {
    std::int32_t first = 0;
    std::size_t n = 0;
    std::vector<std::int32_t> rows;
    std::size_t at = 0;            ///< its numbers in `factor_`, column after column
    std::size_t first_target = 0;  ///< in `targets_`; those of the next one follow
  };
  /// The columns of one later supernode that the rows [begin, end) of an earlier one meet, and the places
  /// there of its rows from `begin` on.
  struct Target {
    std::size_t node, begin, end, first_place;
  };
  std::vector<Supernode> nodes_;
  std::vector<Target> targets_;
  std::vector<std::int32_t> places_;
  std::vector<std::size_t> entries_;  ///< places of the pattern's entries in `factor_`
  std::vector<double> factor_, buffer_;

  void find_supernodes(const SymmetricPattern& pattern);
  void find_targets(const std::vector<std::size_t>& node_of);
  void place_entries(const SymmetricPattern& pattern, const std::vector<std::size_t>& node_of);
  void subtract_from_later(std::size_t node);
};

}  // namespace phy::statics
