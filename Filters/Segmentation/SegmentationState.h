/**
 * Private to the module: what constraints do not change, kept from one run to the next while the
 * inputs stay the same.
 */
#ifndef FlipFreeSegmentationState_h
#define FlipFreeSegmentationState_h

#include "Deformation/SegmentationRequest.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;
class vtkPolyData;

namespace FlipFree
{

/// How messages call the image.
constexpr const char* InputImageName = "the image{ on port 0}";

/// The inputs that are not constraints, told apart by their modification times.
struct SegmentationInputs
{
  vtkImageData* Image = nullptr;
  vtkMTimeType ImageTime = 0;
  vtkPolyData* Start = nullptr;
  vtkMTimeType StartTime = 0;
  vtkImageData* Labels = nullptr;
  vtkMTimeType LabelsTime = 0;
  int Label = 0; ///< of Labels

  bool operator==(const SegmentationInputs& other) const;
};

struct SegmentationState
{
  /// Throws Error for a start surface or labels that cannot be used. The image has passed
  /// RequireGrayImage. Keeps its voxels alive, not the image.
  explicit SegmentationState(const SegmentationInputs& inputs);

  const SegmentationInputs Inputs;
  const vtkSmartPointer<vtkDataArray> Voxels;
  OrganSession Session;
  std::string Warning; ///< of the start labels; empty where there is nothing to say
};

} // namespace FlipFree

#endif
