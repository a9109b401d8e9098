/**
 * One organ's surface while it deforms, with the evidence of where the organ ends.
 */
#ifndef FlipFreeDeformingOrgan_h
#define FlipFreeDeformingOrgan_h

#include "Deformation/DeformingSurface.h"
#include "Evidence/ForegroundCorrection.h"
#include "Intensity/OrganForeground.h"

#include <vector>

namespace FlipFree
{

/// The foreground refers to the object's own seed and settings.
class DeformingOrgan : public DeformingSurface
{
public:
  /// The region and `parallelFor` must outlive the object. `noise` is the standard deviation before
  /// smoothing.
  DeformingOrgan(SmoothRegion& region, double noise, const SeedSphere& seed,
    const OrganSegmentationSettings& settings, const ParallelFor& parallelFor);

  // Functions that may take long return false if the monitor stopped them.

  bool FindForegroundOfSeed(const Monitor& monitor);
  /// Unless the foreground is settled: refits the intensities to the surface, finds the foreground
  /// anew by their threshold, and corrects it by the run's constraints.
  bool Refit(const Monitor& monitor) override;
  /// Makes the foreground by the surface and the image around it (CarvedForeground.h). It is then
  /// settled.
  bool CarveSurface(const Monitor& monitor);
  /// Corrects the foreground by constraints (ForegroundCorrection.h).
  bool CorrectForeground(const ConstraintList& constraints, const Monitor& monitor);
  /// Takes a foreground from elsewhere, which is settled: later levels keep it as it is.
  void SettleForeground(BitMask mask);
  OrganForeground& GetForeground() { return this->Foreground; }
  const OrganSegmentationSettings& GetSettings() const { return this->Settings; }

private:
  void BeginRun() override;
  CorrespondenceField SearchTargets(TargetReport& report) override;
  bool FindOthers(const CarvedForegroundInputs& inputs, const CarvedForeground& carved,
    const Monitor& monitor);
  ForegroundImage CorrectedImage(const Monitor& monitor);
  bool FindForegroundOfSurface(const Monitor& monitor);

  const double Noise;
  const SeedSphere Seed;
  const OrganSegmentationSettings Settings;
  OrganForeground Foreground;
  TissueGrowth NewTissue;
  IntensityModel OfSeed;
  IntensityModel Model;          // refitted
  double OrganRadius;            // the seed's, until more is known
  BitMask Candidate;             // of carving
  std::vector<OtherPart> Others; // about which other opinions disagree with what was carved
  bool Settled = false;
};

} // namespace FlipFree

#endif
