// `phyllite completion SHELL`: the script that lets bash, zsh or fish complete the words of a command line.
//
// A script knows nothing of the verbs. It hands the words back, `phyllite completion SHELL -- WORD...`, and
// the answer comes from the tree of verbs and options that also parses them: one source, and nothing to
// install anew when it changes. The first line of an answer says what else the shell may offer (words:
// nothing, files, folders), every other one is a word, and behind two spaces what it means.
#include <algorithm>
#include <set>

#include "cli/commands.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"

namespace phy::cli {
namespace {

using Words = std::vector<std::string>;

// Bash hands over the name as typed, so ~/bin/phyllite needs its tilde expanded before it can be called. With
// the option filenames bash quotes spaces, but also marks folders with a slash: hence only where words have
// spaces.
constexpr const char* bash_script =
    R"(# bash completion of phyllite: the program itself knows its verbs, options and their values.
_phyllite() {
  local answer files line
  mapfile -t answer < <("${1/#\~/$HOME}" completion bash -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  COMPREPLY=()
  for line in "${answer[@]:1}"; do
    line=${line%%  *}
    [[ $line == *" "* ]] && compopt -o filenames  # quotes the spaces
    COMPREPLY+=("$line")
  done
  case ${answer[0]} in
    folders) compopt -o dirnames ;;
    files)
      if ((${#COMPREPLY[@]} == 0)); then
        compopt -o default
      else
        mapfile -t files < <(compgen -f -- "${COMP_WORDS[COMP_CWORD]}")
        ((${#files[@]})) && compopt -o filenames && COMPREPLY+=("${files[@]}")
      fi ;;
  esac
}
complete -F _phyllite phyllite
)";

// Zsh keeps quotes in its words, which (Q) removes, and parts a word from its meaning by a colon. compset
// hides "--out=" from _files, which would else look for a file of that name. The last line serves both ways
// to load it: autoloaded from fpath, or sourced.
constexpr const char* zsh_script = R"(#compdef phyllite
# zsh completion of phyllite: the program itself knows its verbs, options and their values.
_phyllite() {
  local -a answer found
  local line
  answer=("${(@f)$("${words[1]}" completion zsh -- "${(@Q)words[2,CURRENT]}" 2>/dev/null)}")
  for line in "${(@)answer[2,-1]}"; do
    [[ $line == *"  "* ]] && line="${line%%  *}:${line#*  }"
    found+=("$line")
  done
  ((${#found})) && _describe phyllite found
  [[ $answer[1] != words ]] && compset -P 1 '--*='
  case $answer[1] in
    files) _files ;;
    folders) _files -/ ;;
  esac
}
if [[ $funcstack[1] == _phyllite ]]; then _phyllite "$@"; else compdef _phyllite phyllite; fi
)";

// Fish parts word and meaning by a tab. -f keeps it from offering files everywhere: the program says where
// they belong.
constexpr const char* fish_script =
    R"(# fish completion of phyllite: the program itself knows its verbs, options and their values.
function __phyllite_complete
    set -l before (commandline -opc)
    set -e before[1]
    set -l current (commandline -ct)
    set -l answer (command phyllite completion fish -- $before "$current" 2>/dev/null)
    for line in $answer[2..]
        string replace '  ' \t -- $line
    end
    switch "$answer[1]"
        case files
            __fish_complete_path "$current"
        case folders
            __fish_complete_directories "$current" ''
    end
end
complete -c phyllite -f -a '(__phyllite_complete)'
)";

/// What the shell may offer for a word.
struct Offer {
  const char* besides = "words";
  Words words;
};

// Descriptions of --kind and its like go on for many lines, and an answer has one line per word.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// Filtered here, because bash shows what it is given whether it begins as typed or not.
void add(Offer& offer, const std::string& word, const std::string& typed, const std::string& meaning = "") {
  if (word.starts_with(typed))
    offer.words.push_back(word + (meaning.empty() ? "" : "  " + first_line(meaning)));
}

/// "a,b" or "{a,b}", as a validator describes its words.
Words listed(std::string text) {
  std::erase_if(text, [](char c) { return c == '{' || c == '}'; });
  return CLI::detail::split(text, ',');
}

/// The words that are an option's values, or that are suggested for it.
Words words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  // CLI11 appends the description of a check to the name of the type, such as "TEXT:{svg,pdf}".
  if (const std::size_t set = type.find(":{"); set != type.npos) return listed(type.substr(set + 1));
  try {
    // The library has no const way to ask for a validator.
    CLI::Validator words = *const_cast<CLI::Option&>(option).get_validator("suggested");
    return listed(words.active().get_description());
  } catch (const CLI::OptionNotFound&) {
    return {};
  }
}

void add_values(Offer& offer, const CLI::Option& option, const std::string& typed,
                const std::string& before = "") {
  for (const std::string& word : words_of(option)) add(offer, before + word, before + typed);
  const std::string type = first_line(option.get_type_name());
  if (type == "FILE" || type == "PATH") offer.besides = "files";
  if (type == "FOLDER") offer.besides = "folders";
}

/// "--out" or "-h", of a verb or of those above it; nullptr: it has none of that name.
const CLI::Option* find_option(const CLI::App* verb, const std::string& name) {
  // Options of the program may stand behind the verb, as the parser lets them fall through.
  for (; verb != nullptr; verb = verb->get_parent())
    if (const CLI::Option* option = verb->get_option_no_throw(name); option != nullptr) return option;
  return nullptr;
}

/// nullptr: none of that name.
const CLI::App* find_verb(const CLI::App& of, const std::string& name) {
  const auto verbs = of.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == name; });
  return verbs.empty() ? nullptr : verbs.front();
}

/// Where on the command line the word stands that is to be completed.
// The parser itself cannot be asked: it throws at the first unfinished word.
struct Place {
  const CLI::App* verb;
  const CLI::Option* value_of = nullptr;  ///< the option before it, which takes a value
  std::size_t n_arguments = 0;            ///< words before it that are neither verb nor option
  bool options_end = false;               ///< behind "--"
  std::set<const CLI::Option*> given;
};

void pass(Place& place, const std::string& word) {
  if (place.value_of != nullptr) {
    place.value_of = nullptr;
  } else if (!place.options_end && word == "--") {
    place.options_end = true;
  } else if (!place.options_end && word.starts_with("-")) {
    const CLI::Option* option = find_option(place.verb, word.substr(0, word.find('=')));
    // An option that is misspelt ends nothing: what comes behind it can still be completed.
    if (option == nullptr) return;
    place.given.insert(option);
    if (option->get_items_expected_max() > 0 && word.find('=') == word.npos) place.value_of = option;
  } else if (const CLI::App* verb = find_verb(*place.verb, word); verb != nullptr) {
    // A verb of a verb has arguments of its own.
    place.verb = verb, place.n_arguments = 0;
  } else {
    ++place.n_arguments;
  }
}

/// The argument that a word would be; nullptr: there is no room for another.
const CLI::Option* argument_at(const Place& place) {
  std::size_t n = place.n_arguments;
  for (const CLI::Option* option :
       place.verb->get_options([](const CLI::Option* o) { return o->get_positional(); })) {
    // One that takes many words takes all that follow.
    if (option->get_expected_max() > 1 || n == 0) return option;
    --n;
  }
  return nullptr;
}

/// Those of the verb, and those of the program, which every verb takes.
void add_options(Offer& offer, const CLI::App& app, const Place& place, const std::string& typed) {
  std::vector<const CLI::Option*> options =
      place.verb->get_options([](const CLI::Option* o) { return o->nonpositional(); });
  for (const CLI::Option* option : app.get_options())
    // --help is every verb's own; --version and --licences of the program make no sense behind a verb.
    if (place.verb != &app && option->get_items_expected_max() > 0) options.push_back(option);
  for (const CLI::Option* option : options)
    // What was given once takes no second value, so an offer would only lengthen the list.
    if (!place.given.contains(option) || option->get_expected_max() > 1)
      for (const std::string& name : option->get_lnames())
        add(offer, "--" + name, typed, option->get_description());
}

Offer complete(const CLI::App& app, const Words& words) {
  Place place{&app, nullptr, 0, false, {}};
  for (std::size_t i = 0; i + 1 < words.size(); ++i) pass(place, words[i]);
  // The last word is being typed, so it says nothing yet about those before it.
  const std::string typed = words.empty() ? "" : words.back();
  Offer offer;
  if (place.value_of != nullptr) {
    add_values(offer, *place.value_of, typed);
  } else if (!place.options_end && typed.starts_with("-")) {
    const std::size_t equals = typed.find('=');
    if (equals == typed.npos)
      add_options(offer, app, place, typed);
    else if (const CLI::Option* option = find_option(place.verb, typed.substr(0, equals)); option != nullptr)
      add_values(offer, *option, typed.substr(equals + 1), typed.substr(0, equals + 1));
  } else {
    const auto verbs = place.verb->get_subcommands([](const CLI::App*) { return true; });
    for (const CLI::App* verb : verbs) add(offer, verb->get_name(), typed, verb->get_description());
    const CLI::Option* argument = argument_at(place);
    if (argument != nullptr) add_values(offer, *argument, typed);
    // Nothing else can follow: then options are the only help, even before a dash is typed.
    else if (verbs.empty() && !place.options_end)
      add_options(offer, app, place, typed);
  }
  return offer;
}

/// Bash takes "--kind=rose" for three words, keeps quotes, and wants of the last word what follows the "=".
Offer complete_for_bash(const CLI::App& app, Words words) {
  // An open quote or a backslash before a space is bash's, and no part of a name that can begin as typed.
  std::erase_if(words.back(), [](char c) { return c == '\\' || c == '"' || c == '\''; });
  const auto is_value = [](const Words& w) {
    return w.size() > 2 && w[w.size() - 2] == "=" && w[w.size() - 3].starts_with("--");
  };
  // The cursor stands right behind "--kind=": the value exists and is empty.
  if (words.back() == "=") words.emplace_back();
  Words whole;
  for (const std::string& word : words) {
    whole.push_back(word);
    if (is_value(whole)) whole.erase(whole.end() - 2);  // the "=": an option and its value are two words, too
  }
  return complete(app, whole);
}

}  // namespace

CLI::Validator suggested(std::function<Words()> words) {
  struct Suggested : CLI::Validator {
    explicit Suggested(std::function<Words()> words) {
      desc_function_ = [words = std::move(words)] { return CLI::detail::join(words(), ","); };
    }
  };
  // Inactive: it checks nothing, and its words do not stand in --help.
  return Suggested(std::move(words)).name("suggested").active(false);
}

Words keys_of(const std::vector<const io::Schema*>& schemas) {
  Words keys;
  for (const io::Schema* schema : schemas)
    for (const Field& field : schema->fields)
      // Keys in quotes stand for any word of their kind, such as the header of a column: nothing to offer.
      if (field.key.find('"') == field.key.npos) keys.push_back(field.path());
  return keys;
}

void add_completion_command(CLI::App& app, Session& session) {
  struct Arguments {
    std::string shell;
    Words words;
  };
  auto args = std::make_shared<Arguments>();
  CLI::App* verb =
      app.add_subcommand("completion", "script by which a shell completes verbs, options and values");
  verb->add_option("shell", args->shell, "shell that reads the script")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb->add_option("word", args->words,
                   "of a command line, the last one unfinished: what the script asks for, behind --");
  verb->callback([args, &app, &session] {
    session.exit_code = 0;
    // The script itself is asked for without words; it hands over at least the empty one being typed.
    if (args->words.empty())
      return write_out(args->shell == "bash" ? bash_script : args->shell == "zsh" ? zsh_script : fish_script);
    const Offer offer =
        args->shell == "bash" ? complete_for_bash(app, args->words) : complete(app, args->words);
    print_out("{}\n", offer.besides);
    for (const std::string& word : offer.words) print_out("{}\n", word);
  });
}

}  // namespace phy::cli
