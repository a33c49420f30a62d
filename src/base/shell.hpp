// A word of somebody else's on its way into a command that a person pastes, as base/quote.hpp has it for
// files.
#pragma once
#include <string>
#include <string_view>

namespace phy {

/// cmd.exe and PowerShell: one word that means itself, in quotes unless nothing in it means anything to them.
/// No quotes of theirs take the meaning from %NAME% and $NAME in both.
std::string cmd_word(std::string_view text);

/// The shell that people have on this system: cmd_word(), or sh_word() of base/quote.hpp.
std::string shell_word(std::string_view text);

}  // namespace phy
