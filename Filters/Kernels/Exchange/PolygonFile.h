/**
 * Surfaces in PLY, STL and OBJ files: points and polygons, nothing else, whatever else is there.
 * Counts and indices are checked before they are used. Positions are LPS millimeters, or RAS where
 * a comment says so as 3D Slicer does.
 */
#ifndef FlipFreePolygonFile_h
#define FlipFreePolygonFile_h

#include "Exchange/CheckedPolygons.h"

#include <string>

namespace FlipFree
{

/// The surface in the bytes of a file of this name. Throws FileProblem.
CheckedPolygons ReadPolygonFile(const std::string& name, const std::string& bytes);

/// What damage of a file of a surface is called.
std::string DamagedSurface(const std::string& name, const std::string& fault);

// By format; what they refuse is a part of the message.

CheckedPolygons ReadPly(const std::string& bytes);
CheckedPolygons ReadObj(const std::string& bytes);

/// Corners in the same place become one vertex.
CheckedPolygons ReadStl(const std::string& bytes);

} // namespace FlipFree

#endif
