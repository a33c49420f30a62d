# Writes version.cpp: the release, or "VERSION-dev+COMMIT", with ".changed" where tracked files differ from the commit.
set(version ${RELEASE}${DEV})
if(DEV AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND git rev-parse --short=8 HEAD WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    execute_process(COMMAND git diff --quiet HEAD WORKING_DIRECTORY ${SOURCE} ERROR_QUIET RESULT_VARIABLE changed)
    string(APPEND version +${commit})
    if(changed)
      string(APPEND version .changed)
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT [[#include "base/version.hpp"

namespace phy {

const char* const version = "@version@";
const char* const program = "phyllite @version@";

}  // namespace phy
]] @ONLY)
