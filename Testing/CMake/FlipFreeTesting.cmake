# Helpers by which every folder of Testing adds its tests.

find_package(GTest REQUIRED)
include(GoogleTest)

set(FLIPFREE_PARAVIEW_BUILD "${PROJECT_SOURCE_DIR}/build/paraview" CACHE PATH
  "Folder in which Wrapping/ParaView/build-plugin.sh has built the plugin; its tests are skipped without it")

# flipfree_add_unit_tests(<name> SOURCES <files> LIBRARIES <targets> [LABEL <label>] [LONG <patterns>])
# One GoogleTest program; each of its cases becomes one test of CTest. With sanitizers, a process per case
# would spend most of its time loading VTK, so a few processes share the cases; those whose names match the
# patterns of LONG are left out, since they repeat at length what shorter ones do.
function (flipfree_add_unit_tests name)
  cmake_parse_arguments(PARSE_ARGV 1 _test "" "LABEL" "SOURCES;LIBRARIES;LONG")
  add_executable(${name} ${_test_SOURCES})
  target_link_libraries(${name} PRIVATE ${_test_LIBRARIES} GTest::gtest GTest::gtest_main
    Threads::Threads FlipFreeWarnings)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/Testing/Support")
  # Three quarters of a test's compile time go into headers. Eight sources at a time, whatever the libraries' number is:
  # tests' names are unique within their files only.
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${name} PRIVATE -Wno-subobject-linkage) # fixtures in anonymous namespaces
  endif ()
  set(_test_environment "FLIPFREE_DATA_DIR=${FLIPFREE_DATA_DIR}")
  if (NOT FLIPFREE_SANITIZERS)
    gtest_discover_tests(${name}
      TEST_PREFIX "${name}."
      DISCOVERY_TIMEOUT 60
      PROPERTIES LABELS "${_test_LABEL}" TIMEOUT 600 ENVIRONMENT "${_test_environment}")
    return ()
  endif ()
  list(JOIN _test_LONG ":" _test_long)
  set(_test_shards 4)
  foreach (_test_shard RANGE 1 ${_test_shards})
    math(EXPR _test_index "${_test_shard} - 1")
    add_test(NAME "${name}.${_test_shard}" COMMAND ${name} "--gtest_filter=-${_test_long}")
    set_tests_properties("${name}.${_test_shard}" PROPERTIES
      LABELS "${_test_LABEL}"
      TIMEOUT 1200
      ENVIRONMENT "${_test_environment};GTEST_TOTAL_SHARDS=${_test_shards};GTEST_SHARD_INDEX=${_test_index}")
  endforeach ()
endfunction ()

# Where the test Python.KeepAbdomen keeps the phantom that others read: those with the fixture Abdomen.
set(FLIPFREE_ABDOMEN "${PROJECT_BINARY_DIR}/Testing/Python/abdomen.npz")

# flipfree_add_python_tests(<files>)
# Each file is one test of CTest: a program of Python's unittest that imports `flipfree` from the build
# tree. The interpreter is the one VTK's wrapping was built for.
function (flipfree_add_python_tests)
  set(_test_folders)
  foreach (_test_module IN LISTS FLIPFREE_MODULES)
    string(REPLACE "FlipFree::" "" _test_folder "${_test_module}")
    list(APPEND _test_folders "${PROJECT_SOURCE_DIR}/Filters/${_test_folder}")
  endforeach ()
  list(JOIN _test_folders ":" _test_folders)
  foreach (_test_file IN LISTS ARGN)
    get_filename_component(_test_name "${_test_file}" NAME_WE)
    add_test(NAME "Python.${_test_name}"
      COMMAND "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_SOURCE_DIR}/${_test_file}")
    set_tests_properties("Python.${_test_name}" PROPERTIES
      LABELS python
      TIMEOUT 300
      FIXTURES_REQUIRED Abdomen
      ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/${FLIPFREE_PYTHON_DESTINATION};PYTHONDONTWRITEBYTECODE=1;FLIPFREE_ABDOMEN=${FLIPFREE_ABDOMEN};FLIPFREE_DATA_DIR=${FLIPFREE_DATA_DIR};FLIPFREE_MODULE_FOLDERS=${_test_folders};FLIPFREE_PYTHON_SOURCE=${PROJECT_SOURCE_DIR}/Wrapping/Python")
  endforeach ()
endfunction ()

# flipfree_add_image_tests(<name> SOURCES <files> LIBRARIES <targets>)
# One program of VTK's image tests: each source TestThing.cxx defines `int TestThing(int, char*[])` and
# becomes one test of CTest, which compares its picture with Testing/Data/Baseline/TestThing.png. Where
# they differ, picture and difference are left in the build's Testing/Temporary.
function (flipfree_add_image_tests name)
  cmake_parse_arguments(PARSE_ARGV 1 _test "" "" "SOURCES;LIBRARIES")
  set(DISABLE_FLOATING_POINT_EXCEPTIONS ON) # graphics drivers rely on them being off
  include("${VTK_DIR}/vtkTestingRenderingDriver.cmake")
  create_test_sourcelist(_test_driver "${name}.cxx" ${_test_SOURCES}
    EXTRA_INCLUDE vtkTestingObjectFactory.h)
  add_executable(${name} ${_test_driver})
  set(_test_vtk
    VTK::InteractionStyle
    VTK::RenderingFreeType
    VTK::RenderingOpenGL2
    VTK::TestingRendering)
  target_link_libraries(${name} PRIVATE ${_test_LIBRARIES} ${_test_vtk} FlipFreeWarnings)
  vtk_module_autoinit(TARGETS ${name} MODULES ${_test_vtk})
  set(_test_pictures "${PROJECT_BINARY_DIR}/Testing/Temporary")
  foreach (_test_source IN LISTS _test_SOURCES)
    get_filename_component(_test_case "${_test_source}" NAME_WE)
    add_test(NAME "Images.${_test_case}"
      COMMAND ${name} ${_test_case}
        -D "${PROJECT_SOURCE_DIR}/Testing/Data"
        -T "${_test_pictures}"
        -V "${PROJECT_SOURCE_DIR}/Testing/Data/Baseline/${_test_case}.png")
    set_tests_properties("Images.${_test_case}" PROPERTIES
      LABELS images
      TIMEOUT 300
      FAIL_REGULAR_EXPRESSION "(\n|^)ERROR: ;ERR\\|;Failed Image Test;ImageNotFound"
      ENVIRONMENT "FLIPFREE_DATA_DIR=${FLIPFREE_DATA_DIR}")
  endforeach ()
endfunction ()
