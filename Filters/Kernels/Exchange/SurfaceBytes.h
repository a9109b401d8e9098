/**
 * Surfaces as the bytes of STL, PLY and OBJ files, which PolygonFile.h reads. Positions are LPS
 * millimeters, of single precision in STL and PLY and with all digits in OBJ. Comments come before
 * the data; STL has room for the first one.
 */
#ifndef FlipFreeSurfaceBytes_h
#define FlipFreeSurfaceBytes_h

#include "KernelTypes.h"

#include <string>
#include <vector>

namespace FlipFree
{

using PointView = Eigen::Ref<const PointList>;
using TriangleView = Eigen::Ref<const TriangleList>;

/// Binary, with the normals of the triangles.
std::string StlBytes(const PointView& points, const TriangleView& triangles,
  const std::vector<std::string>& comments);

/// Binary. Of triangles, since many programs read no other faces of PLY.
std::string PlyBytes(const PointView& points, const TriangleView& triangles,
  const std::vector<std::string>& comments);

/// Text.
std::string ObjBytes(const PointView& points, const FaceList& faces,
  const std::vector<std::string>& comments);

} // namespace FlipFree

#endif
