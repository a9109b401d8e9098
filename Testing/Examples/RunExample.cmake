# Runs an example with --picture: it has to succeed, to complain of nothing, to print what PATTERN says,
# and to leave a picture that shows something.
#
#   cmake -DPICTURE=<file> -DPATTERN=<regex> -P RunExample.cmake -- <command...>
include("${CMAKE_CURRENT_LIST_DIR}/ReadCommand.cmake")

get_filename_component(folder "${PICTURE}" DIRECTORY)
file(MAKE_DIRECTORY "${folder}")
file(REMOVE "${PICTURE}")
execute_process(COMMAND ${command} --picture "${PICTURE}"
  WORKING_DIRECTORY "${folder}"
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
message(STATUS "${output}${errors}")
if (NOT status EQUAL 0)
  message(FATAL_ERROR "it failed: ${status}")
endif ()
if (errors MATCHES "ERROR:|[Ww]arning")
  message(FATAL_ERROR "it complained")
endif ()
if (NOT output MATCHES "${PATTERN}")
  message(FATAL_ERROR "it did not print '${PATTERN}'")
endif ()
if (NOT EXISTS "${PICTURE}")
  message(FATAL_ERROR "it left no picture")
endif ()
# An empty view compresses to next to nothing.
file(SIZE "${PICTURE}" size)
if (size LESS 50000)
  message(FATAL_ERROR "${PICTURE} has ${size} bytes, so it shows hardly anything")
endif ()
