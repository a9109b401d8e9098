# Helpers by which every folder of Testing adds its tests.

find_package(GTest REQUIRED)
include(GoogleTest)

# Real volumes, where they exist; tests that need them skip themselves, saying so, where they do not.
set(FLIPFREE_DATA_DIR "${PROJECT_SOURCE_DIR}/../shared/data" CACHE PATH
  "Folder with real volumes and cases.csv; tests that need it are skipped where it is absent")

# flipfree_add_unit_tests(<name> SOURCES <files> LIBRARIES <targets> [LABELS <labels>])
# One GoogleTest program; each of its cases becomes one test of CTest.
function (flipfree_add_unit_tests name)
  cmake_parse_arguments(PARSE_ARGV 1 _test "" "" "SOURCES;LIBRARIES;LABELS")
  add_executable(${name} ${_test_SOURCES})
  target_link_libraries(${name} PRIVATE ${_test_LIBRARIES} GTest::gtest GTest::gtest_main
    FlipFreeWarnings)
  gtest_discover_tests(${name}
    TEST_PREFIX "${name}."
    DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${_test_LABELS}" TIMEOUT 600
               ENVIRONMENT "FLIPFREE_DATA_DIR=${FLIPFREE_DATA_DIR}")
endfunction ()

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
    cmake_path(GET _test_file STEM _test_name)
    add_test(NAME "Python.${_test_name}"
      COMMAND "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_SOURCE_DIR}/${_test_file}")
    set_tests_properties("Python.${_test_name}" PROPERTIES
      LABELS python
      TIMEOUT 300
      ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/${FLIPFREE_PYTHON_DESTINATION};PYTHONDONTWRITEBYTECODE=1;FLIPFREE_DATA_DIR=${FLIPFREE_DATA_DIR};FLIPFREE_MODULE_FOLDERS=${_test_folders}")
  endforeach ()
endfunction ()
