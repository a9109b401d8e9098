/**
 * Files of polygons, which the kernels read, as surfaces of VTK. VTK's readers of these formats
 * trust the counts and indices in a file, and read or write beyond their arrays where it is
 * damaged.
 */
#ifndef FlipFreeCommandPolygons_h
#define FlipFreeCommandPolygons_h

#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;

namespace Command
{

/// Of a file of this name. Throws FlipFree::FileProblem, naming the file.
vtkSmartPointer<vtkPolyData> ReadPolygons(const std::string& name, const std::string& bytes);

/// Points and polygons of a surface that VTK has read, triangles in place of strips. Throws
/// FlipFree::FileProblem of what is wrong in it, a part of a message, where a polygon has a vertex
/// that does not exist, or a vertex no finite position.
vtkSmartPointer<vtkPolyData> JudgedPolygons(vtkPolyData* surface);

} // namespace Command

#endif
