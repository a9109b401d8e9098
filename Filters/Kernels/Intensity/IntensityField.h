/**
 * How an organ's gray values drift across it: a polynomial of second order, fitted robustly to the
 * voxels well inside the organ. A coil's field multiplies (MR); shading and contrast medium add
 * (CT). Flattened by its field, an organ has one gray value everywhere. After C. Brechbuehler,
 * G. Gerig, G. Szekely: Compensation of spatial inhomogeneity in MRI based on a parametric bias
 * estimate, 1996; priors on the coefficients keep it calm where little of the organ is seen.
 */
#ifndef FlipFreeIntensityField_h
#define FlipFreeIntensityField_h

#include "Image/BitMask.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"

#include <optional>

namespace FlipFree
{

class IntensityField
{
public:
  /// Fits the field to the voxels of `core`, a mask on the grid of the image that holds part of the
  /// seed. The modality is not Automatic. None if there are too few voxels to fit.
  static std::optional<IntensityField> Fit(const ImageView<float>& image, const BitMask& core,
    const SeedSphere& seed, Modality modality);

  /// The gray value that the organ has at a point, in millimeters.
  double At(const Eigen::Vector3d& point) const;

  /// Gives all voxels of the image the value that they would have without the drift from the seed.
  /// `voxels` are those of a grid of the same kind. The change is limited: to factors of 0.4 to 2.5
  /// in MR, and to 60 Hounsfield units in CT.
  void Flatten(const ImageGeometry& geometry, const ParallelFor& parallelFor, float* voxels) const;

private:
  using Coefficients = Eigen::Matrix<double, 10, 1>;

  Coefficients BasisAt(const Eigen::Vector3d& point) const;
  void Solve(const std::vector<Eigen::Vector3d>& points, const std::vector<float>& values,
    double independent);
  float Flat(float value, double field) const;

  Eigen::Vector3d Center = Eigen::Vector3d::Zero();
  double AtSeed = 0;
  bool Multiplies = false;
  Coefficients Drift = Coefficients::Zero();
};

} // namespace FlipFree

#endif
