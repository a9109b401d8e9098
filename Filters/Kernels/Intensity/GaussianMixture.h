/**
 * The intensity model of the foreground (paper section 3.2, Eq. 1): a mixture of Gaussians in one
 * dimension, fitted by expectation maximization on a histogram, so that the cost does not depend on
 * the number of voxels.
 */
#ifndef FlipFreeGaussianMixture_h
#define FlipFreeGaussianMixture_h

#include <vector>

namespace FlipFree
{

struct Gaussian
{
  double Weight = 1;
  double Mean = 0;
  double StandardDeviation = 1;
};

class GaussianMixture
{
public:
  std::vector<Gaussian> Components;

  /// g(z) of Eq. 1.
  double Density(double z) const;

  /// The greatest density, by which g is divided to give a feature in [0, 1].
  double Mode() const;

  /// The feature value above which the given mass of the mixture lies (the highest-density region).
  double ThresholdForMass(double mass) const;
};

struct MixtureSettings
{
  /// Greatest number of components; the Bayesian information criterion chooses.
  int MaximumComponents = 3;

  /// Neighboring voxels are correlated: that many of them count as one observation.
  double Correlation = 27;

  /// Least deviation of a component: integer intensities would collapse otherwise. In steps of the
  /// gray values, or in 64ths of their spread (2nd to 98th percentile) where that is more; of
  /// values that are all the same in hundredths of their magnitude.
  double MinimumStandardDeviation = 1;

  /// Components of less weight (vessels, noise) are dropped. The heaviest always stays.
  double MinimumWeight = 0.15;
};

/// Fits the mixture to finite values. Throws std::invalid_argument when there are none.
GaussianMixture FitGaussianMixture(const std::vector<float>& values,
  const MixtureSettings& settings);

} // namespace FlipFree

#endif
