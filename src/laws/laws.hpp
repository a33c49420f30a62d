// THE list of laws. A new law is one folder and one line here.
#pragma once
#include <span>

#include "laws/linear/linear.hpp"
#include "laws/parallel_bond/parallel_bond.hpp"
#include "laws/smooth_joint/smooth_joint.hpp"

namespace phy {

struct LawInfo {
  const char* name;
  const char* sentence;
  std::span<const ParameterInfo> parameters;
};

inline constexpr LawInfo laws[] = {
    {"linear", "springs that push and slip", linear::schema},
    {"parallel_bond", "cement that carries tension, shear and bending until it breaks",
     parallel_bond::schema},
    {"smooth_joint", "a bedding plane: bonded, then sliding with friction and dilation",
     smooth_joint::schema},
};

}  // namespace phy
