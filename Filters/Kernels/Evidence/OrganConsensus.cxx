#include "Evidence/OrganConsensus.h"

#include "Evidence/BoundarySupport.h"
#include "Evidence/CoarseOrgan.h"
#include "Evidence/OrganCarving.h"
#include "Image/BallMorphology.h"
#include "Intensity/IntensityField.h"
#include "Intensity/ModelFit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr double DoubtfulOverlap = 0.92;
// In millimeters.
constexpr double Surroundings = 30;
constexpr double FieldMargin = 2;
constexpr double WidestOpening = 9;
// Of the usual opening's radius.
constexpr double WiderOpening = 1.6;
// A foreground's volume in comparison with what was carved.
constexpr double GreatestGrowth = 3;
// Of one that goes on beyond the surroundings, so that only a part of it is known.
constexpr double GreatestCutGrowth = 2;
// Masses of the foreground for growth from the seed.
constexpr std::array<double, 2> NarrowMasses{ { 0.8, 0.9 } };
constexpr double UnanimityWithoutOpinions = 0.5;
// By which growth from the seed must be better supported.
constexpr double SupportMargin = 1.25;

double DiceOf(std::size_t inBoth, std::size_t inOne, std::size_t inOther)
{
  return 2 * static_cast<double>(inBoth) / static_cast<double>(inOne + inOther);
}

double OverlapOf(const BitMask& one, const BitMask& other)
{
  BitMask both = one;
  both.Intersect(other);
  return DiceOf(both.Count(), one.Count(), other.Count());
}

class Consensus
{
public:
  Consensus(const ImageView<float>& smooth, const VoxelBox& box, const SeedSphere& seed,
    double noise, const OrganFeatureSettings& settings, const ParallelFor& parallelFor,
    const Monitor& monitor, const BitMask& carved)
    : Smooth(smooth)
    , Seed(seed)
    , Noise(noise)
    , Settings(settings)
    , Parallel(parallelFor)
    , Remembering(monitor)
    , Box(box)
    , Whole(WholeBox(smooth.Geometry))
    , Usual(carved.Cropped(box))
    , Count(static_cast<double>(this->Usual.Count()))
  {
    this->ReadImage();
    this->Considered = BitMask(this->Image.Geometry);
  }

  // None if the monitor stopped it.
  std::optional<BitMask> Execute()
  {
    std::optional<BitMask> decided = this->Decide();
    if (this->Remembering.HasStopped())
    {
      return std::nullopt;
    }
    BitMask best = std::move(decided).value_or(this->Usual);
    return this->ReplaceByGrowth(best) ? std::make_optional(std::move(best)) : std::nullopt;
  }

  const std::vector<BitMask>& GetOpinions() const { return this->Opinions; }
  const BitMask& GetConsidered() const { return this->Considered; }
  double GetUnanimity() const { return this->Unanimity; }

private:
  void ReadImage() { CropToFloat(this->Smooth, this->Box, this->Parallel, this->Image); }

  // What is done is counted in foregrounds that were grown.
  Monitor Proceed()
  {
    return [this](double)
    {
      constexpr double all = 2 + NarrowMasses.size();
      return this->Remembering.Get()(std::min(1.0, this->Grown / all));
    };
  }

  LeakControlRadii Radii(double opening) const
  {
    LeakControlRadii radii = RadiiOf(this->Settings.Leaks, this->Seed.Radius, this->Image.Geometry);
    radii.Opening = std::min(opening * radii.Opening, std::max(radii.Opening, WidestOpening));
    return radii;
  }

