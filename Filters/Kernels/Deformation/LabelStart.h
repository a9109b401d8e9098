/**
 * The surface with which a segmentation that fills a label begins: that of the label's voxels, of
 * any topology, so that the center of every voxel is on its side (LabelSurface/LabelSurfaces.h).
 *
 * Its triangles are left as they are. The deformation would need four neighbors at each vertex, but
 * the midpoint mesh that has them cuts corners off, which is up to a twentieth of thin labels; and
 * where a surface is at its voxels already, only points move it, which the guard does with any
 * closed mesh.
 */
#ifndef FlipFreeLabelStart_h
#define FlipFreeLabelStart_h

#include "Deformation/StartSurface.h"
#include "Image/BitMask.h"

namespace FlipFree
{

/// The exact surface of the mask, as a mesh at rest (BuildMeshAtRest), embedded. Without points if
/// the monitor stopped it. Throws Error where the mask is empty.
DeformableSurface SurfaceOfMask(const BitMask& mask, const ParallelFor& parallelFor,
  const Monitor& monitor);

} // namespace FlipFree

#endif
