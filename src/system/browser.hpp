// The browser that the user has chosen for this desktop.
#pragma once
#include <string>

namespace phy::system {

/// Whether somebody sits at a desktop of this machine: a remote shell has none.
bool has_desktop();
/// Asks the desktop to show a file or an address, and does not wait. False: there is nothing that could.
bool open_in_browser(const std::string& what);

}  // namespace phy::system
