#include "vtkVesselAlgorithm.h"

#include "PipelineAdapter.h"
#include "StageProperties.h"
#include "Vessel/VesselParameters.h"
#include "VesselOutputs.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

#define FLIPFREE_STAGE vtkVesselAlgorithm

#define PROPERTIES(P) FLIPFREE_VESSEL_PATH_PARAMETERS(P, Settings->)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

vtkVesselAlgorithm::vtkVesselAlgorithm()
  : Points(std::make_unique<FlipFree::VesselPoints>())
  , Settings(std::make_unique<FlipFree::VesselSegmentationSettings>())
{
}

vtkVesselAlgorithm::~vtkVesselAlgorithm() = default;

void vtkVesselAlgorithm::AddPoint(double x, double y, double z)
{
  this->Points->All.emplace_back(x, y, z);
  this->Modified();
}

void vtkVesselAlgorithm::RemoveAllPoints()
{
  if (!this->Points->All.empty())
  {
    this->Points->All.clear();
    this->Modified();
  }
}

int vtkVesselAlgorithm::GetNumberOfPoints() const
{
  return static_cast<int>(this->Points->All.size());
}

void vtkVesselAlgorithm::GetPoint(int index, double point[3]) const
{
  Eigen::Map<Eigen::Vector3d> to(point);
  if (index >= 0 && index < this->GetNumberOfPoints())
  {
    to = this->Points->All[index];
  }
  else
  {
    to.setZero();
  }
}

void vtkVesselAlgorithm::RequireProperties() const
{
  FlipFree::RequireNumbers({ PROPERTIES(FLIPFREE_NAME_PROPERTY) });
}

int vtkVesselAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkVesselAlgorithm::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector*)
{
  FlipFree::RequestWholeExtent(inputs[0]->GetInformationObject(0));
  return 1;
}

void vtkVesselAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const Eigen::Vector3d& point : this->Points->All)
  {
    os << indent << "Point: (" << point[0] << ", " << point[1] << ", " << point[2] << ")\n";
  }
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
}

#undef FLIPFREE_STAGE
#undef PROPERTIES
