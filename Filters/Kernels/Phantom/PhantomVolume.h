/**
 * Any of the phantoms as a volume, from a few settings.
 */
#ifndef FlipFreePhantomVolume_h
#define FlipFreePhantomVolume_h

#include "ParameterTable.h"
#include "Phantom/Phantom.h"

namespace FlipFree
{

struct PhantomSettings
{
  int Shape = 0;                                     ///< a PlainShape, or AbdomenShape
  std::array<int, 3> Dimensions{ { 0, 0, 0 } };      ///< zeros: as suits the shape
  Eigen::Vector3d Spacing = Eigen::Vector3d::Zero(); ///< millimeters; zeros: as suits the shape
  Eigen::Vector3d Origin = Eigen::Vector3d::Zero();
  RowMajorMatrix Direction = Eigen::Matrix3d::Identity();
  double Foreground = 100; ///< intensities of the plain shapes
  double Background = 0;
  double NoiseStandardDeviation = 12;
  double NoiseCorrelation = 0.3;
  int RandomSeed = 1;
  int NumberOfLesions = 0; ///< in the abdomen's liver
  bool PartialVolume = true;
};

constexpr int AbdomenShape = 5;

/// What the label of a seed stands for: an organ of the abdomen, or "object".
const char* NameOfPhantomLabel(int shape, int label);

const ParameterTable<PhantomSettings>& PhantomParameters();

/// Throws Error for settings that make no grid.
ImageGeometry GridOf(const PhantomSettings& settings);

/// Throws Error for intensities that do not fit into the voxels.
Phantom PhantomOf(const PhantomSettings& settings, const ImageGeometry& grid);

SamplingOptions SamplingOf(const PhantomSettings& settings);

} // namespace FlipFree

#endif
