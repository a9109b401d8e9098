#include "vtkVesselPath.h"

#include "ExecutionAdapter.h"
#include "FilterReport.h"
#include "GrayImageAdapter.h"
#include "VesselOutputs.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <exception>
#include <string>

vtkStandardNewMacro(vtkVesselPath);

int vtkVesselPath::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  output->Initialize();
  try
  {
    this->RequireProperties();
    vtkImageData* image = vtkImageData::GetData(inputs[0]);
    const std::string name = "the image{ on port 0}";
    FlipFree::RequireGrayImage(image, name);
    const FlipFree::VesselTree tree = FlipFree::TraceVessel(FlipFree::GrayVolumeOf(image, name),
      name, this->Points->List(), FlipFree::PointList(0, 3), this->Settings->Path,
      FlipFree::SMPThreading(), FlipFree::MonitorOf(this));
    if (!tree.Branches.empty())
    {
      FlipFree::FillCenterline(tree, output);
    }
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("No path: ", error, ".");
    return 0;
  }
  return 1;
}
