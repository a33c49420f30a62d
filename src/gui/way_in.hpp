// The file by which this user comes to the page: it leads a browser there, token and all. Only the user can
// read it. It stays when the program ends, and the next start in this folder takes its token again, so that
// open tabs go on.
#pragma once
#include <string>

namespace phy::gui {

/// In the folder that the page works in. Not hidden: browsers in a sandbox may open no file that is.
constexpr const char* way_in_file = "open-phyllite.html";

/// The token of an earlier start; a new one where there was none, or others could read it.
std::string kept_token(const std::string& file);
/// Where it cannot be written a later start has another token: nothing else is lost.
void write_way_in(const std::string& file, const std::string& address);

}  // namespace phy::gui
