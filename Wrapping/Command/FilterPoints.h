/**
 * Gives filters the points that correct a segmentation.
 */
#ifndef FlipFreeCommandFilterPoints_h
#define FlipFreeCommandFilterPoints_h

#include "PointFile.h"

#include <vector>

class vtkFlipFreeSegmentation;
class vtkFlipFreeVesselSegmentation;

namespace Command
{

void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeSegmentation* filter);

/// None of them is a seed.
void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeVesselSegmentation* filter);

} // namespace Command

#endif
