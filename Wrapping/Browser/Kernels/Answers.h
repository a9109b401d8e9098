/**
 * What runs answer: a surface, its voxels and the convergence table as objects of JavaScript.
 */
#ifndef FlipFreeAnswers_h
#define FlipFreeAnswers_h

#include "Bindings.h"
#include "Volume.h"

#include "Deformation/VolumeSegmentation.h"
#include "Image/LabelValues.h"

namespace FlipFree
{

/// How messages call the volume.
constexpr const char* ImageName = "the image";

/// The volume as runs read it; it outlives them.
GrayVolume GrayVolumeOf(const Volume& image);

/// The same of a label map, which messages call `name`.
LabelVolume LabelVolumeOf(const Volume& labels, const std::string& name);

/// Where a surface comes from, and whether it is proven to be embedded.
struct Origin
{
  std::string Provenance;
  bool IsCertified;
};

struct PolygonSurface
{
  PointList Points;
  FaceList Faces;
};

/// Of { points, corners, offsets }, which messages call `name`.
PolygonSurface SurfaceOf(const val& surface, const std::string& name);

/// The other way.
val SurfaceObject(const PointList& points, const FaceList& faces);

/// Four numbers each: j, k, first i, one past the last i.
val ArrayOf(const std::vector<VoxelRun>& runs);

/// { stopReason, aborted, selfIntersections, surface, certified, provenance, comments, runs,
/// iterations, warnings }.
val AnswerOf(const OrganSurface& organ, const Origin& origin, const std::vector<VoxelRun>& voxels,
  const std::vector<std::string>& warnings);

} // namespace FlipFree

#endif
