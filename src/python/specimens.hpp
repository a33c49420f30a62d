// A specimen after its test, as Python sees it: just made, read from a folder, or from another process.
#pragma once
#include <memory>
#include <vector>

#include "python/module.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::python {

/// `recipe` is that of the whole run. A test from a folder has neither a packing, which is made when it is
/// asked for, nor a last state, which no folder keeps.
struct Test {
  TestResult result;
  std::shared_ptr<const Recipe> recipe;
  std::shared_ptr<const Packing> packing;
};

using Tests = std::vector<std::shared_ptr<Test>>;

}  // namespace phy::python
