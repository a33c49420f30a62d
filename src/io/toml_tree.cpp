#include "io/toml_tree.hpp"

// toml++ 3.3 asserts on some half-written headers and misreads some non-ASCII keys (upstream issue 294): its
// assertions are made harmless here, and the scan below refuses such bytes before the parser sees them.
#undef NDEBUG
#define TOML_ASSERT(x) static_assert(true)
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <toml++/toml.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cstring>

#include "base/largest_file.hpp"
#include "base/quote.hpp"
#include "base/trimmed.hpp"
#include "base/units.hpp"

namespace phy::io {
namespace {

constexpr std::size_t max_line = 4096;    // bounds the work on one line
constexpr int max_dots = 16;              // of one key: tables in tables, on which parser and tree recurse
constexpr std::size_t max_problems = 50;  // more in one message do not help the user

/// Follows strings and comments through a text, one character after the other.
class Lexer {
 public:
  /// Takes the character at `i`; may move `i` on over the rest of an escape or of triple quotes.
  void take(std::string_view text, std::size_t& i) {
    const char c = text[i];
    if (c == '\n') {
      comment_ = false;
      // TOML strings in single or double quotes end with their line; triple ones go on.
      if (!triple_) quote_ = 0;  // a string that is not closed ends with its line
    } else if (comment_) {
      return;
    } else if (quote_ == 0) {
      comment_ = c == '#';
      if (c == '"' || c == '\'') open(text, i);
    } else if (quote_ == '"' && c == '\\' && i + 1 < text.size() && text[i + 1] != '\n') {
      // In basic strings a backslash hides the next character; control characters are left to the scan below.
      if (static_cast<unsigned char>(text[i + 1]) >= 32) ++i;
    } else if (c == quote_ && !triple_) {
      quote_ = 0;
    } else if (c == quote_ && text.substr(i, 3) == std::string(3, c)) {
      // Three of the opening quote close a triple string.
      quote_ = 0, i += 2;
    }
  }
  bool in_text() const { return comment_ || quote_ != 0; }

 private:
  char quote_ = 0;
  bool triple_ = false, comment_ = false;

