/**
 * From shapes to voxels: a stack of tissues, each filling a shape and hiding what lies below it, is
 * sampled into a gray volume with partial volume and noise, and into the label map that is its
 * exact truth.
 */
#ifndef FlipFreeShapeVolume_h
#define FlipFreeShapeVolume_h

#include "KernelTypes.h"
#include "Phantom/ImplicitShape.h"

#include <vector>

namespace FlipFree
{

struct Tissue
{
  double Intensity = 0;
  double Unevenness = 0; ///< standard deviation of the smooth random field added to Intensity
  std::uint8_t Label = 0;
};

struct TissueLayer
{
  ImplicitShape Shape;
  FlipFree::Tissue Tissue;
};

/// Shapes live in millimeters along the grid's own axes, with the grid's center as their origin:
/// they keep their place between the voxels whatever the direction matrix is, and turn with it.
struct TissueStack
{
  Tissue Background;
  std::vector<TissueLayer> Layers; ///< later layers hide earlier ones
  double FieldCell = 15;           ///< mm over which uneven tissue varies

  /// Where set, shapes are drawn in a space of their own, to which it takes a point of the grid. It
  /// must not stretch any length more than Stretch times.
  std::function<Eigen::Vector3d(const Eigen::Vector3d& point)> ToDrawing;
  double Stretch = 1;
};

struct SamplingOptions
{
  bool PartialVolume = true; ///< mean over sub-voxels, at most 4 along an axis; else the center's
  double NoiseStandardDeviation = 0; ///< of the Gaussian noise
  double NoiseCorrelation = 0;       ///< of neighbors in a slice, 0 to 0.7
  std::uint64_t Seed = 0;
};

/// Throws where dimensions, spacing or direction do not make a grid.
void RequireGrid(const ImageGeometry& geometry);

/// Lengths of the grid's box, half a voxel beyond the outermost centers, along its own axes.
Eigen::Vector3d GridExtent(const ImageGeometry& geometry);

/// From millimeters along the grid's axes around its center to physical millimeters.
Eigen::Vector3d GridToPhysical(const ImageGeometry& geometry, const Eigen::Vector3d& local);

/// Fills one intensity, rounded to the nearest integer, and one label per voxel. The label is that
/// of the topmost tissue at the voxel's center. False if the monitor stopped it.
bool SampleTissues(const TissueStack& stack, const ImageGeometry& geometry,
  const SamplingOptions& options, std::int16_t* intensities, std::uint8_t* labels,
  const ParallelFor& parallelFor = SerialFor, const Monitor& monitor = NeverStop);

} // namespace FlipFree

#endif
