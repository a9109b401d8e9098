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

  /// The maximum density, by which g is divided to give a feature in [0, 1].
  double Mode() const;

  /// The feature value above which the given mass of the mixture lies (the highest-density region).
  double ThresholdForMass(double mass) const;
};

struct MixtureSettings
{
  /// Maximum number of components; the Bayesian information criterion chooses.
  int MaximumComponents = 3;

  /// Neighboring voxels are correlated: this many of them count as one observation.
  double Correlation = 27;

  /// Minimum standard deviation of a component, without which integer intensities would collapse.
  /// The unit is the typical step of the gray values or, if larger, a 64th of their spread (2nd to
  /// 98th percentile); if all values are the same, a hundredth of their magnitude.
  double MinimumStandardDeviation = 1;

  /// Components of less weight (vessels, noise) are dropped. The heaviest always stays.
  double MinimumWeight = 0.15;
};

/// Fits the mixture to finite values. Throws an Error when there are none.
GaussianMixture FitGaussianMixture(const std::vector<float>& values,
  const MixtureSettings& settings);

} // namespace FlipFree

#endif
