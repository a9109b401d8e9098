// The text that says where a surface comes from.
#include "Deformation/Provenance.h"
#include "Deformation/SegmentationParameters.h"
#include "JsonText.h"
#include "TextWords.h"
#include "Vessel/VesselProvenance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

ImageGeometry GridOfProvenance()
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 4, 5, 6 } };
  geometry.Spacing = { 0.7, 0.7, 1.25 };
  geometry.Origin = { -100.1, 20, 1e-7 };
  geometry.Direction << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  return geometry;
}

void ExpectPart(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

} // namespace

TEST(JsonText, NumbersAreReadBackExactly)
{
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::uint64_t> bits;
  for (int run = 0; run < 2000; ++run)
  {
    const std::uint64_t pattern = bits(random);
    double number = 0;
    std::memcpy(&number, &pattern, sizeof(number));
    if (std::isfinite(number))
    {
      EXPECT_EQ(std::strtod(JsonOf(number).c_str(), nullptr), number);
    }
  }
  EXPECT_EQ(JsonOf(0.1), "0.1");
  EXPECT_EQ(JsonOf(3.0), "3");
  EXPECT_EQ(JsonOf(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(JsonOf(std::numeric_limits<double>::max()), "1.7976931348623157e+308");
}

TEST(JsonText, TextsAreQuoted)
{
  EXPECT_EQ(JsonOf(std::string("a \"b\" \\ \n")), "\"a \\\"b\\\" \\\\ \\u000a\"");
}

TEST(Provenance, SaysAllThatRepeatsASurface)
{
  OrganProvenance organ;
  organ.Seed = { { 1, -2.5, 0.1 }, 26 };
  organ.Constraints = { { ConstraintKind::Seed, { 7, 8, 9 }, 4.5 },
    { ConstraintKind::Boundary, { 1, 2, 3 }, 0 }, { ConstraintKind::Outside, { 4, 5, 6 }, 0 } };
  VolumeSegmentationSettings settings;
  settings.Method.Schedule.Resolution = 17;
  settings.Method.Feature.Carving = false;
  settings.StartCenterOffset = { 0, 0.25, 0 };
  const std::string text = ProvenanceOf(organ, settings, GridOfProvenance());
  EXPECT_EQ(text.find("{\"format\":\"flipfree-session\",\"version\":2,\"flipfree\":\""), 0U);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  ExpectPart(text,
    "\"image\":{\"name\":\"\",\"size\":[4,5,6],\"spacing\":[0.7,0.7,1.25],"
    "\"origin\":[-100.1,20,1e-07],\"direction\":[0,1,0,1,0,0,0,0,-1]}");
  ExpectPart(text, "\"seed\":{\"center\":[1,-2.5,0.1],\"radius\":26}");
  ExpectPart(text,
    "\"corrections\":[{\"kind\":\"outside\",\"position\":[4,5,6]},"
    "{\"kind\":\"boundary\",\"position\":[1,2,3]},"
    "{\"kind\":\"seed\",\"position\":[7,8,9],\"radius\":4.5}]");
  ExpectPart(text, "\"resolution\":17,");
  ExpectPart(text, "\"carving\":false,");
  ExpectPart(text, "\"startCenterOffset\":[0,0.25,0]");
  // Those that have their defaults, too.
  for (const auto& parameter : SegmentationParameters())
  {
    const bool changes = parameter.Name != "LabelValue" && parameter.Name != "KeepHistory";
    const std::string name = WithSmallFirst(parameter.Name);
    EXPECT_EQ(text.find("\"" + name + "\":") != std::string::npos, changes) << name;
  }
  // The order of the constraints means nothing, nor does one that is there twice.
  std::swap(organ.Constraints[0], organ.Constraints[2]);
  organ.Constraints.push_back(organ.Constraints[1]);
  EXPECT_EQ(ProvenanceOf(organ, settings, GridOfProvenance()), text);
  settings.LabelValue = 7;
  EXPECT_EQ(ProvenanceOf(organ, settings, GridOfProvenance()), text);
}

TEST(Provenance, PresetsAreInTheParameters)
{
  // Whatever a preset sets is a parameter: from the defaults and these, the text is the same.
  for (const OrganSegmentationSettings& method : { PublishedSettings(), NaiveSettings() })
  {
    VolumeSegmentationSettings preset;
    preset.Method = method;
    VolumeSegmentationSettings repeated;
    for (const auto& parameter : SegmentationParameters())
    {
      parameter.Set(repeated, parameter.Get(preset));
    }
    EXPECT_EQ(ProvenanceOf(OrganProvenance(), repeated, {}),
      ProvenanceOf(OrganProvenance(), preset, {}));
    EXPECT_NE(ProvenanceOf(OrganProvenance(), preset, {}), ProvenanceOf(OrganProvenance(), {}, {}));
  }
}

TEST(Provenance, SaysWhatTheSeedWasReplacedBy)
{
  OrganProvenance organ;
  organ.StartLabel = 6;
  ExpectPart(ProvenanceOf(organ, {}, GridOfProvenance()),
    "\"seed\":null,\"startLabels\":{\"name\":\"\",\"label\":6}");
  organ.StartLabel = -1;
  organ.HasStartSurface = true;
  ExpectPart(ProvenanceOf(organ, {}, GridOfProvenance()), "\"startSurface\":true");
}

TEST(Provenance, OfSeveralOrgansIsOne)
{
  std::vector<OrganProvenance> organs(2);
  organs[0].Name = "liver \"left\"";
  organs[1].Name = "spleen";
  const std::string text = ProvenanceOf(organs, 1, {}, GridOfProvenance());
  ExpectPart(text, "\"name\":\"liver \\\"left\\\"\"");
  ExpectPart(text, "\"name\":\"spleen\"");
  ExpectPart(text, "\"together\":true,\"fixed\":[\"\"]}");
  EXPECT_NE(DefaultColor(0), DefaultColor(1));
}

TEST(Provenance, FilesHoldItInComments)
{
  EXPECT_EQ(CommentsOn("").size(), 1U);
  ExpectPart(CommentsOn("").front(), ", millimeters, SPACE=LPS");
  std::vector<OrganProvenance> organs(1);
  organs[0].Name =
    R"(a "quoted", very long name with, commas, \ and spaces, )" + std::string(90, ',');
  const std::string text = ProvenanceOf(organs, 0, {}, GridOfProvenance());
  const std::vector<std::string> comments = CommentsOn(text);
  EXPECT_EQ(comments.front(), CommentsOn("").front());
  ASSERT_GT(comments.size(), 10U);
  const std::string word = "provenance ";
  std::string together;
  for (auto comment = comments.begin() + 1; comment != comments.end(); ++comment)
  {
    EXPECT_EQ(comment->compare(0, word.size(), word), 0) << *comment;
    EXPECT_LT(comment->size(), 350U);
    EXPECT_NE(comment->back(), ' ');
    together += comment->substr(word.size());
  }
  EXPECT_EQ(together, text);
}

TEST(Provenance, OfAVesselKeepsItsPointsInOrder)
{
  PointList points(2, 3);
  points << 4, 5, 6, 1, 2, 3;
  VesselSegmentationSettings settings;
  settings.Path.WallThickness = 0.5;
  const std::string text =
    ProvenanceOf(points, { { ConstraintKind::Outside, { 1, 1, 1 }, 0 } }, settings, {});
  ExpectPart(text, "\"kind\":\"vessel\"");
  ExpectPart(text, "\"points\":[[4,5,6],[1,2,3]]");
  ExpectPart(text, "\"wallThickness\":0.5");
  ExpectPart(text, "\"modality\":0");
  ExpectPart(text, "\"corrections\":[{\"kind\":\"outside\",\"position\":[1,1,1]}]");
}
