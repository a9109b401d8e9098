#include "Evidence/VesselTrack.h"

#include "Quantile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

// A disk counts as evidence by as much as its contrast is above this: outside the organ, and
// within, where a part of the rim lies in the organ.
constexpr float ContrastOutside = 0.45F;
constexpr float ContrastInOrgan = 0.25F;

// Per slice of this thickness, in millimeters.
constexpr double UnitOfLength = 4;

// What lies outside counts for no more than this, so that no other vessel, which touches the organ
// in one slice, wins by its length.
constexpr float MostOutside = 4;
constexpr float LeastOutside = -1;
constexpr float PartInOrgan = 0.5F;

// From the organ, in Hounsfield units: contrast medium may be denser in the vessel.
constexpr float MuchDarker = 60;
constexpr float MuchBrighter = 200;
constexpr float OtherTissue = -1;

// A spread that is more than that of the organ's noise tells of more than one tissue.
constexpr float SpreadOfNoise = 2.5F;
constexpr float SpreadScale = 60;
constexpr float MostForSpread = 0.5F;
constexpr float WhollyCovered = 0.99F;

// From slice to slice.
constexpr double Slope = 1.2;
constexpr double CostOfShift = 0.05; // per square millimeter, over the millimeters between slices
constexpr float CostOfRadius = 0.1F;
constexpr float CostOfValue = 1.0F / 60; // per Hounsfield unit, beyond those of noise
constexpr float ValueOfNoise = 8;

// Where the rim is seen on one side alone, disks of several radii touch it: in millimeters, and per
// millimeter from it.
constexpr double UsualRadius = 11;
constexpr double CostOfOtherRadius = 0.01;

constexpr float Never = -1e9F;

struct Move
{
  int First;
  int Second;
  int Radius;
  float Cost;
};

std::vector<Move> MovesOf(double thickness)
{
  constexpr double rounding = 1e-4; // spacings that were stored as floats count as they were meant
  const double farthest = Slope * thickness / DiskGrid::Step + rounding;
  const int most = static_cast<int>(farthest);
  std::vector<Move> moves;
  for (int second = -most; second <= most; ++second)
  {
    for (int first = -most; first <= most; ++first)
    {
      const int squared = first * first + second * second;
      for (int radius = -1; squared <= farthest * farthest && radius <= 1; ++radius)
      {
        const double shift = CostOfShift * squared * DiskGrid::Step * DiskGrid::Step / thickness;
        moves.push_back({ first, second, radius,
          static_cast<float>(shift) + CostOfRadius * static_cast<float>(std::abs(radius)) });
      }
    }
  }
  return moves;
}

// The median over the disks that the mask covers wholly.
float MedianInOrgan(const std::vector<DiskSlice>& slices, std::vector<float> DiskSlice::*values)
{
  std::vector<float> all;
  for (const DiskSlice& slice : slices)
  {
    for (std::size_t disk = 0; disk < slice.Covered.size(); ++disk)
    {
      if (slice.Covered[disk] > WhollyCovered)
      {
        all.push_back((slice.*values)[disk]);
      }
    }
  }
  return all.empty() ? 0 : TakeQuantile(all, 0.5);
}

class TrackSearch
{
public:
  TrackSearch(const DiskGrid& grid, const std::vector<DiskSlice>& slices)
    : Grid(grid)
    , Slices(slices)
    , Organ(MedianInOrgan(slices, &DiskSlice::Value))
    , NoiseSpread(MedianInOrgan(slices, &DiskSlice::Spread))
    , Weight(static_cast<float>(grid.Thickness / UnitOfLength))
    , Moves(MovesOf(grid.Thickness))
  {
  }

  VesselTrack Execute(const ParallelFor& parallelFor)
  {
    const int count = static_cast<int>(this->Slices.size());
    std::vector<Outside> before;
    std::vector<Outside> behind;
    parallelFor(0, 2,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t side = first; side < last; ++side)
        {
          side == 0 ? before = this->FollowOutside(0, 1)
                    : behind = this->FollowOutside(count - 1, -1);
        }
      });
    this->From.resize(count);
    std::vector<float> last(this->Grid.Size(), Never);
    End best{ Never, 0, 0, 0 };
    for (int slice = 0; slice < count; ++slice)
    {
      last = this->EnterOrgan(slice, std::move(last), slice > 0 ? &before[slice - 1] : nullptr);
      this->FindEnd(slice, last, slice + 1 < count ? &behind[slice + 1] : nullptr, best);
    }
    return best.Score > 0 ? this->TraceBack(best, before) : VesselTrack();
  }

