/**
 * Surfaces in files, by their ending. Coordinates are LPS millimeters in every format, as they are.
 */
#ifndef FlipFreeCommandSurfaceFile_h
#define FlipFreeCommandSurfaceFile_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace Command
{

/// Endings of the surfaces that can be read and written.
const std::vector<std::string>& SurfaceEndings();

vtkSmartPointer<vtkPolyData> ReadSurface(const std::string& name);

/// Writes a surface and reads it back, since VTK's writers do not tell of every failure. In .stl
/// its faces become triangles, the other formats keep them.
void WriteSurface(const std::string& name, vtkPolyData* surface);

} // namespace Command

#endif
