#include "vtkQuadTubeSource.h"

#include "ExecutionAdapter.h"
#include "FilterAdvice.h"
#include "FilterReport.h"
#include "MeshAdapter.h"
#include "Vessel/QuadTube.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <exception>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkQuadTubeSource);

namespace
{

struct Line
{
  FlipFree::PointList Points;
  Eigen::VectorXd Radii;
};

Line LineOf(vtkPolyData* lines, int index)
{
  if (index >= lines->GetNumberOfLines())
  {
    throw FlipFree::Error(FlipFree::ErrorCode::OutOfRange,
      "the lines{ on port 0} are " + std::to_string(lines->GetNumberOfLines()) +
        ", and {LineIndex} is " + std::to_string(index) + "; connect poly lines, or lower it");
  }
  vtkDataArray* radii = lines->GetPointData()->GetArray("Radius");
  if (!radii || radii->GetNumberOfComponents() != 1 ||
    radii->GetNumberOfTuples() != lines->GetNumberOfPoints())
  {
    throw FlipFree::Error(FlipFree::ErrorCode::InvalidInput,
      "the lines{ on port 0} have no point array 'Radius' with one number "
      "per point; add one, in millimeters");
  }
  vtkNew<vtkIdList> places;
  lines->GetLines()->GetCellAtId(index, places);
  Line line;
  line.Points.resize(places->GetNumberOfIds(), 3);
  line.Radii.resize(places->GetNumberOfIds());
  for (vtkIdType place = 0; place < places->GetNumberOfIds(); ++place)
  {
    lines->GetPoint(places->GetId(place), line.Points.row(place).data());
    line.Radii[place] = radii->GetTuple1(places->GetId(place));
  }
  return line;
}

} // namespace

int vtkQuadTubeSource::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  output->Initialize();
  try
  {
    const Line line = LineOf(vtkPolyData::GetData(inputs[0]), this->LineIndex);
    const FlipFree::QuadTube tube = FlipFree::WithAdvice(
      [&]
      {
        return FlipFree::MakeQuadTube(line.Points, line.Radii, this->Resolution,
          "the line{ on port 0}", FlipFree::SMPFor);
      });
    output->SetPoints(FlipFree::MakePoints(tube.Points));
    output->SetPolys(FlipFree::MakePolys(tube.Faces));
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("No tube: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkQuadTubeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "LineIndex: " << this->LineIndex << "\n";
}
