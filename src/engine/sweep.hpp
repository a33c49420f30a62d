// The order of a block: which row moves, and presses on its neighbours, in which cycle. `Rows` does it, for
// specimens in lanes (force_loop.hpp) or for one alone (wide_loop.hpp).
//
// Time skewing. forces(row) needs the rows `row` and `row - 1` moved in this cycle and not yet in the next.
// So a sweep over fronts can run several cycles at once, each one row behind the other, while the rows lie in
// the cache:
//   for front: for t: row = front - t; move(row); forces(row)
// Every grain sees the same operations in the same order as without skewing; no bit changes. If a contact
// joins rows that are not neighbours (fragments), the group runs with skew 1, where any lower row has been
// moved already. Bodies in balance (boundary.hpp) forbid skewing: where they stand in a cycle depends on all
// rows.
#pragma once
#include "engine/view.hpp"

namespace phy::engine {
inline namespace PHY_ISA {

template <class Rows>
void sweep(Rows& rows, int n_rows, int first, int depth) {
  for (int front = 0; front < n_rows + depth - 1; ++front) {
    for (int t = 0; t < depth; ++t) {
      const int row = front - t;
      if (row < 0 || row >= n_rows) continue;
      rows.move(row, first + t);
      rows.template forces<false>(row, first + t);
    }
  }
}

/// All cycles but the forces of the last, where bodies in balance have to know all rows. Forces of a cycle
/// and motion of the next still share a sweep, unless contacts join rows that are not neighbours.
template <class Rows>
void step_by_step(Rows& rows, int n_rows, bool far_rows, int n_steps) {
  const int behind = far_rows ? n_rows : 1;
  for (int row = 0; row < n_rows; ++row) rows.move(row, 0);
  for (int step = 0; step + 1 < n_steps; ++step) {
    rows.balance(step);
    for (int front = 0; front < n_rows + behind; ++front) {
      if (front < n_rows) rows.template forces<false>(front, step);
      if (front >= behind) rows.move(front - behind, step + 1);
    }
  }
  rows.balance(n_steps - 1);
}

/// A block of cycles; the last one takes the samples.
template <class T, class Rows>
void run_block(const GroupView<T>& v, Rows& rows, int n_steps) {
  int done = 0;
  if (v.n_balanced > 0) {
    step_by_step(rows, v.n_rows, v.skew == 1, n_steps);
    done = n_steps - 1;
  }
  while (done + 1 < n_steps) {
    const int depth = n_steps - 1 - done < v.skew ? n_steps - 1 - done : v.skew;
    sweep(rows, v.n_rows, done, depth);
    done += depth;
  }
  for (int row = 0; row < v.n_rows; ++row) {
    if (v.n_balanced == 0) rows.move(row, done);
    rows.template forces<true>(row, done);
  }
  rows.sample(done);
}

}  // namespace PHY_ISA
}  // namespace phy::engine
