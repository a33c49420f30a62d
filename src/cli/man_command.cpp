// `phyllite man`: manual pages, one for the program and one per verb, in the language of man(7). Verbs,
// options, defaults and values come from the tree that also parses the command line; what a page says beyond
// that stands in cli/man_text.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/check.hpp"
#include "base/version.hpp"
#include "cli/commands.hpp"
#include "cli/man_text.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "io/output.hpp"

namespace phy::cli {
namespace {

using Options = std::vector<const CLI::Option*>;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// Text that is typed or read letter by letter: no hyphen, quote or accent of it is made prettier.
std::string literal(const std::string& text) {
  std::string out;
  for (const char c : text)
    // roff would set a hyphen and curly quotes, which nobody can paste into a shell.
    out += c == '\\'   ? "\\e"
           : c == '-'  ? "\\-"
           : c == '\'' ? "\\(aq"
           : c == '^'  ? "\\(ha"
           : c == '~'  ? "\\(ti"
           : c == '`'  ? "\\(ga"
                       : std::string(1, c);
  // A line that begins with a point is a request to roff, which vanishes from the page. \& is nothing, in
  // front.
  return out.starts_with('.') ? "\\&" + out : out;
}

std::string bold(const std::string& text) { return "\\fB" + literal(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + literal(text) + "\\fR"; }

/// A sentence; what stands in backticks is bold.
std::string prose(const std::string& text) {
  std::string out;
  bool typed = false;
  for (std::size_t from = 0; from <= text.size(); typed = !typed) {
    const std::size_t to = std::min(text.find('`', from), text.size());
    const std::string part = text.substr(from, to - from);
    // Only double hyphens in prose are of options; a single one may be set as a hyphen.
    out += typed ? bold(part) : replaced(replaced(replaced(part, "\\", "\\e"), "--", "\\-\\-"), "~", "\\(ti");
    from = to + 1;
  }
  // roff joins lines of a paragraph; what was broken on purpose stays so by .br.
  out = replaced(out, "\n", "\n.br\n");
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string item(const std::string& term, const std::string& meaning) {
  return fmt::format(".TP\n{}\n{}\n", term, meaning);
}

/// "phyllite study effects"
std::string full_name(const CLI::App& verb) {
  return verb.get_parent() == nullptr ? verb.get_name()
                                      : full_name(*verb.get_parent()) + " " + verb.get_name();
}

/// "phyllite-study"
std::string page_name(const CLI::App& verb) { return replaced(full_name(verb), " ", "-"); }

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

Options arguments_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* o) { return o->get_positional(); });
}

std::string argument(const CLI::Option& option) {
  // Dots as in the synopses of other programs: the word may be repeated.
  const std::string many = option.get_expected_max() > 1 ? "..." : "";
  const std::string name = italic(option.get_name(true)) + many;
  return option.get_required() ? name : "[" + name + "]";
}

std::string synopsis(const CLI::App& verb) {
  std::string line = bold(full_name(verb)) + " [" + italic("OPTIONS") + "]";
  for (const CLI::Option* option : arguments_of(verb)) line += " " + argument(*option);
  if (verb.get_parent() == nullptr) line += " " + italic("VERB") + " ...";
  return line;
}

/// Meaning, values, default, and what it goes with, as one paragraph.
std::string meaning_of(const CLI::Option& option) {
  const auto names = [](const auto& options) {
    std::vector<std::string> words;
    for (const CLI::Option* other : options) words.push_back("`" + other->get_name() + "`");
    std::sort(words.begin(), words.end());  // they lie in a set of pointers
    return fmt::format("{}", fmt::join(words, ", "));
  };
  std::string text = option.get_description();
  const std::string type = option.get_type_name();
  // CLI11 puts type and checks into one text, "INT:INT in [0 - 1024]" or "TEXT:{svg,pdf}".
  if (const std::size_t values = type.find(':'); values != type.npos) {
    std::string of = replaced(type.substr(values + 1), ",", ", ");
    std::erase_if(of, [](char c) { return c == '{' || c == '}'; });
    of = replaced(replaced(of, "INT in [", "a whole number in ["), " - ", " ... ");
    text += fmt::format("; {}{}", type[values + 1] == '{' ? "one of " : "", of);
  }
  // A flag takes no value, so a default of it tells nobody anything.
  if (!option.get_default_str().empty() && option.get_items_expected_max() > 0)
    text += "; default: " + option.get_default_str();
  if (!option.get_needs().empty()) text += "; only with " + names(option.get_needs());
  if (!option.get_excludes().empty()) text += "; not with " + names(option.get_excludes());
  return prose(text + ".");
}

std::string option_term(const CLI::Option& option) {
  std::string term;
  for (const std::string& name : option.get_snames()) term += bold("-" + name) + ", ";
  for (const std::string& name : option.get_lnames()) term += bold("--" + name);
  const std::string type = option.get_type_name();
  return option.get_items_expected_max() > 0 ? term + " " + italic(type.substr(0, type.find(':'))) : term;
}

std::string options_text(const CLI::App& verb) {
  std::string text;
  for (const CLI::Option* option : arguments_of(verb)) text += item(argument(*option), meaning_of(*option));
  for (const CLI::Option* option : verb.get_options([](const CLI::Option* o) { return o->nonpositional(); }))
    text += item(option_term(*option), meaning_of(*option));
  return text;
}

std::string heading(const std::string& name) { return ".SH " + name + "\n"; }

std::string description(const std::string& text) {
  return heading("DESCRIPTION") + replaced(prose(text), "\n.br\n\n.br\n", "\n.PP\n") + "\n";
}

std::string examples(const std::vector<ManExample>& all) {
  std::string text;
  for (const ManExample& e : all) {
    if (!text.empty()) text += ".PP\n";
    if (!e.why.empty()) text += prose(e.why) + "\n.PP\n";
    // .EX keeps the line as it is: a command must be copied whole.
    text += ".EX\n" + literal(e.command) + "\n.EE\n";
  }
  return heading("EXAMPLES") + text;
}

/// The verbs below one, each with its options; of the program their names, as each has a page.
std::string verbs_text(const CLI::App& app) {
  const auto verbs = verbs_of(app);
  if (verbs.empty()) return "";
  std::string text = heading("VERBS");
  for (const CLI::App* verb : verbs)
    text += app.get_parent() == nullptr
                ? item(bold(page_name(*verb)) + "(1)", prose(verb->get_description() + "."))
                : ".SS " + synopsis(*verb) + "\n" + prose(verb->get_description() + ".") + "\n" +
                      options_text(*verb);
  return text;
}

std::string synopses(const CLI::App& app) {
  std::string text = heading("SYNOPSIS") + synopsis(app) + "\n";
  if (app.get_parent() != nullptr)
    for (const CLI::App* verb : verbs_of(app)) text += ".br\n" + synopsis(*verb) + "\n";
  return text;
}

std::string see_also(const CLI::App& app) {
  std::string pages;
  const CLI::App& program = app.get_parent() == nullptr ? app : *app.get_parent();
  if (&program != &app) pages = bold("phyllite") + "(1)";
  for (const CLI::App* verb : verbs_of(program))
    if (verb != &app) pages += (pages.empty() ? "" : ",\n") + bold(page_name(*verb)) + "(1)";
  return heading("SEE ALSO") + pages + "\n.PP\n" +
         prose(
             "/usr/share/doc/phyllite/README.md leads to the documents: theory, formats, conventions, "
             "calibration, "
             "reliability.") +
         "\n";
}

std::string page(const CLI::App& app) {
  const bool program = app.get_parent() == nullptr;
  const ManText& more = man_text(program ? "" : app.get_name());
  std::string upper = page_name(app);
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  // NAME is read by apropos and whatis, which expect one line "page - purpose" without marks.
  std::string purpose = program ? "laboratory for layered rock" : app.get_description();
  std::erase(purpose, '`');
  // .nh: no command is broken by a hyphen that nobody types.
  std::string text =
      fmt::format(".TH {} 1 {} \"phyllite {}\" Phyllite\n.nh\n", literal(upper), PHY_DATE, phy::version);
  text += heading("NAME") + literal(page_name(app)) + " \\- " + prose(purpose) + "\n";
  text += synopses(app) + description(more.description) + heading("OPTIONS") + options_text(app);
  if (!program)
    // An option of the program, which the tree of a verb does not hold.
    text += item(bold("--threads") + " " + italic("INT"), prose("as of every verb, see `phyllite`(1)."));
  text += verbs_text(app) + heading("EXIT STATUS");
  for (const ManEntry& e : exit_codes()) text += item(bold(e.term), prose(e.meaning + "."));
  if (program) text += heading("ENVIRONMENT");
  if (program)
    for (const ManEntry& e : environment_variables()) text += item(bold(e.term), prose(e.meaning + "."));
  if (!more.files.empty()) text += heading("FILES");
  for (const auto& [name, holds] : more.files) text += item(italic(name), prose(holds + "."));
  return text + examples(more.examples) + see_also(app);
}

}  // namespace

