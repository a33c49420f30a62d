// What to do, in words.
#include <fmt/format.h>

#include "report/words.hpp"

namespace phy::report {

std::string option_text(const std::string& word) { return "--" + word; }
std::string option_text(const std::string& word, const std::string& value) {
  return option_text(word) + " " + value;
}

std::string options_of_rival(const Finding& f) {
  std::vector<std::string> options;
  if (const std::string& layers = f.names[2]; !layers.empty())
    options.push_back(
        fmt::format("layers = \"{}\" in the rock file{}", layers,
                    layers == to_string(LayerModel::directions) ? " (without bedding.spacing)" : ""));
  if (const std::string& matrix = f.names[3]; !matrix.empty())
    options.push_back(option_text("matrix", matrix));
  return list_text(options);
}

std::string options_of_search(const Finding& f) {
  std::vector<std::string> options;
  if (f.number("of_effort") > 0.0) options.push_back(option_text("effort", "normal"));
  if (f.number("of_tests") > 0.0) options.push_back("a larger " + option_text("max-tests"));
  if (options.empty()) options.push_back(option_text("effort", "thorough"));
  return list_text(options);
}

namespace {

using F = const Finding&;

double wanted(F of) { return of.number("wanted") * 1e3; }  // diameter of grains [mm]

struct AdviceWording {
  Advice advice;
  const char* text;  ///< nullptr: it depends on the finding
  std::string (*made)(F) = nullptr;
};
const std::vector<AdviceWording> advice_words = {
    {Advice::see_findings, "see the findings"},
    {Advice::resume, "the same command with --resume"},
    {Advice::calibrate_strengths, "calibrate with strengths"},
    {Advice::test_parameter, nullptr, [](F of) { return "determine " + of.names.front(); }},
    {Advice::fill_gap, "test specimens in that gap"},
    {Advice::state_scatter, nullptr,
     [](F of) {
       std::vector<std::string> columns;
       for (const std::string& name : of.names) columns.push_back(name + "_sd");
       columns.emplace_back("n");
       return fmt::format(
           "state the scatter of the specimens in the columns {} of the table, or test three specimens of "
           "each",
           list_text(columns));
     }},
    {Advice::more_specimens, nullptr, [](F of) { return "test more specimens of " + cells_text(of.cells); }},
    {Advice::smaller_grains, "take smaller grains (grain_size in the rock file, or the radii of its recipe)"},
    {Advice::check_value, nullptr,
     [](F of) { return "check " + cells_text(of.cells) + " in the table, or test more specimens there"; }},
    {Advice::check_nu, "check how nu was measured (it counts in the plane of load and dip), or leave it out"},
    {Advice::check_E_is, "check E_is, the part of the curve that E of the table is read from"},
    {Advice::check_angles,
     "check the angles of the table and E_is, the part of the curve that E is read from"},
    {Advice::check_initiation,
     "check how sigma_ci was read (by crack volumetric strain here), or leave it out"},
    {Advice::one_confinement,
     "set `confining` in the rock file to the stress that matters; E and nu under others are left "
     "out"},
    {Advice::without_sequence, nullptr,
     [](F) {
       return fmt::format("calibrate without {}: then all moduli are fitted together",
                          option_text("method", "sequence"));
     }},
    {Advice::choose_layers,
     "set layers = \"choose\" in a rock file whose recipe has no layers: other models are compared"},
    {Advice::take_where_met, "take the model only at angles where it meets the table"},
    {Advice::leave_out_ucs, "take UCS from the table: no model nearer to it was found"},
    {Advice::leave_out_tension, "leave the tensile strengths out if compression is what matters"},
    {Advice::leave_out_toughness, nullptr,
     [](F of) {
       return fmt::format("leave K_Ic out: it asks for grains of {:.2g} mm, which this specimen cannot hold",
                          wanted(of));
     }},
    {Advice::other_grains, nullptr,
     [](F of) {
       return fmt::format("take grains of {:.2g} mm in place of {:.2g} mm", wanted(of),
                          of.number("grain_size") * 1e3);
     }},
    {Advice::flat_joints, nullptr,
     [](F) {
       return "try " + option_text("matrix", "flat_joint") + ": flat joints break in tension at less of UCS";
     }},
    {Advice::slits, nullptr,
     [](F) { return "try " + option_text("matrix", "flat_joint") + ": slits let cracks begin early"; }},
    {Advice::other_layers, "try another model (layers)"},
    {Advice::other_layers_or_matrix, nullptr,
     [](F) { return fmt::format("try another model (layers, {})", option_text("matrix")); }},
    {Advice::try_rival, nullptr,
     [](F of) { return fmt::format("try {} in a new folder, with {}", of.names[0], options_of_rival(of)); }},
    {Advice::longer_search, nullptr, [](F of) { return "start a new folder with " + options_of_search(of); }},
    {Advice::search_again, nullptr,
     [](F) { return fmt::format("search again ({}, packing.seed)", option_text("effort")); }},
    {Advice::search_again_by, nullptr,
     [](F of) {
       return fmt::format("search again ({}, packing.seed) with {}", option_text("effort"), of.names.front());
     }},
    {Advice::try_model, nullptr,
     [](F of) { return fmt::format("try {} (layers, {})", of.names.front(), option_text("matrix")); }},
    {Advice::more_tests, nullptr, [](F) { return "take a larger " + option_text("max-tests"); }},
};

}  // namespace

std::string text(Advice advice, const Finding& of) {
  for (const AdviceWording& w : advice_words)
    if (w.advice == advice) return w.text != nullptr ? w.text : w.made(of);
  return advice == Advice::none ? "" : advice_of_table(advice, of);
}

}  // namespace phy::report
