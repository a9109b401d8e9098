# What a user of the installed package meets. Run by CTest, see CMakeLists.txt for the variables.

# run(<what> <command...>) fails the test unless the command succeeds; its output goes to `output`.
macro (run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if (NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed (${status}):\n${output}")
  endif ()
  message(STATUS "${what}: as it should be")
endmacro ()

# refuse(<what> <pattern> <command...>) fails it unless the command fails with such a message.
macro (refuse what pattern)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}") # CMake wraps its messages
  if (status EQUAL 0 OR NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${what}: status ${status}, and not '${pattern}' in:\n${output}")
  endif ()
  message(STATUS "${what}: refused as it should be")
endmacro ()

unset(ENV{DESTDIR})
file(REMOVE_RECURSE "${WORK}")
run("Installing" "${CMAKE_COMMAND}" --install "${BUILD_TREE}" --prefix "${WORK}/first")

# An installation can be moved, so nothing in it may name the place where it was made.
set(prefix "${WORK}/prefix with a space")
file(RENAME "${WORK}/first" "${prefix}")
# Binaries by their strings, without what is for debuggers.
find_program(OBJCOPY objcopy REQUIRED)
file(GLOB_RECURSE files "${prefix}/*")
foreach (file IN LISTS files)
  set(content "${file}")
  file(READ "${file}" magic LIMIT 4 HEX)
  if (magic STREQUAL "7f454c46" OR file MATCHES "[.]a$")
    set(content "${WORK}/stripped")
    execute_process(COMMAND "${OBJCOPY}" --strip-debug "${file}" "${content}" COMMAND_ERROR_IS_FATAL ANY)
  endif ()
  foreach (place IN ITEMS "${BUILD_TREE}" "${SOURCE_TREE}")
    execute_process(COMMAND grep --fixed-strings --quiet --regexp=${place} "${content}" RESULT_VARIABLE status)
    if (NOT status EQUAL 1)
      message(FATAL_ERROR "${file} names ${place} (grep: ${status})")
    endif ()
  endforeach ()
endforeach ()
list(LENGTH files count)
message(STATUS "${count} files name neither the build nor the source")

set(configure "${CMAKE_COMMAND}" -G "${GENERATOR}"
  "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}"
  "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
  "-DFlipFree_DIR=${prefix}/${CMAKE_DESTINATION}"
  -S "${CMAKE_CURRENT_LIST_DIR}/Consumer")

run("Configuring a program that uses it"
  ${configure} -B "${WORK}/consumer" "-DVTK_DIR=${VTK_DIR}" "-DEXPECTED_VERSION=${VERSION}")
run("Building that program" "${CMAKE_COMMAND}" --build "${WORK}/consumer")
run("Running that program" "${WORK}/consumer/consumer")
if (NOT output STREQUAL "6144 points\n")
  message(FATAL_ERROR "the program printed: ${output}")
endif ()

refuse("A component that there is not"
  "has no component Transmogrification; it has [A-Za-z, ]*Segmentation"
  ${configure} -B "${WORK}/component" "-DVTK_DIR=${VTK_DIR}" -DCOMPONENT=Transmogrification)
foreach (other IN ITEMS 9.0.3 9.99.0)
  refuse("Another VTK"
    "built on VTK [0-9.]+ and works with no other, but VTK ${other} was found in .*OtherVTK"
    ${configure} -B "${WORK}/vtk" "-DVTK_DIR=${CMAKE_CURRENT_LIST_DIR}/OtherVTK" -DOTHER_VTK=${other})
endforeach ()
refuse("A later version than there is" "requested version \"1000\""
  ${configure} -B "${WORK}/version" "-DVTK_DIR=${VTK_DIR}" -DMINIMUM_VERSION=1000)

if (PYTHON)
  run("Reading the documents"
    "${PYTHON}" -B "${CMAKE_CURRENT_LIST_DIR}/TestDocuments.py" "${prefix}")
  foreach (file IN ITEMS py.typed FlipFreeSegmentation.pyi _segment.py _segment.pyi)
    if (NOT EXISTS "${prefix}/${PYTHON_DESTINATION}/flipfree/${file}")
      message(FATAL_ERROR "the Python package lacks ${file}")
    endif ()
  endforeach ()
  run("Importing the installed Python package" "${CMAKE_COMMAND}" -E env
    "PYTHONPATH=${prefix}/${PYTHON_DESTINATION}" --unset=LD_LIBRARY_PATH
    "${PYTHON}" -c "
from flipfree import vtkQuadSphereSource
import flipfree
assert flipfree.__file__.startswith('${prefix}'), flipfree.__file__
sphere = vtkQuadSphereSource()
sphere.Update()
assert sphere.GetOutput().GetNumberOfPoints() == 6144
with open('/proc/self/maps') as maps:
    strays = {line.split()[-1] for line in maps if '${BUILD_TREE}/lib' in line}
assert not strays, strays
")
  if (EXISTS "${prefix}/bin/flipfree")
    run("Following the readme and the guide" "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/TestReadme.py"
      "${prefix}/share/doc/flipfree" "${prefix}" "${PYTHON_DESTINATION}" "${VTK_DIR}" "${CXX_COMPILER}")
  endif ()
endif ()
