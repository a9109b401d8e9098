# Warnings belong to our own targets only; headers of the dependencies stay out of it.
add_library(FlipFreeWarnings INTERFACE)
if (CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(FlipFreeWarnings INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wshadow;-Wnon-virtual-dtor;-Woverloaded-virtual>)
  if (CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Sources are included then, and their anonymous namespaces taken for those of headers.
    target_compile_options(FlipFreeWarnings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
  endif ()
  if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # With all optimizations, GCC 14 takes what an empty std::optional would hold for used.
    target_compile_options(FlipFreeWarnings INTERFACE
      $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:Release>>:-Wno-maybe-uninitialized>)
  endif ()
  if (FLIPFREE_WARNINGS_AS_ERRORS)
    target_compile_options(FlipFreeWarnings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
  endif ()
endif ()

# Messages name source files from the top of the project, not from the root of the build machine.
if (CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  get_filename_component(_flipfree_top "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
  add_compile_options("-fmacro-prefix-map=${_flipfree_top}/=")
endif ()

# Sanitizers belong to everything, since they change how objects are laid out and linked.
if (FLIPFREE_SANITIZERS)
  add_compile_options("-fsanitize=${FLIPFREE_SANITIZERS}" -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  add_link_options("-fsanitize=${FLIPFREE_SANITIZERS}")
  # Clang leaves Eigen's many small functions as calls once they are instrumented: tests take four times as long.
  if (CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    add_compile_definitions("EIGEN_STRONG_INLINE=inline __attribute__((always_inline))")
  endif ()
endif ()

# Only Filters is instrumented, in Filters/CMakeLists.txt; whoever links it needs gcov's run time.
if (FLIPFREE_COVERAGE)
  add_link_options(--coverage)
endif ()

if (FLIPFREE_USE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(FLIPFREE_CCACHE ccache)
  mark_as_advanced(FLIPFREE_CCACHE)
  if (FLIPFREE_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${FLIPFREE_CCACHE}")
  endif ()
endif ()
