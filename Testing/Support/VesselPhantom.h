/**
 * The vessel phantom and points on its axis.
 */
#ifndef FlipFreeVesselPhantom_h
#define FlipFreeVesselPhantom_h

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPhantomSource.h"

#include <array>
#include <cmath>

namespace FlipFree
{

/// A tube of 4 mm radius in 64 x 64 x 64 voxels of 1.5 mm; the truth is the second output.
inline void MakeVesselPhantom(vtkPhantomSource* phantom)
{
  phantom->SetShapeToVessel();
  phantom->SetDimensions(64, 64, 64);
  phantom->SetSpacing(1.5, 1.5, 1.5);
  phantom->Update();
}

/// On the axis of the tube, which ends at places -1 and 1.
inline std::array<double, 3> PointOfVessel(vtkPhantomSource* phantom, double place)
{
  const double pi = 3.14159265358979324;
  double center[3];
  phantom->GetOutput()->GetCenter(center);
  return { { center[0] + 36 * place, center[1] + 16 * std::sin(pi * place),
    center[2] + 10 * std::cos(0.8 * pi * place + 0.5) } };
}

} // namespace FlipFree

#endif