  void open(std::string_view text, std::size_t& i) {
    quote_ = text[i];
    triple_ = text.substr(i, 3) == std::string(3, quote_);
    if (triple_) i += 2;
  }
};

/// Lines in another encoding, one problem a line.
void find_other_encodings(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  std::size_t line = 1, told = 0;
  for (std::size_t i = 0; i < text.size() && problems.size() < max_problems;) {
    // Zero bytes long: no UTF-8 starts here. One message per line.
    const std::size_t n = utf8_length(text.substr(i));
    if (n == 0 && told != line)
      problems.push_back({at_line(where, told = line), "", "", "text in UTF-8", "save the file as UTF-8"});
    line += text[i] == '\n' ? 1 : 0;
    i += std::max<std::size_t>(1, n);
  }
}

/// Control characters anywhere, other than ASCII outside strings and comments, and overlong lines: one
/// problem a line.
void scan(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  // Before anything is parsed: a wrong file (a picture, a dump) is refused at once.
  if (text.size() > largest_document) {
    problems.push_back({where, "", "", "a file of at most 1 MB", "this is some other file"});
    return;
  }
  // In another encoding every line would raise the errors below: say this first and alone.
  find_other_encodings(text, where, problems);
  if (!problems.empty()) return;
  Lexer lexer;
  std::size_t line = 1, begin = 0, told = 0;
  int dots = 0;
  const auto report_problem = [&](const std::string& expected, const std::string& remedy) {
    if (told != line) problems.push_back({at_line(where, line), "", "", expected, remedy});
    told = line;
  };
  for (std::size_t i = 0; i < text.size() && problems.size() < max_problems; ++i) {
    const auto u = static_cast<unsigned char>(text[i]);
    // The lexer is fed every character, so it knows whether this one is inside a string or comment.
    lexer.take(text, i);
    if (u == '\n') {
      ++line, begin = i + 1, dots = 0;
      continue;
    }
    // Bytes above 127 outside strings are mostly typographic quotes or blanks copied from a text processor.
    if (u == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'))
      report_problem("line ends of Unix or Windows",
                     "save the file with them: line ends of old Macs are not TOML");
    const bool control = (u < 32 && u != '\r' && u != '\t') || u == 127;
    if (control || (u > 127 && !lexer.in_text()))
      report_problem("plain ASCII text",
                     "remove the odd character (byte " + std::to_string(u) + ") from this line");
    if (!lexer.in_text() && std::strchr(",=[]{}", text[i]) != nullptr) dots = 0;
    if (!lexer.in_text() && text[i] == '.' && ++dots > max_dots)
      report_problem("keys of at most " + std::to_string(max_dots) + " full stops",
                     "this is some other file");
    if (i - begin >= max_line)
      report_problem("lines of at most " + std::to_string(max_line) + " characters", "break the line");
  }
}

/// May toml++ see it? A part of a text can be what the whole is not: a quote that was open above is gone.
bool passes_scan(std::string_view text) {
  std::vector<Problem> problems;
  scan(text, "", problems);
  return problems.empty();
}

/// A parsed value without toml++.
TomlValue tree_of(const toml::node& node) {
  TomlValue v;
  // The line is kept for messages about the value.
  v.line = node.source().begin.line;
  if (const auto* s = node.as_string())
    v.kind = TomlValue::Kind::text, v.text = s->get();
  else if (const auto* n = node.as_integer())
    // The integer as it was written: beyond 2^53 a double would print another number.
    v.kind = TomlValue::Kind::integer, v.number = static_cast<double>(n->get()),
    v.text = std::to_string(n->get());
  else if (const auto* d = node.as_floating_point())
    v.kind = TomlValue::Kind::number, v.number = d->get();
  else if (const auto* b = node.as_boolean())
    v.kind = TomlValue::Kind::boolean, v.number = b->get() ? 1.0 : 0.0;
  else if (const auto* list = node.as_array()) {
    v.kind = TomlValue::Kind::list;
    for (const toml::node& item : *list) v.items.push_back(tree_of(item));
  } else if (const auto* table = node.as_table()) {
    v.kind = TomlValue::Kind::table;
    for (const auto& [key, item] : *table) {
      v.keys.push_back({std::string(key.str()), key.source().begin.line});
      v.items.push_back(tree_of(item));
    }
  }
  return v;
}

/// Texts with control characters, written as escapes or over several lines: a name that other programs,
/// terminals and scripts would take for more than a name.
void find_control_characters(const toml::node& node, const std::string& path, const std::string& where,
                             std::vector<Problem>& problems) {
  if (const auto* s = node.as_string(); s != nullptr && !is_plain(s->get()))
    problems.push_back({at_line(where, node.source().begin.line), path, as_written(tree_of(node)),
                        "text without line breaks and other control characters",
                        "write it on one line, and / in place of \\"});
  if (const auto* list = node.as_array())
    for (const toml::node& item : *list) find_control_characters(item, path, where, problems);
  if (const auto* table = node.as_table())
    for (const auto& [key, item] : *table)
      find_control_characters(item, path + (path.empty() ? "" : ".") + std::string(key.str()), where,
                              problems);
}

std::size_t begin_of_line(std::string_view text, std::size_t line) {
  std::size_t at = 0;
  for (std::size_t i = 1; i < line && at < text.size(); ++i)
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  return at;
}

bool stands_twice(std::string_view problem) { return problem.find("redefin") != problem.npos; }

/// True for a "key = value" line that is wrong in itself, so that the text without it is what was meant. Not
/// for a line that only follows a mistake (an open list), nor for a header: the keys below it would land in
/// another table.
bool can_be_left_out(std::string_view line, std::string_view problem) {
  const std::size_t equals = line.find('=');
  if (equals == line.npos || line.find_first_of("[#") < equals) return false;
  return stands_twice(problem) || !passes_scan(line) || !toml::parse(line);
}

/// The likeliest slip in a line "key = value" that is no TOML.
std::string syntax_remedy(std::string_view line, std::string_view problem) {
  if (stands_twice(problem)) return "a key stands once in its table: remove one of the two";
  const std::size_t equals = line.find('=');
  if (equals == line.npos) return "";
  const std::size_t at = line.find_first_not_of(" \t", equals + 1);
  if (at == line.npos) return "write a value behind the =";
  const char c = line[at];
  const bool quoted = c == '"' || c == '\'';
  if (quoted && std::count(line.begin(), line.end(), c) % 2 == 1) return "close the quotes";
  // Names of files under Windows: in double quotes \U begins a letter, and \t is a tabulator.
  if (c == '"' && line.find('\\') != line.npos) return "write / in place of \\, or the text in single quotes";
  if (quoted) return "";
  // TOML has no fractions, and "1/3" is a likely slip where ratios are asked for.
  if (const std::optional<double> quotient = fraction(line.substr(at, line.find('#', at) - at)))
    return "write it as a number: " + print_number(rounded(*quotient, 6));
  if (c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9'))
    return "put a quantity in quotes: \"38 mm\"";
  return c == '[' || c == '{' ? "" : "put text in quotes; a switch is true or false";
}

/// Parses, and after a syntax error goes on without that line, so that one slip of the pen does not hide the
/// next.
toml::parse_result parse_all(std::string text, const std::string& where, std::vector<Problem>& problems) {
  for (;;) {
    // toml++ stops at the first error.
    toml::parse_result result = toml::parse(text);
    if (result) return result;
    const std::string description(result.error().description());
    const std::size_t line = result.error().source().begin.line;
    const std::size_t begin = begin_of_line(text, line), end = std::min(text.find('\n', begin), text.size());
    const std::string_view content = std::string_view(text).substr(begin, end - begin);
    // A list that is not closed is noticed lines later: the cause is above the line of the error.
    const bool in_list = description.find("array") != std::string::npos;
    const bool left_out = can_be_left_out(content, description);
    const std::string key(left_out ? trimmed(content.substr(0, content.find('='))) : "");
    problems.push_back({at_line(where, line), key, "", "TOML (" + description + ")",
                        left_out  ? syntax_remedy(content, description)
                        : in_list ? "close the list begun above with ]"
                                  : ""});
    // Where the line is not the cause, parsing again would only find consequences.
    if (problems.size() >= max_problems || !left_out) return result;
    // The line break stays, so that line numbers do not change.
    text.erase(begin, end - begin);
    if (!passes_scan(text)) return result;
  }
}

/// The table of a whole text. Throws InputError where nothing can be read; else problems are added.
toml::table parse_checked(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  // A byte-order mark of UTF-8, as Windows editors write it.
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  scan(text, where, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  toml::parse_result result = parse_all(std::string(text), where, problems);
  if (!result) throw InputError(std::move(problems));
  find_control_characters(result.table(), "", where, problems);
  return std::move(result).table();
}

}  // namespace

std::string at_line(const std::string& where, std::size_t line) {
  return line == 0 ? where : where + ":" + std::to_string(line);
}

TomlValue parse_toml(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  return tree_of(parse_checked(text, where, problems));
}

std::optional<double> fraction(std::string_view text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  if (slash == text.size()) return {};
  const Quantity over = parse_quantity(text.substr(0, slash), Dimension::none),
                 under = parse_quantity(text.substr(slash + 1), Dimension::none);
  if (!over.ok || !under.ok || under.value == 0.0) return {};
  return over.value / under.value;
}

const TomlValue* TomlValue::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i].name == key) return &items[i];
  return nullptr;
}

std::string as_written(const TomlValue& v) {
  switch (v.kind) {
    case TomlValue::Kind::text: return toml_string(v.text);
    case TomlValue::Kind::integer: return v.text;
    case TomlValue::Kind::number: return print_number(v.number);
    case TomlValue::Kind::boolean: return v.number != 0.0 ? "true" : "false";
    case TomlValue::Kind::list: return "a list";
    case TomlValue::Kind::table: return "a table";
    case TomlValue::Kind::date: break;
  }
  return "a date";
}

}  // namespace phy::io
