# Warnings belong to our own targets only; headers of the dependencies stay out of it.
add_library(FlipFreeWarnings INTERFACE)
if (CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(FlipFreeWarnings INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wshadow;-Wnon-virtual-dtor;-Woverloaded-virtual>)
  if (FLIPFREE_WARNINGS_AS_ERRORS)
    target_compile_options(FlipFreeWarnings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
  endif ()
endif ()
