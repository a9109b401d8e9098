// Where surfaces come from, as the filters' field data say it.
#include "BadInput.h"

#include "vtkFieldData.h"
#include "vtkFlipFreeOrganGroup.h"
#include "vtkFlipFreeSegmentation.h"
#include "vtkStringArray.h"

#include <string>

using namespace FlipFree;

namespace
{

std::string TextOfField(vtkDataObject* data, const char* name, vtkIdType index = 0)
{
  auto* const array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return array && index < array->GetNumberOfValues() ? array->GetValue(index) : std::string();
}

void ExpectInText(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

/// Two bright balls in voxels of 2 mm.
vtkSmartPointer<vtkImageData> TwoBalls()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(48, 32, 32);
  image->SetSpacing(2, 2, 2);
  image->AllocateScalars(VTK_SHORT, 1);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    const Eigen::Vector3d point(image->GetPoint(voxel));
    const bool inside = (point - Eigen::Vector3d(26, 30, 30)).norm() < 16 ||
      (point - Eigen::Vector3d(66, 30, 30)).norm() < 16;
    image->GetPointData()->GetScalars()->SetTuple1(voxel, inside ? 100 : 0);
  }
  return image;
}

} // namespace

TEST(ProvenanceField, IsOfTheSeedPointsAndParametersOfTheRun)
{
  vtkNew<vtkFlipFreeSegmentation> filter;
  filter->SetInputData(TwoBalls());
  filter->SetSeedCenter(26, 30, 30);
  filter->SetSeedRadius(4);
  filter->AddSeed(26, 32, 30, 8);
  filter->AddInsidePoint(26, 30, 44.25);
  filter->SetResolution(8);
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  std::string text = TextOfField(filter->GetSurface(), "Provenance");
  ExpectInText(text, "\"seed\":{\"center\":[26,32,30],\"radius\":8}"); // the largest
  ExpectInText(text,
    "\"corrections\":[{\"kind\":\"inside\",\"position\":[26,30,44.25]},"
    "{\"kind\":\"seed\",\"position\":[26,30,30],\"radius\":4}]");
  ExpectInText(text, "\"size\":[48,32,32],\"spacing\":[2,2,2]");
  ExpectInText(text, "\"resolution\":8,");
  // Those of the last run: points are taken back, though much is kept between runs.
  filter->SetKeepForCorrections(true);
  filter->Update();
  filter->RemoveLastCorrection();
  ASSERT_EQ(ErrorOfUpdate(filter), "0 errors");
  text = TextOfField(filter->GetSurface(), "Provenance");
  EXPECT_EQ(text.find("inside"), std::string::npos);
  // Another start, which the text does not hold, is named.
  vtkNew<vtkPolyData> start;
  start->DeepCopy(filter->GetSurface());
  vtkNew<vtkFlipFreeSegmentation> other;
  other->SetInputData(TwoBalls());
  other->SetStartData(start);
  other->SetSeedCenter(26, 30, 30);
  other->SetSeedRadius(8);
  ASSERT_EQ(ErrorOfUpdate(other), "0 errors");
  ExpectInText(TextOfField(other->GetSurface(), "Provenance"), "\"startSurface\":true");
}

TEST(ProvenanceField, OfSeveralOrgansNamesThemInSurfacesAndLabelMap)
{
  vtkNew<vtkFlipFreeOrganGroup> group;
  group->SetInputData(TwoBalls());
  group->AddOrgan("left", 26, 30, 30, 8);
  group->AddOrgan("right", 66, 30, 30, 8);
  group->GetParameters()->SetResolution(8);
  group->SetLabelValue(4);
  ASSERT_EQ(ErrorOfUpdate(group), "0 errors");
  const std::string text = TextOfField(group->GetSurface(1), "Provenance");
  EXPECT_EQ(TextOfField(group->GetSurface(0), "Provenance"), text);
  ExpectInText(text, "\"together\":true");
  EXPECT_EQ(TextOfField(group->GetSurface(1), "Organ"), "right");
  vtkImageData* const labels = group->GetLabelMap();
  EXPECT_EQ(TextOfField(labels, "SegmentNames", 1), "right");
  EXPECT_NE(TextOfField(labels, "SegmentColors", 0), TextOfField(labels, "SegmentColors", 1));
  EXPECT_EQ(labels->GetFieldData()->GetArray("SegmentLabels")->GetComponent(1, 0), 5);
}
