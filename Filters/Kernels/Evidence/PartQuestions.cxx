#include "Evidence/PartQuestions.h"

#include "Image/VoxelBox.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

bool IsAnswered(const DoubtfulPart& part, const ConstraintList& constraints)
{
  return std::any_of(constraints.begin(), constraints.end(),
    [&part](const PointConstraint& constraint)
    { return constraint.Kind != ConstraintKind::Boundary && part.IsNear(constraint.Point); });
}

} // namespace

std::vector<DoubtfulPart> QuestionsOf(const std::vector<DoubtfulPart>& doubts,
  const ConstraintList& constraints, const std::vector<VoxelRun>& voxels,
  const ImageGeometry& image, const QuestionSettings& settings)
{
  std::vector<DoubtfulPart> questions;
  for (auto doubt = doubts.rbegin(); doubt != doubts.rend(); ++doubt)
  {
    const bool isFoundLater = std::any_of(questions.begin(), questions.end(),
      [&doubt](const DoubtfulPart& later) { return doubt->IsSame(later); });
    if (!isFoundLater)
    {
      questions.push_back(*doubt);
    }
  }
  questions.erase(std::remove_if(questions.begin(), questions.end(),
                    [&constraints](const DoubtfulPart& part)
                    { return IsAnswered(part, constraints); }),
    questions.end());
  const auto worth = [&settings](const DoubtfulPart& part)
  { return std::sqrt(part.Volume) / (1 + std::exp(part.Margin / settings.MarginScale)); };
  std::stable_sort(questions.begin(), questions.end(),
    [&worth](const DoubtfulPart& one, const DoubtfulPart& other)
    { return worth(one) > worth(other); });
  questions.resize(std::min(questions.size(), settings.Most));
  for (DoubtfulPart& question : questions)
  {
    const std::array<int, 3> voxel = NearestVoxel(image, question.Place);
    question.Place = image.ToPhysical(Eigen::Vector3d(voxel[0], voxel[1], voxel[2]));
    question.IsIncluded = HasVoxel(voxels, voxel);
  }
  return questions;
}

const std::vector<TableColumn<DoubtfulPart>>& QuestionColumns()
{
  using Part = const DoubtfulPart&;
  static const std::vector<TableColumn<DoubtfulPart>> columns{
    { "x", false, [](Part part) { return part.Place.x(); } },
    { "y", false, [](Part part) { return part.Place.y(); } },
    { "z", false, [](Part part) { return part.Place.z(); } },
    { "volume_ml", false, [](Part part) { return part.Volume / 1000; } },
    { "included", true, [](Part part) { return part.IsIncluded ? 1.0 : 0.0; } },
    { "margin", false, [](Part part) { return part.Margin; } },
  };
  return columns;
}

} // namespace FlipFree
