// Text that somebody else chose - names, cells of tables, file names, results of other people - on its way
// into another language. One function per language; each says what it guarantees, for any bytes whatever.
// What is no language of its own needs none: a number, a word of this program, an argument of a program that
// is started without a shell.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace phy {

/// Bytes of the UTF-8 character at the front of a text; 0: there is none.
std::size_t utf8_length(std::string_view text);

/// UTF-8 throughout, and no control character: line breaks, tabs, escape, delete, U+0080 to U+009F. What a
/// name may be.
bool is_plain(std::string_view text);

/// Terminal: what is neither plain nor a line break becomes visible, "\x1b" for escape. So a text cannot move
/// the cursor, recolour, retitle or overwrite what stands there.
std::string terminal_text(std::string_view text);

/// Line comment of Python, PFC (FISH), sh and CSV, behind its mark: stays on its line, whatever ends lines
/// there. Python takes an encoding from a comment in its first two lines: a script says its own before.
std::string comment_text(std::string_view text);

/// TOML: a basic string with its quotes, which reads back to the same bytes.
std::string toml_string(std::string_view text);

/// TOML: a list of finished values. A long one goes over several lines, as what reads it limits their length.
std::string toml_list(const std::vector<std::string>& values);

/// CSV: one cell of one line, in quotes where it holds separators, quotes, the mark of a comment or blanks at
/// its ends.
std::string csv_cell(std::string_view text);

/// sh: one word that means itself, in quotes unless nothing in it means anything to a shell.
std::string sh_word(std::string_view text);
/// cmd.exe and PowerShell: the same. No quotes of theirs take the meaning from %NAME% and $NAME in both.
std::string cmd_word(std::string_view text);
/// The one of the two that this system has.
std::string shell_word(std::string_view text);
/// This program with its words, to be pasted into that shell: "phyllite calibrate 'my rock.toml'".
std::string command_of(const std::vector<std::string>& words);

/// gnuplot: a string expression of parts in single quotes, in which it looks for neither commands
/// (backquotes) nor macros nor escapes.
std::string gnuplot_string(std::string_view text);
/// gnuplot: the same text among markup ("enhanced"), shown as it is; gnuplot_string() goes around the whole.
std::string gnuplot_plain(std::string_view text);

/// JSON (finished text) inside a script element of HTML: nothing in it ends the element or begins a comment.
std::string json_in_script(std::string_view json);

}  // namespace phy
