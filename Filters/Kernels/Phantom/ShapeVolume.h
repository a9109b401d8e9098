/**
 * Samples a stack of tissues, each of which fills a shape and hides those below it, into an image
 * with partial volume and noise, and into the label map that is its exact ground truth.
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

/// Shapes are in millimeters along the grid's axes around its center: they turn with the direction
/// matrix, which does not change any voxel.
struct TissueStack
{
  Tissue Background;
  std::vector<TissueLayer> Layers; ///< later layers hide earlier ones
  double FieldCell = 15;           ///< mm over which uneven tissue varies

  /// Optional: maps a point of the grid to the space in which the shapes are drawn. Stretch is its
  /// Lipschitz constant.
  std::function<Eigen::Vector3d(const Eigen::Vector3d& point)> ToDrawing;
  double Stretch = 1;
};

struct SamplingOptions
{
  bool PartialVolume = true;         ///< mean of up to 4 sub-voxels per axis, or the center's
  double NoiseStandardDeviation = 0; ///< of the Gaussian noise
  double NoiseCorrelation = 0;       ///< of neighbors in a slice, 0 to 0.7
  std::uint64_t Seed = 0;
};

/// Throws Error, naming what is wrong, unless the geometry is a valid grid.
void RequireGrid(const ImageGeometry& geometry);

/// The size of the grid along its axes, including the outer halves of its boundary voxels.
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
