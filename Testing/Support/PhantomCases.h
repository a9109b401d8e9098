/**
 * Phantoms and the segmentations of them that tests share: where they start, and the parameters
 * that suit them.
 */
#ifndef FlipFreePhantomCases_h
#define FlipFreePhantomCases_h

#include "vtkCorrespondenceSearch.h"
#include "vtkFlipFreeDeform.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkGMMFeatureFilter.h"
#include "vtkPhantomSource.h"

#include "vtkSmartPointer.h"

#include <stdexcept>
#include <string>

namespace FlipFree
{

/// The abdomen in large voxels, made once for all tests of a process, and without partial volume,
/// which under sanitizers would take longer than the tests themselves.
inline vtkPhantomSource* CoarseAbdomen()
{
  static const auto abdomen = []
  {
    auto phantom = vtkSmartPointer<vtkPhantomSource>::New();
    phantom->SetShapeToAbdomen();
    phantom->SetDimensions(110, 85, 45);
    phantom->SetSpacing(3, 3, 6);
    phantom->PartialVolumeOff();
    phantom->Update();
    return phantom;
  }();
  return abdomen;
}

/// Starts from the phantom's own seed in an object.
inline void StartInside(vtkFlipFreeSegmentation* filter, vtkPhantomSource* phantom, int label)
{
  double seed[4];
  if (!phantom->GetSeed(label, seed))
  {
    throw std::invalid_argument("no seed for label " + std::to_string(label));
  }
  filter->SetInputConnection(phantom->GetOutputPort());
  filter->SetSeedCenter(seed);
  filter->SetSeedRadius(seed[3]);
}

/// Starts from a sphere that encloses the object, as in Fig. 1 of the paper; the intensities are
/// still those of a seed inside. Search lines must be long enough to reach the object, and as the
/// surface does not hold the object alone until the end, intensities are not fitted again.
inline void StartOutside(vtkFlipFreeSegmentation* filter, vtkPhantomSource* phantom)
{
  StartInside(filter, phantom, vtkPhantomSource::OBJECT);
  double seed[4];
  double sphere[4];
  phantom->GetSeed(vtkPhantomSource::OBJECT, seed);
  if (!phantom->GetEnclosingSphere(sphere))
  {
    throw std::invalid_argument("no enclosing sphere");
  }
  filter->SetStartCenterOffset(sphere[0] - seed[0], sphere[1] - seed[1], sphere[2] - seed[2]);
  filter->SetStartScale(sphere[3] / seed[3]);
  filter->SetSearchDistance(2 * sphere[3]);
  filter->GetFeature()->ReestimateIntensitiesOff();
  filter->LeakControlOff();
  filter->SetMaximumIterations(100);
}

/// The liver of the abdomen from its seed, with the default parameters.
inline void SegmentLiver(vtkFlipFreeSegmentation* filter, vtkPhantomSource* phantom)
{
  phantom->SetShapeToAbdomen();
  StartInside(filter, phantom, vtkPhantomSource::LIVER);
}

/// As in the gallery: with four levels, the cells are less even, and the Dice score is no better.
inline void SegmentCup(vtkFlipFreeSegmentation* filter, vtkPhantomSource* phantom)
{
  phantom->SetShapeToCup();
  StartOutside(filter, phantom);
  filter->SetLevels(3);
}

/// A surface too coarse to hang a web between the legs, with steps that are long enough to reach
/// the bottom first, and smoothed so that it does not fold there. The web's two sheets would lie on
/// each other for good: no vertex of them sees the object.
inline void SegmentUTube(vtkFlipFreeSegmentation* filter, vtkPhantomSource* phantom)
{
  phantom->SetShapeToUTube();
  StartOutside(filter, phantom);
  filter->SetLevels(4);
  filter->SetDiffusionIterations(0);
  filter->GetSearch()->SetMaximumDisplacement(0);
  filter->GetDeform()->SetUniformWeight(0.1);
  filter->GetDeform()->SetFairing(1);
}

/// Grows along a tube: vertices must be free to spread unevenly, and targets at the surface's ends
/// are unlike all others.
inline void SegmentVessel(vtkFlipFreeSegmentation* filter, vtkPhantomSource* phantom)
{
  phantom->SetShapeToVessel();
  StartInside(filter, phantom, vtkPhantomSource::OBJECT);
  filter->GetFeature()->ReestimateIntensitiesOff();
  filter->GetFeature()->CarvingOff();
  filter->LeakControlOff();
  filter->SetMaximumIterations(150);
  filter->SetDiffusionIterations(0);
  filter->SetResolution(64);
  filter->SetLevels(5);
  filter->GetSearch()->SetMaximumDisplacement(0);
  filter->GetSearch()->SetOutlierStandardDeviations(0);
  filter->GetDeform()->SetPositionWeight(1);
  filter->GetDeform()->SetUniformWeight(0.01);
  filter->GetDeform()->SetFairing(0.2);
}

/// The paper's Fig. 3b: targets are taken as they are found.
inline void MakeNaive(vtkFlipFreeSegmentation* filter)
{
  const double reach = filter->GetSearchDistance();
  filter->UseNaiveParameters();
  filter->SetSearchDistance(reach);
  filter->GetSearch()->SearchInwardOn();
}

} // namespace FlipFree

#endif