void add_man_command(CLI::App& app, Session& session) {
  struct Arguments {
    std::string verb, out;
  };
  auto args = std::make_shared<Arguments>();
  CLI::App* man = app.add_subcommand("man", "manual pages in the language of man(7)");
  man->add_option("page", args->verb, "verb whose page is printed; without one, the program's")
      ->type_name("VERB")
      ->check(suggested([&app] {
        std::vector<std::string> names;
        for (const CLI::App* verb : verbs_of(app)) names.push_back(verb->get_name());
        return names;
      }));
  man->add_option("--out", args->out, "folder into which all pages are written")->type_name("FOLDER");
  man->callback([args, &app, &session] {
    session.exit_code = 0;
    std::vector<const CLI::App*> pages = verbs_of(app);
    // The program's own page is one of them, though no verb.
    pages.insert(pages.begin(), &app);
    if (!args->out.empty()) {
      for (const CLI::App* p : pages)
        io::write_output((std::filesystem::path(args->out) / (page_name(*p) + ".1")).string(), page(*p));
      return;
    }
    const std::string name = args->verb.empty() ? "phyllite" : "phyllite-" + args->verb;
    for (const CLI::App* p : pages)
      if (page_name(*p) == name) return write_out(page(*p));
    throw InputError(Problem{"command line", "page", args->verb, "a verb", "see `phyllite --help`"});
  });
}

}  // namespace phy::cli
