# Writes the runtime's header from its parts: a line `#include "parts/NAME.h"` becomes that file.
#
#   cmake -P lib/runtime/amalgamate.cmake              writes lib/runtime/sightline_runtime.h
#   cmake -DCHECK=ON -P lib/runtime/amalgamate.cmake   fails if that file is not what it would write
set(header "${CMAKE_CURRENT_LIST_DIR}/sightline_runtime.h")
file(READ "${header}.in" whole)
string(REGEX MATCHALL "#include \"parts/[a-z_]+\\.h\"\n" lines "${whole}")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "#include \"(.*)\"\n" "\\1" part "${line}")
  file(READ "${CMAKE_CURRENT_LIST_DIR}/${part}" text)
  # The first line of a part says what it holds: it becomes a heading.
  string(REGEX REPLACE "^/// ([^\n]*)\\.\n\n" "// --- \\1\n\n" text "${text}")
  string(REPLACE "${line}" "${text}\n" whole "${whole}")
endforeach()
string(REPLACE "\n\n\n" "\n\n" whole "${whole}")
if(NOT CHECK)
  file(WRITE "${header}" "${whole}")
  return()
endif()
file(READ "${header}" stored)
if(NOT stored STREQUAL whole)
  message(FATAL_ERROR "lib/runtime/sightline_runtime.h differs from its parts. "
                      "Change the parts, then: cmake -P lib/runtime/amalgamate.cmake")
endif()
