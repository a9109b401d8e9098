# Stands for a VTK that FlipFree was not built on: of the version OTHER_VTK.
set(VTK_FOUND TRUE)
set(VTK_VERSION "${OTHER_VTK}")
string(REGEX MATCH "^([0-9]+)[.]([0-9]+)" _other "${OTHER_VTK}")
set(VTK_MAJOR_VERSION "${CMAKE_MATCH_1}")
set(VTK_MINOR_VERSION "${CMAKE_MATCH_2}")
