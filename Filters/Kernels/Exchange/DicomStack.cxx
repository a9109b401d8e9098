#include "Exchange/DicomStack.h"

#include "MessageText.h"
#include "Quantile.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

/// Of the slice spacing: what is worth a warning, and what makes slices no volume.
constexpr double WorthWarning = 0.01;
constexpr double NoEvenStack = 0.5;

/// Of the size of a pixel: archives round digits.
constexpr double OnePlace = 0.05;

std::vector<double> PlacesAlongNormal(const std::vector<DicomFrame>& frames)
{
  const Eigen::Vector3d normal = frames.front().Normal();
  std::vector<double> places;
  places.reserve(frames.size());
  for (const DicomFrame& frame : frames)
  {
    places.push_back(normal.dot(frame.Position));
  }
  return places;
}

/// Of two in the middle, the lesser one: a missing slice makes gaps greater.
double MedianGap(const std::vector<double>& places)
{
  std::vector<double> gaps;
  for (std::size_t index = 1; index < places.size(); ++index)
  {
    gaps.push_back(places[index] - places[index - 1]);
  }
  return TakeQuantile(gaps, 0.5);
}

/// Why gaps between neighbors are not even; empty where they are, but for half of the usual one.
/// Slices are missing where single gaps are whole multiples of the usual one.
std::string WhyGapsDiffer(const std::vector<DicomFrame>& frames, const std::vector<double>& places,
  const DicomFrameName& nameOf)
{
  constexpr double tolerance = 0.1; // of the usual gap
  const double usual = MedianGap(places);
  std::size_t missing = 0;
  std::size_t worst = 0;
  std::size_t lastGap = 0;
  double least = usual;
  double greatest = usual;
  bool areSingle = true;
  for (std::size_t index = 1; index < places.size(); ++index)
  {
    const double gap = places[index] - places[index - 1];
    worst = gap > greatest ? index : worst;
    least = std::min(least, gap);
    greatest = std::max(greatest, gap);
    if (gap - usual > NoEvenStack * usual)
    {
      const double count = std::round(gap / usual);
      areSingle = areSingle && std::abs(gap - count * usual) < tolerance * usual &&
        (lastGap == 0 || lastGap + 1 < index);
      missing += static_cast<std::size_t>(count) - 1;
      lastGap = index;
    }
  }
  const bool isShort = usual - least > NoEvenStack * usual;
  if (lastGap == 0 && !isShort)
  {
    return {};
  }
  if (areSingle && !isShort && missing < places.size())
  {
    return std::to_string(missing) + (missing == 1 ? " slice is" : " slices are") +
      " missing, at least between " + nameOf(frames[worst - 1]) + " and " + nameOf(frames[worst]) +
      ", which are " + TextOf(greatest) + " mm apart instead of " + TextOf(usual) +
      " mm. Download or copy the series again.";
  }
  return "its slices are unevenly spaced: they are " + TextOf(least) + " to " + TextOf(greatest) +
    " mm apart. Download the series again if slices may be missing; otherwise resample it to even "
    "slices.";
}

/// How frames stray from an even stack.
void JudgeStray(const std::vector<DicomFrame>& frames, const DicomFrameName& nameOf,
  DicomStack& stack)
{
  double worstStray = 0;
  std::size_t worst = 0;
  for (std::size_t slice = 0; slice < frames.size(); ++slice)
  {
    const Eigen::Vector3d expected =
      stack.Geometry.ToPhysical(Eigen::Vector3d(0, 0, static_cast<double>(slice)));
    const double stray = (frames[slice].Position - expected).norm();
    if (stray > worstStray)
    {
      worstStray = stray;
      worst = slice;
    }
  }
  const double spacing = stack.Geometry.Spacing[2];
  if (worstStray <= WorthWarning * spacing)
  {
    return;
  }
  const std::string what = "its slices are unevenly spaced: " + nameOf(frames[worst]) + " lies " +
    TextOf(worstStray) + " mm from its place in an even stack of spacing " + TextOf(spacing) +
    " mm. ";
  if (worstStray > NoEvenStack * spacing)
  {
    stack.Problem = what + "Resample the series to even slices, or export one with even slices.";
  }
  else
  {
    stack.Warning = what + "It is read as if it were even.";
  }
}

} // namespace

void SortAlongNormal(std::vector<DicomFrame>& frames)
{
  const Eigen::Vector3d normal = frames.front().Normal();
  std::stable_sort(frames.begin(), frames.end(),
    [&normal](const DicomFrame& a, const DicomFrame& b)
    { return normal.dot(a.Position) < normal.dot(b.Position); });
}

bool AreAtOnePlace(const DicomFrame& a, const DicomFrame& b)
{
  return std::abs(a.Normal().dot(a.Position - b.Position)) < OnePlace * a.Spacing.minCoeff();
}

std::size_t GreatestRepetition(const std::vector<DicomFrame>& frames)
{
  std::size_t greatest = 0;
  std::size_t first = 0;
  for (std::size_t index = 0; index < frames.size(); ++index)
  {
    first = AreAtOnePlace(frames[first], frames[index]) ? first : index;
    greatest = std::max(greatest, index + 1 - first);
  }
  return greatest;
}

DicomStack StackOf(const std::vector<DicomFrame>& frames, const DicomFrameName& nameOf)
{
  DicomStack stack;
  const DicomFrame& first = frames.front();
  ImageGeometry& grid = stack.Geometry;
  grid.Dimensions = { first.Format.Columns, first.Format.Rows, static_cast<int>(frames.size()) };
  grid.Origin = first.Position;
  grid.Spacing = { first.Spacing[0], first.Spacing[1], 1 };
  grid.Direction.leftCols<2>() = first.Axes;
  grid.Direction.col(2) = first.Normal();
  if (frames.size() == 1)
  {
    stack.Problem = "it is a single slice, not a volume. Choose another series.";
    return stack;
  }
  for (std::size_t index = 1; index < frames.size(); ++index)
  {
    if (AreAtOnePlace(frames[index - 1], frames[index]))
    {
      const bool areOfOneFile = frames[index - 1].File == frames[index].File;
      stack.Problem = nameOf(frames[index - 1]) + " and " + nameOf(frames[index]) +
        " lie at the same place, and nothing that is known tells which volume they belong to. " +
        (areOfOneFile ? "Export each volume as a series of its own."
                      : "Move the files of one volume into a folder of their own.");
      return stack;
    }
  }
  const std::vector<double> places = PlacesAlongNormal(frames);
  stack.Problem = WhyGapsDiffer(frames, places, nameOf);
  if (!stack.Problem.empty())
  {
    stack.HasGap = true;
    return stack;
  }
  const Eigen::Vector3d along = frames.back().Position - grid.Origin;
  grid.Spacing[2] = along.norm() / static_cast<double>(frames.size() - 1);
  // A tilted gantry shears the stack. The third axis then leans, so that every voxel stays where it
  // was measured. Below a hundredth of a pixel it is rounding, and the axes stay orthogonal.
  const Eigen::Vector3d lean = along - along.norm() * grid.Direction.col(2);
  if (lean.norm() > 0.01 * first.Spacing.minCoeff())
  {
    grid.Direction.col(2) = along.normalized();
  }
  JudgeStray(frames, nameOf, stack);
  return stack;
}

} // namespace FlipFree
