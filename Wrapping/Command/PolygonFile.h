/**
 * Reads PLY and OBJ surfaces: points and polygons, nothing else. VTK's readers of these formats
 * trust the counts and indices in a file, and read or write beyond their arrays where it is
 * damaged.
 */
#ifndef FlipFreeCommandPolygonFile_h
#define FlipFreeCommandPolygonFile_h

#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;

namespace Command
{

/// They throw a Failure that says what is wrong in the file.
vtkSmartPointer<vtkPolyData> ReadPly(const std::string& name);
vtkSmartPointer<vtkPolyData> ReadObj(const std::string& name);

/// Corners in the same place become one vertex.
vtkSmartPointer<vtkPolyData> ReadStl(const std::string& name);

/// Points and polygons of a surface that VTK has read, triangles in place of strips. Throws a
/// Failure where a polygon has a vertex that does not exist, or a vertex no finite position.
vtkSmartPointer<vtkPolyData> JudgedPolygons(vtkPolyData* surface);

} // namespace Command

#endif
