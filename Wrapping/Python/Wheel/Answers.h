/**
 * What segmentations of organs and of vessels have in common on their way to Python.
 */
#ifndef FlipFreeAnswers_h
#define FlipFreeAnswers_h

#include "Numpy.h"

#include "Deformation/VolumeSegmentation.h"
#include "Mesh/SurfaceVoxelization.h"

#include <vector>

namespace FlipFree
{

/// How messages call the volume; Python leaves out the port.
inline const char* const ImageName = "the image on port 0";

/// The volume as runs read it; numpy's array outlives them.
GrayVolume GrayVolumeOf(const Voxels& voxels, const ImageGeometry& geometry);

/// A surface: points, corners, offsets, displacements, correspondence.
nb::dict SurfaceDict(FaceList faces, PointList points, CorrespondenceField field);

/// The columns of the convergence table by their names.
nb::dict ColumnsOf(const std::vector<IterationRecord>& records);

/// The label map: an array [k, j, i].
nb::object LabelsOf(const std::vector<VoxelRun>& runs, int label, const ImageGeometry& geometry);
/// The same of several organs, with consecutive labels.
nb::object LabelsOf(const std::vector<std::vector<VoxelRun>>& organs, int first,
  const ImageGeometry& geometry);

} // namespace FlipFree

#endif
