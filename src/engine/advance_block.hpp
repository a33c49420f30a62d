// What a force loop is to those who call it, who need not know the memory that it works on.
#pragma once

namespace phy::engine {

template <class T>
struct GroupView;  // view.hpp

/// Runs `n_steps` cycles (motion, then forces) and samples at the end.
template <class T>
using AdvanceBlock = void (*)(GroupView<T>&, int n_steps);

/// A force loop as it was compiled.
template <class T>
struct Kernel {
  AdvanceBlock<T> advance = nullptr;  ///< null: not built for this number of lanes
  int contacts = 1;                   ///< of a specimen side by side: more than one only where it is alone
};

}  // namespace phy::engine
