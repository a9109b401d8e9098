/**
 * Private to the module: the parameters of vtkFlipFreeSegmentation, given in seed radii and voxels,
 * as the lengths in millimeters that the kernels take. The stages chained by hand get the same
 * ones.
 */
#ifndef FlipFreeSegmentationParameters_h
#define FlipFreeSegmentationParameters_h

#include "Deformation/OrganSegmentation.h"
#include "Image/AnisotropicDiffusion.h"

class vtkFlipFreeSegmentation;

namespace FlipFree
{

/// Throws std::invalid_argument, naming the first parameter that is NaN.
void RequireParameters(vtkFlipFreeSegmentation* filter);

/// How many levels there are.
int LevelsOf(vtkFlipFreeSegmentation* filter);

/// n of the first level.
int FirstResolution(vtkFlipFreeSegmentation* filter);

/// How far from the seed's center the surface may get, in millimeters.
double ReachOf(vtkFlipFreeSegmentation* filter);

/// Does a surface touch the end of the region where the image goes on?
bool ReachesEndOf(const ImageGeometry& region, const ImageGeometry& image, const PointList& points);

/// The fraction of the points that lie in the image's outermost voxels along any axis but the one
/// at whose ends lie most of them: what is thick along one axis alone, as a stack of few slices or
/// a slab that cuts an organ off above and below, is no sign that a surface has run away.
double FractionAtEndsOf(const ImageGeometry& image, const PointList& points);

/// Is a search line as long as by default, or longer?
bool SearchesFar(vtkFlipFreeSegmentation* filter);

AnisotropicDiffusionSettings DiffusionSettingsOf(vtkFlipFreeSegmentation* filter, double noise,
  const ImageGeometry& geometry);

OrganSegmentationSettings SettingsOf(vtkFlipFreeSegmentation* filter,
  const ImageGeometry& geometry);

} // namespace FlipFree

#endif
