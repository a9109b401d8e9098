/**
 * What runs answer: surfaces, label maps and convergence tables as numpy's arrays.
 */
#ifndef FlipFreeWheelAnswers_h
#define FlipFreeWheelAnswers_h

#include "Numpy.h"

#include "Deformation/VolumeSegmentation.h"

namespace FlipFree
{

/// How messages call the volume.
constexpr const char* ImageName = "the image on port 0";

/// Throws std::invalid_argument for a volume without voxels and for an improper grid.
void RequireVoxels(const ImageGeometry& geometry);

/// { points, corners, offsets, displacements, correspondence }.
nb::dict DictOf(FaceList faces, PointList points, CorrespondenceField field);

/// The convergence table.
nb::dict ColumnsOf(const std::vector<IterationRecord>& records);

/// The label map's voxels.
nb::object LabelsOf(const std::vector<VoxelRun>& runs, int label, const ImageGeometry& geometry);

} // namespace FlipFree

#endif
