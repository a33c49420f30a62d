// A figure as the pages read it (web/src/figure.ts).
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "report/figure.hpp"

namespace phy::report {

nlohmann::ordered_json figure_json(const Figure& figure);

}  // namespace phy::report
