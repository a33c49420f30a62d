// What docs/calibration-tables.md lists of calibration.json. A test holds the list against a file that has
// every key, and against those of real calibrations.
#include "report/baselines.hpp"
#include "report/calibration_files.hpp"

namespace phy::report {
namespace {

FileObject whole_file() {
  return {"file",
          {{"format", "version of this file"},
           {"program", "what wrote it", "program"},
           {"rock", "name of the rock"},
           {"asked", "every option that changes the result, by key"},
           {"method", "`sequence`, or absent"},
           {"effort", "of the search"},
           {"verdict", "what it is good for", "verdict"},
           {"tables", "parameters as printed", "table"},
           {"parameters", "values and intervals", "parameter"},
           {"fitted", "values that were fitted", "row"},
           {"verification", "values on unseen packings", "row"},
           {"left_out", "values predicted without themselves", "row"},
           {"compared", "K_Ic on unseen packings, where nobody states the grain size", "row"},
           {"discrepancy", "rock over model at every fifth degree", "factor"},
           {"residuals", "what the discrepancy is learnt from, per strength", "residual"},
           {"errors", "root mean squares", "error"},
           {"yardsticks", "errors of values left out, per property", "yardstick"},
           {"E_is", "which slope the table's E is"},
           {"layers", "model of the layers"},
           {"matrix", "`parallel_bond` or `flat_joint`"},
           {"tangent_from_test", "E and nu at 40 to 60 % of UCS, where `E_is` is small strain", "row"},
           {"eq2", "Eq. 2 on these packings", "planes"},
           {"notes", "the course of the calibration", "finding"},
           {"methods", "paragraphs for a paper"},
           {"mixing", "draws behind the strengths", "mixing"},
           {"reach", "what the maps expect of each value, and of UCS over tension", "finding"},
           {"runs", "numbers of tests and solutions", "runs"}}};
}

FileObject row() {
  FileObject object = {
      "row",
      {{"property", "as in the [table](tables.md#columns)"},
       {"unit", "of mean, model and interval"},
       {"theta [deg]", "angle of the bedding"},
       {"confining [Pa]", "under a confining stress"},
       {"diameter [m]", "of a disc"},
       {"laboratory", "value of the table", "laboratory"},
       {"model", "mean over packings"},
       {"sd_of_packings", "scatter of the model"},
       {"n_packings", "how many answered"},
       {"low", "95 % interval of the rock's own value; in `left_out` of the table's value"},
       {"high", "its upper end"},
       {"with_discrepancy", "of a strength: the model times what it misses"},
       {"not_from_the_centre", "Brazilian: packings whose first crack is off the centre"},
       {"missing", "why a model has no answer"},
       {"failure", "of a tested strength: [definitions](theory/failure-plane.md)", "failure"}}};
  for (const Baseline& curve : baselines())
    object.keys.push_back({curve.key, "in `left_out`: a curve's value"});
  return object;
}

std::vector<FileObject> of_rows() {
  return {row(),
          {"laboratory",
           {{"mean", "of the specimens"},
            {"sd", "of single specimens"},
            {"n", "number of specimens"},
            {"sd_assumed", "the SD is a usual one"},
            {"specimens", "the values that the table gives singly"}}},
          {"failure",
           {{"bedding_share", "share of the cracks along the bedding"},
            {"bedding_share_sd", "between packings"},
            {"angle [deg]", "of the failure plane, like theta"},
            {"angle_sd [deg]", "between packings"},
            {"n_tests", "tests that were read"},
            {"n_planes", "of these, with cracks that line up"}}},
          {"factor",
           {{"property", "kind of test"},
            {"confining [Pa]", "its stress"},
            {"diameter [m]", "its disc"},
            {"theta [deg]", "angle"},
            {"factor", "rock over model"},
            {"low", "95 % interval"},
            {"high", "its upper end"}}},
          {"residual",
           {{"property", "kind of test"},
            {"theta [deg]", "angle"},
            {"confining [Pa]", "its stress"},
            {"laboratory", "value of the table"},
            {"value", "logarithm of laboratory over model"},
            {"noise", "variance of the laboratory"},
            {"unknown", "variance of the model's answer"},
            {"draws", "`value` at each draw of the ensemble"}}},
          {"error",
           {{"of", "fitted, unseen, left out, or a curve"}, {"*", "by property; relative, of nu absolute"}}},
          {"yardstick",
           {{"property", "kind of test"},
            {"cells", "how many values are compared"},
            {"model", "error of the model alone"},
            {"with_discrepancy", "error of the model times what it misses"},
            {"best", "the best curve"},
            {"best_error", "error of that curve"},
            {"text", "the same as a sentence"}}}};
}

std::vector<FileObject> of_words() {
  return {{"verdict",
           {{"status", "`calibrated`, `calibrated except`, `not calibrated`, `not decided`, `out of reach`"},
            {"sentence", "the first line"},
            {"lines", "good for; not good for; why, and what next"},
            {"counts", "how many values are met, missed, not decided", "finding"},
            {"good_for", "what the model may be used for", "finding"},
            {"not_good_for", "what it may not", "finding"},
            {"findings", "each limit of model or table", "finding"},
            {"causes", "of the misses, the largest first", "finding"},
            {"next", "the next step", "finding"}}},
          {"finding",
           {{"kind", "act on it, not on the text: `src/records/finding_of_*.def`"},
            {"cells", "which values", "cell"},
            {"numbers", "by name; a list has one number per cell"},
            {"names", "texts of the finding"},
            {"advice", "`src/records/advice.def`"},
            {"text", "the finding as a sentence"}}},
          {"cell",
           {{"property", "as in the table"},
            {"theta [deg]", "null without bedding"},
            {"confining [Pa]", "under a confining stress"},
            {"diameter [m]", "of a disc"}}}};
}

std::vector<FileObject> of_parameters() {
  return {{"parameter",
           {{"key", "of the recipe, or a ratio of two"},
            {"symbol", "as printed"},
            {"unit", "SI"},
            {"value", "the estimate"},
            {"low", "95 % interval"},
            {"high", "its upper end"},
            {"box", "values that the calibration admits"},
            {"determined", "by the table; null without an interval"},
            {"rests_on", "data that determine it", "support"},
            {"next", "what would determine it", "remedy"}}},
          {"support",
           {{"basis", "`tests`, `eq1`, `eq2`, `ratio_of_recipe`, `values_left_out`"},
            {"tests", "all of a list, one of each of its lists", "test"},
            {"text", "the same in words"}}},
          {"remedy",
           {{"remedy", "`test`, `more_specimens`, `meet_table`, `map_persistence`"},
            {"tests", "all of a list, one of each of its lists", "test"},
            {"text", "the same in words"}}},
          {"test",
           {{"property", "as in the table"},
            {"where", "`any`, `between`, `either_end`, `both_ends`"},
            {"from [deg]", "where it is between"},
            {"to [deg]", "where it is between"},
            {"confinement", "`higher` or `another`"}}},
          {"table", {{"title", "heading"}, {"head", "of the columns"}, {"rows", "cells as printed"}}}};
}

std::vector<FileObject> of_the_run() {
  return {{"planes",
           {{"planes", "as calibrated, or with another spacing, rule or thickness"},
            {"K_n", "normal stiffness", "stiffness"},
            {"K_s", "shear stiffness", "stiffness"}}},
          {"stiffness",
           {{"ratio", "of the planes over their joints"},
            {"slope", "of the line about them"},
            {"intercept", "of the line"},
            {"R2", "of the line"}}},
          {"mixing",
           {{"effective_sample_size", "independent draws that they are worth"},
            {"r_hat", "spread of all draws over the spread in parts of them"}}},
          {"runs",
           {{"strength_tests", "tests of the press"},
            {"of_these_coarse", "with magnified grains"},
            {"of_these_in_tension", "tension, Brazilian, bending, direct shear"},
            {"elastic_solutions", "direct solutions"}}},
          {"program", {{"name", "`phyllite`"}, {"version", "with the commit of a development build"}}}};
}

}  // namespace

const std::vector<FileObject>& calibration_keys() {
  static const std::vector<FileObject> objects = [] {
    std::vector<FileObject> all = {whole_file()};
    for (const auto& part : {of_words(), of_parameters(), of_rows(), of_the_run()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return objects;
}

}  // namespace phy::report