private:
  // The evidence of paths outside the organ that end in a disk, and their lengths.
  struct Outside
  {
    std::vector<float> Score;
    std::vector<float> Length;
  };

  struct End
  {
    float Score;
    int Slice;
    std::size_t Disk;
    double LengthBehind;
  };

  static constexpr int Beginning = -1; // in place of a move

  struct Place
  {
    int First;
    int Second;
    int Radius;
  };

  struct Predecessor
  {
    float Score = Never;
    std::size_t Disk = 0;
    int Move = Beginning;
  };

  Place PlaceOf(std::size_t disk) const
  {
    const auto columns = static_cast<std::size_t>(this->Grid.Count[0]);
    const auto rows = static_cast<std::size_t>(this->Grid.Count[1]);
    return { static_cast<int>(disk % columns), static_cast<int>(disk / columns % rows),
      static_cast<int>(disk / columns / rows) };
  }

  bool Holds(const Place& place) const
  {
    return place.First >= 0 && place.First < this->Grid.Count[0] && place.Second >= 0 &&
      place.Second < this->Grid.Count[1] && place.Radius >= 0 &&
      place.Radius < static_cast<int>(DiskGrid::Radii.size());
  }

  bool IsInOrgan(int slice, std::size_t disk) const
  {
    return this->Slices[slice].Covered[disk] >= PartInOrgan;
  }

  float EvidenceOf(int slice, std::size_t disk) const
  {
    const DiskSlice& disks = this->Slices[slice];
    const float difference = disks.Value[disk] - this->Organ;
    if (difference < -MuchDarker || difference > MuchBrighter)
    {
      return OtherTissue;
    }
    const float spread = (disks.Spread[disk] - SpreadOfNoise * this->NoiseSpread) / SpreadScale;
    const double other = std::abs(DiskGrid::Radii[this->PlaceOf(disk).Radius] - UsualRadius);
    return disks.Contrast[disk] - std::max(0.0F, std::min(spread, MostForSpread)) -
      static_cast<float>(CostOfOtherRadius * other);
  }

  // The best way to a disk of a slice from those of another one.
  Predecessor Best(const std::vector<float>& scores, int from, int slice, std::size_t disk) const
  {
    const Place place = this->PlaceOf(disk);
    const float value = this->Slices[slice].Value[disk];
    Predecessor best;
    for (std::size_t move = 0; move < this->Moves.size(); ++move)
    {
      const Move& step = this->Moves[move];
      if (!this->Holds(
            { place.First - step.First, place.Second - step.Second, place.Radius - step.Radius }))
      {
        continue;
      }
      const std::size_t other = this->Before(disk, step);
      const float change = std::abs(value - this->Slices[from].Value[other]) - ValueOfNoise;
      const float score = scores[other] - step.Cost - CostOfValue * std::max(0.0F, change);
      if (score > best.Score)
      {
        best = { score, other, static_cast<int>(move) };
      }
    }
    return best;
  }

  // Paths outside the organ, slice after slice, which may begin anywhere.
  std::vector<Outside> FollowOutside(int begin, int direction) const
  {
    std::vector<Outside> all(this->Slices.size());
    for (int slice = begin; slice >= 0 && slice < static_cast<int>(all.size()); slice += direction)
    {
      Outside& now = all[slice];
      now.Score.assign(this->Grid.Size(), 0);
      now.Length.assign(this->Grid.Size(), 0);
      for (std::size_t disk = 0; disk < this->Grid.Size(); ++disk)
      {
        if (this->IsInOrgan(slice, disk))
        {
          continue;
        }
        const float evidence = this->EvidenceOf(slice, disk) - ContrastOutside;
        const Predecessor before = slice == begin
          ? Predecessor()
          : this->Best(all[slice - direction].Score, slice - direction, slice, disk);
        const bool goesOn = before.Score > 0;
        const float score =
          (goesOn ? before.Score : 0) + std::max(evidence, LeastOutside) * this->Weight;
        if (score > 0)
        {
          now.Score[disk] = std::min(score, MostOutside);
          now.Length[disk] = static_cast<float>(this->Grid.Thickness) +
            (goesOn ? all[slice - direction].Length[before.Disk] : 0);
        }
      }
    }
    return all;
  }

  // The scores of paths that end in a disk within the organ.
  std::vector<float> EnterOrgan(int slice, std::vector<float> last, const Outside* before)
  {
    std::vector<float> scores(this->Grid.Size(), Never);
    this->From[slice].assign(this->Grid.Size(), Beginning);
    for (std::size_t disk = 0; before && disk < this->Grid.Size(); ++disk)
    {
      if (!this->IsInOrgan(slice - 1, disk))
      {
        last[disk] = before->Score[disk];
      }
    }
    for (std::size_t disk = 0; disk < this->Grid.Size(); ++disk)
    {
      if (!this->IsInOrgan(slice, disk))
      {
        continue;
      }
      const Predecessor way = before ? this->Best(last, slice - 1, slice, disk) : Predecessor();
      if (way.Score > 0)
      {
        this->From[slice][disk] = way.Move;
        scores[disk] = way.Score;
      }
      else
      {
        scores[disk] = 0;
      }
      scores[disk] += (this->EvidenceOf(slice, disk) - ContrastInOrgan) * this->Weight;
    }
    return scores;
  }

  void FindEnd(int slice, const std::vector<float>& scores, const Outside* behind, End& best) const
  {
    for (std::size_t disk = 0; disk < this->Grid.Size(); ++disk)
    {
      End end{ scores[disk], slice, disk, 0 };
      if (behind && end.Score + MostOutside > best.Score)
      {
        const Predecessor next = this->Best(behind->Score, slice + 1, slice, disk);
        if (next.Score > 0)
        {
          end.Score += next.Score;
          end.LengthBehind = behind->Length[next.Disk];
        }
      }
      if (end.Score > best.Score)
      {
        best = end;
      }
    }
  }

  VesselTrack TraceBack(const End& end, const std::vector<Outside>& before) const
  {
    VesselTrack track;
    track.LengthBehind = end.LengthBehind;
    std::size_t disk = end.Disk;
    for (int slice = end.Slice; slice >= 0; --slice)
    {
      track.InOrgan.push_back(this->DiskOf(slice, disk));
      const int move = this->From[slice][disk];
      if (move == Beginning)
      {
        break;
      }
      disk = this->Before(disk, this->Moves[move]);
      if (!this->IsInOrgan(slice - 1, disk))
      {
        track.LengthBefore = before[slice - 1].Length[disk];
        break;
      }
    }
    std::reverse(track.InOrgan.begin(), track.InOrgan.end());
    return track;
  }

  std::size_t Before(std::size_t disk, const Move& move) const
  {
    const std::ptrdiff_t columns = this->Grid.Count[0];
    return disk - (move.First + columns * (move.Second + this->Grid.Count[1] * move.Radius));
  }

  VesselTrack::Disk DiskOf(int slice, std::size_t disk) const
  {
    const Place place = this->PlaceOf(disk);
    return { slice, { { this->Grid.At(0, place.First), this->Grid.At(1, place.Second) } },
      DiskGrid::Radii[place.Radius] };
  }

  const DiskGrid& Grid;
  const std::vector<DiskSlice>& Slices;
  const float Organ; // its gray value
  const float NoiseSpread;
  const float Weight; // of a slice
  const std::vector<Move> Moves;
  std::vector<std::vector<int>> From; // the move to each disk in the organ, by slice
};

} // namespace

VesselTrack FindVesselTrack(const DiskGrid& grid, const std::vector<DiskSlice>& slices,
  const ParallelFor& parallelFor)
{
  return TrackSearch(grid, slices).Execute(parallelFor);
}

} // namespace FlipFree
