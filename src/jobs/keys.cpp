#include "jobs/keys.hpp"

#include <fmt/format.h>

#include "base/option.hpp"
#include "base/spelling.hpp"
#include "records/foreign_words.hpp"

namespace phy::jobs {
namespace {

std::string explanation(const Field& f) {
  std::string text = fmt::format("{}\n  meaning   {}\n  allowed   {}\n", f.path(), f.meaning, range_text(f));
  if (!f.default_text.empty()) text += fmt::format("  default   {}\n", f.default_text);
  if (f.dimension != Dimension::none) text += fmt::format("  units     {}\n", unit_names(f.dimension));
  if (!f.pfc_name.empty()) text += fmt::format("  in PFC    {}\n", f.pfc_name);
  return text;
}

std::string in_code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

}  // namespace

std::string explain(const std::vector<const io::Schema*>& schemas, const std::string& key) {
  // People copy keys from messages, where sets are counted: bedding[1].k_n.
  const std::string word = io::without_index(key);
  std::vector<std::string> known, longer;
  // Own keys go before PFC's: a word that means both is a key of this program here.
  for (const bool in_pfc : {false, true}) {
    std::string text;
    for (const io::Schema* schema : schemas)
      for (const Field& f : schema->fields)
        if (in_pfc ? has_pfc_name(f, word) || foreign_word(schema->fields, word, f.table).field == &f
                   // A bare key may stand in several tables: all of them are explained.
                   : f.path() == word || f.key == word)
          text += explanation(f);
    if (!text.empty()) return text;
  }
  for (const io::Schema* schema : schemas)
    for (const Field& f : schema->fields) {
      // Compared like with like: a path typed in full is near to paths, a bare word to bare keys.
      known.push_back(word.find('.') == word.npos ? f.key : f.path());
      if (known.back().starts_with(word)) longer.push_back(known.back());
    }
  const io::Schema& first = *schemas.front();
  // A beginning goes before a near spelling: "conf" means confinement rather than "coef".
  const std::string near = longer.empty() ? nearest(word, known) : longer.front();
  if (const std::string instead = foreign_word(first.fields, word, "").instead; !instead.empty())
    throw InputError(option_problem("explain", key, "", instead));
  throw InputError(option_problem("explain", key, "a key of the " + first.name,
                                  near.empty() ? "`phyllite " + first.verb + " --reference` lists all keys"
                                               : "did you mean \"" + near + "\"?"));
}

std::string reference_markdown(const io::Schema& schema) {
  std::string text = fmt::format(
      "# Keys of a {}\n\nWritten by `phyllite {} --reference`. A quantity carries its unit, in "
      "quotes; a key "
      "that is left out has its default.\n",
      schema.name, schema.verb);
  // No table has this name, so that even the first, nameless one gets its heading.
  std::string table = "-";
  for (const Field& f : schema.fields) {
    if (f.table != table) {
      table = f.table;
      text += fmt::format("\n## {}\n\n| key | default | allowed | meaning | PFC |\n|---|---|---|---|---|\n",
                          table.empty() ? "top level" : schema.in_brackets(table));
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", f.key, in_code(f.default_text), range_text(f),
                        f.meaning, f.pfc_name);
  }
  return text;
}

}  // namespace phy::jobs
