# Stands for a VTK that FlipFree was not built on.
set(VTK_FOUND TRUE)
set(VTK_VERSION 9.99.0)
set(VTK_MAJOR_VERSION 9)
set(VTK_MINOR_VERSION 99)
