// Cards of measured rocks (data/rocks/README.md, "Card"): what their calibrations came to, as text.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace phy::report {

/// A row per card, plain ASCII; 0: no limit of the width.
std::string rock_list(const std::vector<std::string_view>& cards, int terminal_width);
/// Verdict, errors, predictions and cautions of one card.
std::string rock_card(std::string_view card, int terminal_width);

/// How the layers and the matrix of a card's model are called in a rock file; empty: it has none.
struct CardModel {
  std::string layers, matrix;
};
CardModel model_of_card(std::string_view card);

}  // namespace phy::report
