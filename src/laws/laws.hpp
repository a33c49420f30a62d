// THE list of laws. A new law is one folder and one line here: the contact bench, `phyllite contact` and the
// conformance tests follow from it.
#pragma once
#include <tuple>

#include "laws/flat_joint/flat_joint.hpp"
#include "laws/linear/dashpot.hpp"
#include "laws/linear/linear.hpp"
#include "laws/parallel_bond/parallel_bond.hpp"
#include "laws/smooth_joint/smooth_joint.hpp"

namespace phy::laws {

template <class R>
using Laws = std::tuple<linear::Contact<R>,         //
                        dashpot::Contact<R>,        //
                        parallel_bond::Contact<R>,  //
                        smooth_joint::Contact<R>,   //
                        flat_joint::Contact<R>>;

}  // namespace phy::laws
