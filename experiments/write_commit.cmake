# Writes ${OUTPUT} with the commit of ${SOURCE}. Runs at every build, but touches the file only when the commit changed,
# so that nothing is compiled again for its sake.
execute_process(
  COMMAND git describe --always --dirty --abbrev=12
  WORKING_DIRECTORY ${SOURCE}
  OUTPUT_VARIABLE commit
  ERROR_QUIET
  OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT commit)
  set(commit "unknown")
endif()
set(text "// Written by the build.\n#pragma once\nnamespace deliso {\ninline constexpr const char* kCommit = \"${commit}\";\n}\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old_text)
endif()
if(NOT "${text}" STREQUAL "${old_text}")
  file(WRITE ${OUTPUT} "${text}")
endif()
