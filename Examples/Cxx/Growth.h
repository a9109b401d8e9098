/**
 * The method, composed from its stages, one iteration at a time: what vtkFlipFreeSegmentation does
 * inside, from coarse to fine, with everything in sight.
 */
#ifndef Growth_h
#define Growth_h

#include "Inputs.h"

#include <vtkCorrespondenceSearch.h>
#include <vtkFlipFreeDeform.h>
#include <vtkGMMFeatureFilter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSeedRegionDiffusion.h>
#include <vtkSmartPointer.h>

#include <vector>

class Growth
{
public:
  Growth(vtkImageData* image, const std::array<double, 3>& seed, double radius);

  /// One iteration; the first one of a level is preceded by what that level needs. False where a
  /// filter failed, which has told why.
  bool Step();

  /// Has the last level ended?
  bool HasConverged() const;

  /// After the last iteration. The object stays as it is when the surface goes on.
  vtkPolyData* GetSurface() const { return this->Surface; }
  int GetLevel() const { return this->Level; }

  double MeanDistance = 0;  // to the targets, mm
  int FlippingVertices = 0; // whose targets would have flipped an edge
  int GuardedVertices = 0;  // moved less, lest the surface intersect itself

private:
  bool IsLevelDone() const;
  bool NextLevel();

  vtkNew<vtkSeedRegionDiffusion> Smooth;
  vtkNew<vtkGMMFeatureFilter> Feature;
  vtkNew<vtkCorrespondenceSearch> Search;
  vtkNew<vtkFlipFreeDeform> Deform;
  vtkSmartPointer<vtkPolyData> Surface;
  vtkSmartPointer<vtkPolyData> Start;
  double Voxel;
  int Level = -1;
  std::vector<double> Distances; // of the iterations of this level
};

#endif
