// What the program leaves for its user, and what it leaves alone. Beside its files it keeps a list of them,
// each with the fingerprint of its content. It replaces a file only where that still stands as it was
// written: files of others, or changed by hand, stay, and so does everything that the program has
// read. And what it reads of a result is held against the list: a table that was cut short or changed is told
// and not shown.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace phy::io {

/// Name of the list, in the folder of the files.
constexpr const char* written_list = ".written-by-phyllite";

/// One line of a list, with its end.
std::string list_line(const std::string& name, std::string_view content);
/// Whether a file is in the list of `folder` and as it was written; `name` may lie in a subfolder.
bool is_as_written(const std::string& folder, const std::string& name);
/// The content of a file of a result. Where the list beside it has its name, it must be as it was written;
/// what is in no list (of other programs, or moved without it) is read as it is. Throws IoError.
std::string read_written(const std::string& file);
/// Puts a file into the list beside it, before it appears, so that none is ever forgotten. It is written to
/// `part` and will be renamed. A list that cannot be written is no failure: the file will then not be
/// replaced.
void list_written(const std::string& file, const std::string& part);

/// Whether a file has this very content, so that writing it again would change nothing.
bool holds(const std::string& file, const std::string& content);

/// Throws InputError with every file that is in the way. To be called when the inputs have been read, and
/// before anything is computed. `word` is the option that named the files (base/option.hpp); empty: none
/// did.
void check_outputs(const std::vector<std::string>& files, const std::string& word = "out");

/// Throws InputError where the name of a file has another ending than these: a picture that is called
/// calibration.json would take the place of one. A name without an ending is free.
void check_ending(const std::string& file, const std::vector<std::string>& endings);

/// write_file(), where nothing is in the way. A file that holds this content already is left as it is.
void write_output(const std::string& file, const std::string& content);

}  // namespace phy::io
