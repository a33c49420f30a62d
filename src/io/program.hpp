// Other programs that write pictures: gnuplot for figures, ffmpeg for films. Both are Debian packages;
// neither is needed to compute.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace phy::io {

/// Starts `program` (looked for along PATH) with its standard input open, lets `feed` write to it, and waits.
/// Throws IoError when it is not installed (naming `package`) or does not succeed (with what it said).
void run_program(const std::string& program, const std::vector<std::string>& arguments,
                 const std::string& package,
                 const std::function<void(const std::function<void(const std::string&)>& write)>& feed);

/// Lets `make` write a file under a temporary name and renames it onto its place. The name keeps its ending,
/// from which programs tell formats.
void make_file(const std::string& path, const std::function<void(const std::string& temporary)>& make);

}  // namespace phy::io
