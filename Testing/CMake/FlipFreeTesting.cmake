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
