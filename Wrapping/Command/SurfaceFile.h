/**
 * Reads and writes surfaces; the ending of a file's name tells its format. Coordinates are LPS
 * millimeters in every format.
 */
#ifndef FlipFreeCommandSurfaceFile_h
#define FlipFreeCommandSurfaceFile_h

#include "FileFormats.h"
#include "SessionRecord.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;

namespace Command
{

vtkSmartPointer<vtkPolyData> ReadSurface(const std::string& name);

/// Writes a surface and reads it back, because VTK's writers do not report every failure. STL and
/// PLY get triangles: what STL holds, and what most programs can read of PLY; .vtp and .obj keep
/// the faces. If the surface is certified (field data `Certified`), what is read back must be
/// valid, too: its positions may have been rounded. Where it comes from (field data `Provenance`)
/// is in .vtp as field data, with the names, and in .ply and .obj as comments, without: the same
/// surface is the same bytes, whatever it is called.
void WriteSurface(const std::string& name, vtkPolyData* surface, const OriginNames& names = {});

/// Writes poly lines with their arrays as .vtp, and reads them back.
void WriteLines(const std::string& name, vtkPolyData* lines);

} // namespace Command

#endif
