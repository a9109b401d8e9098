# Included behind project(FlipFree): makes the VTK at hand look like one without rendering, charts,
# input and output, by refusing components that such a VTK does not have.
macro (find_package _little_name)
  if ("${_little_name}" STREQUAL "VTK")
    foreach (_little_component IN ITEMS ${ARGN})
      if ("${_little_component}" MATCHES "^(Charts|Geovis|IO|Interaction|Rendering|Testing|Views)")
        message(FATAL_ERROR "The modules alone ask VTK for ${_little_component}.")
      endif ()
    endforeach ()
  endif ()
  _find_package(${_little_name} ${ARGN})
endmacro ()
