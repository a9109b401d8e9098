# Runs a program that is to end at once: with STATUS, having printed what OUTPUT and ERRORS say.
#
#   cmake -DSTATUS=<number> -DOUTPUT=<regex> -DERRORS=<regex> -P ExpectEnd.cmake -- <command...>
include("${CMAKE_CURRENT_LIST_DIR}/ReadCommand.cmake")

execute_process(COMMAND ${command}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
message(STATUS "${status}\n${output}${errors}")
if (NOT status STREQUAL STATUS)
  message(FATAL_ERROR "it ended with ${status}, not with ${STATUS}")
endif ()
if (NOT output MATCHES "${OUTPUT}" OR NOT errors MATCHES "${ERRORS}")
  message(FATAL_ERROR "it did not print '${OUTPUT}' and complain '${ERRORS}'")
endif ()
