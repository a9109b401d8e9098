// Segments of 3D Slicer's files: names, values and layers, and which of them is meant.
#include "Exchange/SegmentationLayers.h"

#include "Exchange/FileProblem.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

const std::string File = "a.seg.nrrd";

/// As Slicer 5 writes them; "tumor" overlaps "Liver".
std::map<std::string, std::string> Pairs()
{
  return { { "Segmentation_MasterRepresentation", "Binary labelmap" }, { "Segment0_Name", "Liver" },
    { "Segment0_LabelValue", "1" }, { "Segment0_Layer", "0" },
    { "Segment0_Color", "1 0.823529 0.290196" }, { "Segment1_Name", "left kidney" },
    { "Segment1_LabelValue", "2" }, { "Segment1_Layer", "0" }, { "Segment10_Name", "tumor" },
    { "Segment10_LabelValue", "1" }, { "Segment10_Layer", "1" }, { "Segment2_Name", "Spleen" },
    { "Segment2_LabelValue", "6" }, { "Segment2_Layer", "1" }, { "Segment2_Color", "red" } };
}

LabelChoice ChoiceOf(const std::string& choice, int layers = 2)
{
  return ChooseLabel(SegmentsOf(Pairs(), File), layers, choice, File);
}

template <typename Work>
std::string ProblemOf(const Work& work)
{
  try
  {
    work();
  }
  catch (const FileProblem& problem)
  {
    return problem.what();
  }
  return {};
}

std::string ProblemOfChoice(const std::string& choice, int layers = 2)
{
  return ProblemOf([&] { ChoiceOf(choice, layers); });
}

} // namespace

TEST(SegmentationLayers, AreReadFromTheHeader)
{
  const std::vector<Segment> segments = SegmentsOf(Pairs(), File);
  ASSERT_EQ(segments.size(), 4U);
  EXPECT_EQ(segments[0].Name, "Liver");
  EXPECT_EQ(segments[0].Color, "#ffd24a");
  EXPECT_EQ(segments[2].Name, "Spleen"); // 2 before 10
  EXPECT_EQ(segments[2].Color, "");
  EXPECT_EQ(segments[2].Label, 6);
  EXPECT_EQ(segments[3].Name, "tumor");
  EXPECT_EQ(segments[3].Layer, 1);
  EXPECT_TRUE(SegmentsOf({ { "Segmentation_X", "1" }, { "Segmented_Name", "a" } }, File).empty());
  // Before Slicer 4.11: a layer for each.
  const std::vector<Segment> old =
    SegmentsOf({ { "Segment0_Name", "a" }, { "Segment1_Name", "b" } }, File);
  EXPECT_EQ(old[1].Label, 1);
  EXPECT_EQ(old[1].Layer, 1);
  EXPECT_EQ(ProblemOf(
              [] {
                SegmentsOf({ { "Segment0_LabelValue", "-1" }, { "Segment0_Name", "" } }, File);
              }),
    "The field Segment0_LabelValue of 'a.seg.nrrd' is '-1', not a whole number from 0 on. Save the "
    "segmentation again.");
}

TEST(SegmentationLayers, AreChosenByNameOrValue)
{
  for (const std::string name : { "Liver", "liver", "LIVER" })
  {
    EXPECT_EQ(ChoiceOf(name).Layer, 0);
    EXPECT_EQ(ChoiceOf(name).Label, 1);
  }
  EXPECT_EQ(ChoiceOf("Tumor").Layer, 1);
  EXPECT_EQ(ChoiceOf("Tumor").Label, 1);
  EXPECT_EQ(ChoiceOf("6").Layer, 1); // the only one with that value
  EXPECT_EQ(ChoiceOf("6").Label, 6);
  // A file of one label map.
  EXPECT_EQ(ChooseLabel({}, 1, "", File).Label, std::nullopt);
  EXPECT_EQ(ChooseLabel({}, 1, "7", File).Label, 7);
  EXPECT_EQ(ChooseLabel({ { "a", "", 2, 0 } }, 1, "0", File).Label, 0);
  // A name before a value, an exact name before another one.
  EXPECT_EQ(ChooseLabel({ { "2", "", 5, 0 }, { "b", "", 2, 0 } }, 1, "2", File).Label, 5);
  EXPECT_EQ(ChooseLabel({ { "A", "", 5, 0 }, { "a", "", 2, 0 } }, 1, "a", File).Label, 2);
}

TEST(SegmentationLayers, ThatAreNotClearAreRefused)
{
  EXPECT_EQ(ProblemOfChoice("livr"),
    "'a.seg.nrrd' has no segment 'livr'. Did you mean 'Liver'? There are 'Liver', 'left kidney', "
    "'Spleen', 'tumor'.");
  EXPECT_EQ(ProblemOfChoice("1"),
    "'a.seg.nrrd' has 2 segments called '1': 'Liver', 'tumor'. Choose one by its exact name, or "
    "rename them.");
  EXPECT_EQ(ProblemOfChoice(""),
    "'a.seg.nrrd' has 2 layers of segments that may overlap: 'Liver', 'left kidney', 'Spleen', "
    "'tumor'. Choose one segment by its name.");
  EXPECT_NE(ProblemOfChoice("7").find("None has the value 7."), std::string::npos);
  EXPECT_NE(ProblemOfChoice("-1").find("has no segment '-1'"), std::string::npos);
  EXPECT_NE(ProblemOfChoice("99999999999").find("has no segment"), std::string::npos);
  EXPECT_NE(ProblemOfChoice("tumor", 1).find("says that the segment 'tumor' is in layer 1"),
    std::string::npos);
  EXPECT_EQ(ProblemOf([] { ChooseLabel({}, 1, "liver", "a.nii"); }),
    "'a.nii' names no segments, so there is no 'liver'. Give the label's value.");
}

TEST(SegmentationLayers, AreCopiedHoweverTheyAreStored)
{
  const std::vector<short> byVoxel{ 1, 10, 100, 2, 20, 200 };
  const std::vector<short> byLayer{ 1, 2, 10, 20, 100, 200 };
  for (int layer = 0; layer < 3; ++layer)
  {
    std::vector<short> one(2);
    std::vector<short> other(2);
    CopyLayer(byVoxel.data(), 2, sizeof(short), { 3, true }, layer, one.data());
    CopyLayer(byLayer.data(), 2, sizeof(short), { 3, false }, layer, other.data());
    EXPECT_EQ(one, other);
    EXPECT_EQ(one[1], 2 * one[0]);
  }
}