  // Whether the foreground goes on beyond the box.
  bool IsCut(const BitMask& grown) const
  {
    const VoxelBox bounds = grown.Bounds();
    bool cut = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      cut = cut || (bounds.Begin[axis] == 0 && this->Box.Begin[axis] > this->Whole.Begin[axis]) ||
        (bounds.End[axis] == this->Box.Size(axis) && this->Box.End[axis] < this->Whole.End[axis]);
    }
    return cut;
  }

  // None where the foreground has leaked.
  std::optional<BitMask> Grow(const ImageView<float>& image, const IntensityModel& model,
    double opening)
  {
    BitMask grown;
    if (!FindForegroundInBox(image, WholeBox(image.Geometry), model, this->Seed,
          this->Radii(opening), this->Parallel, this->Proceed(), grown))
    {
      return std::nullopt;
    }
    ++this->Grown;
    const double most = this->IsCut(grown) ? GreatestCutGrowth : GreatestGrowth;
    if (static_cast<double>(grown.Count()) > most * this->Count)
    {
      return std::nullopt;
    }
    this->Considered.Unite(grown);
    return grown;
  }

  // `supported` may be null. What is asked about is what was carved at first.
  std::optional<BitMask> Carve(const BitMask& candidate, const BitMask* supported)
  {
    BitMask carved;
    if (!CarveOrgan(this->Image.View(), candidate, supported, this->Seed, this->Noise,
          this->Settings.Modality, this->Parallel, this->Proceed(), carved, nullptr))
    {
      return std::nullopt;
    }
    this->Opinions.push_back(carved);
    return carved;
  }

  // Grown anew by the intensities of what was carved.
  std::optional<BitMask> GrowAgain(const ImageView<float>& image)
  {
    IntensityModel model = FitToSeed(image, this->Seed, this->Noise, this->Settings.Intensity);
    if (RefitToInside(image, { { 0, 0, 0 } }, this->Usual, this->Noise, this->Settings.Intensity,
          this->Parallel, this->Proceed(), model) == Refit::Stopped)
    {
      return std::nullopt;
    }
    return this->Grow(image, model, WiderOpening);
  }

  std::optional<BitMask> GrowWithoutField()
  {
    BitMask core = this->Usual;
    if (!Erode(core, FieldMargin, this->Parallel, this->Proceed()))
    {
      return std::nullopt;
    }
    const std::optional<IntensityField> field =
      IntensityField::Fit(this->Image.View(), core, this->Seed, this->Settings.Modality);
    if (!field)
    {
      return std::nullopt;
    }
    // In place, and read again afterward: a copy would take as much memory as the image.
    field->Flatten(this->Image.Geometry, this->Parallel, this->Image.Voxels.data());
    std::optional<BitMask> grown = this->GrowAgain(this->Image.View());
    this->ReadImage();
    return grown;
  }

  // What two of three hold is supported; the cut decides about it and about what was carved.
  std::optional<BitMask> Decide()
  {
    const std::optional<BitMask> again = this->GrowAgain(this->Image.View());
    if (!again || this->Remembering.HasStopped())
    {
      return std::nullopt;
    }
    const std::optional<BitMask> flat = this->GrowWithoutField();
    if (!flat)
    {
      return std::nullopt;
    }
    BitMask either = *again;
    either.Unite(*flat);
    either.Intersect(this->Usual);
    BitMask supported = *again;
    supported.Intersect(*flat);
    supported.Unite(either);
    BitMask candidate = supported;
    candidate.Unite(this->Usual);
    this->Unanimity = OverlapOf(supported, this->Usual);
    return this->Carve(candidate, &supported);
  }

  // By growth from the seed where it is clearly better supported. Blocks tell where it may be.
  bool ReplaceByGrowth(BitMask& best)
  {
    const IntensityModel ofSeed =
      FitToSeed(this->Image.View(), this->Seed, this->Noise, this->Settings.Intensity);
    const CoarseOrgan coarse({ this->Image.View(), {} }, this->Image.Geometry, best, this->Seed,
      this->Noise, this->Settings, ofSeed, this->Parallel);
    const double coarseSupport = coarse.SupportOf(coarse.BlocksOf(best));
    std::optional<double> support; // takes time, and mostly blocks tell enough
    for (const double mass : NarrowMasses)
    {
      BitMask blocks;
      if (!coarse.Grow(mass, this->Proceed(), blocks))
      {
        return false;
      }
      if (!blocks.HasGrid() || coarse.SupportOf(blocks) <= coarseSupport)
      {
        ++this->Grown;
        continue;
      }
      const std::optional<BitMask> grown =
        this->Grow(this->Image.View(), NarrowedTo(mass, ofSeed), 1);
      std::optional<BitMask> other = grown ? this->Carve(*grown, nullptr) : std::nullopt;
      if (this->Remembering.HasStopped())
      {
        return false;
      }
      const auto supportOf = [&](const BitMask& mask)
      { return BoundarySupport(this->Image.View(), mask, coarse.GetLeastContrast()); };
      support = support.value_or(SupportMargin * supportOf(best));
      const double ofOther = other ? supportOf(*other) : 0;
      if (ofOther > *support)
      {
        best = std::move(*other);
        support = ofOther;
      }
    }
    return true;
  }

  const ImageView<float> Smooth;
  const SeedSphere& Seed;
  const double Noise;
  const OrganFeatureSettings& Settings;
  const ParallelFor& Parallel;
  const RememberingMonitor Remembering;
  const VoxelBox Box;
  const VoxelBox Whole;
  const BitMask Usual;
  const double Count;
  FloatImage Image;
  BitMask Considered; // by opinions
  std::vector<BitMask> Opinions;
  double Grown = 0;
  double Unanimity = UnanimityWithoutOpinions;
};

} // namespace

bool IsDoubtful(const BitMask& inside, const BitMask& carved)
{
  return OverlapOf(inside, carved) < DoubtfulOverlap;
}

VoxelBox ConsensusBox(const BitMask& carved, const SeedSphere& seed)
{
  const ImageGeometry& geometry = carved.GetGeometry();
  return WidenedBy(carved.Bounds().Joined(BoxAround(geometry, seed.Center, seed.Radius)),
    Surroundings, 1, geometry);
}

bool SeekConsensus(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const OrganFeatureSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& carved, FurtherOpinions& opinions)
{
  const VoxelBox box = ConsensusBox(carved, seed);
  Consensus seeker(smooth, box, seed, noise, settings, parallelFor, monitor, carved);
  const std::optional<BitMask> consensus = seeker.Execute();
  if (!consensus)
  {
    return false;
  }
  const auto onGrid = [&](const BitMask& cropped)
  {
    BitMask mask(smooth.Geometry);
    mask.Insert(cropped, box.Begin);
    return mask;
  };
  opinions.Carved.push_back(std::move(carved));
  for (const BitMask& opinion : seeker.GetOpinions())
  {
    opinions.Carved.push_back(onGrid(opinion));
  }
  opinions.Considered = onGrid(seeker.GetConsidered());
  opinions.Unanimity = seeker.GetUnanimity();
  carved = onGrid(*consensus);
  return true;
}

} // namespace FlipFree
