#include "Evidence/SeveredParts.h"

#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace FlipFree
{
namespace
{

// Where gray values are compared, in millimeters from the cut: beyond its partial volume.
constexpr double NearestSample = 2;
constexpr double FarthestSample = 8;
constexpr double LeastDepth = 3.5;

// Of a neighbor: SeveredPart::Step in Hounsfield units, more than vessels cause, and Edge.
constexpr double NeighborStep = 3.5;
constexpr double NeighborEdge = 0.1;

class SeveredSearch
{
public:
  SeveredSearch(const ImageGeometry& blocks, const BlockNodes& nodes,
    const std::vector<float>& smooth, double edgeContrast, const std::vector<float>& squaredDepth,
    const std::function<bool(std::size_t block)>& isKept)
    : Blocks(blocks)
    , Smooth(smooth)
    , EdgeContrast(edgeContrast)
    , SquaredDepth(squaredDepth)
    , Sides(nodes.NumberOfBlocks(), Side::None)
    , Distances(nodes.NumberOfBlocks(), Unreached)
  {
    for (std::size_t block = 0; block < this->Sides.size(); ++block)
    {
      if (nodes.IsNode(block))
      {
        this->Sides[block] = isKept(block) ? Side::Kept : Side::Severed;
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Areas[axis] = blocks.VoxelVolume() / blocks.Spacing[axis];
    }
  }

  std::vector<SeveredPart> Execute()
  {
    std::vector<SeveredPart> parts;
    std::vector<bool> isFound(this->Sides.size(), false);
    for (std::size_t block = 0; block < isFound.size(); ++block)
    {
      if (!isFound[block] && this->Sides[block] == Side::Severed)
      {
        parts.push_back(this->PartOf(block, isFound));
        this->MeasureCut(parts.back());
      }
    }
    return parts;
  }

private:
  enum class Side : unsigned char
  {
    None, // no node
    Kept,
    Severed
  };

  static constexpr double Unreached = std::numeric_limits<double>::infinity();

  SeveredPart PartOf(std::size_t first, std::vector<bool>& isFound) const
  {
    SeveredPart part;
    part.Blocks = { first };
    isFound[first] = true;
    for (std::size_t at = 0; at < part.Blocks.size(); ++at) // which grows
    {
      VisitNeighbors(part.Blocks[at], this->Blocks,
        [&](std::size_t other)
        {
          if (this->Sides[other] == Side::Severed && !isFound[other])
          {
            isFound[other] = true;
            part.Blocks.push_back(other);
          }
        });
    }
    part.Volume = static_cast<double>(part.Blocks.size()) * this->Blocks.VoxelVolume();
    return part;
  }

  void MeasureCut(SeveredPart& part)
  {
    std::vector<std::size_t> own;
    std::vector<std::size_t> rest;
    double attenuated = 0;
    for (const std::size_t block : part.Blocks)
    {
      VisitNeighbors(block, this->Blocks,
        [&](std::size_t other)
        {
          if (this->Sides[other] != Side::Kept)
          {
            return;
          }
          const double area = this->AreaBetween(block, other);
          const double jump = (this->Smooth[block] - this->Smooth[other]) / this->EdgeContrast;
          if (this->IsDeep(block) && this->IsDeep(other))
          {
            part.Area += area;
            attenuated += area * (std::isfinite(jump) ? std::exp(-0.5 * jump * jump) : 0);
          }
          own.push_back(block);
          rest.push_back(other);
        });
    }
    part.Edge = part.Area > 0 ? 1 - attenuated / part.Area : 0;
    const auto [meanOfPart, samplesOfPart] = this->MeanBehind(own, Side::Severed);
    const auto [meanOfRest, samplesOfRest] = this->MeanBehind(rest, Side::Kept);
    part.Samples = std::min(samplesOfPart, samplesOfRest);
    part.Step = meanOfPart - meanOfRest;
  }

  // Not in the blurred rim of the organ.
  bool IsDeep(std::size_t block) const
  {
    return this->SquaredDepth[block] > LeastDepth * LeastDepth;
  }

  double AreaBetween(std::size_t block, std::size_t other) const
  {
    const std::array<std::ptrdiff_t, 3> steps = StepsOf(this->Blocks);
    const auto away = std::abs(static_cast<std::ptrdiff_t>(other - block));
    const int axis = away == steps[2] ? 2 : (away == steps[1] ? 1 : 0);
    return this->Areas[axis];
  }

  // The mean gray value, and the number, of the blocks behind the first ones, from face to face on
  // their side.
  std::pair<double, int> MeanBehind(const std::vector<std::size_t>& first, Side side)
  {
    using Place = std::pair<double, std::size_t>; // millimeters
    std::priority_queue<Place, std::vector<Place>, std::greater<>> next;
    std::vector<std::size_t> reached;
    const auto reach = [&](std::size_t block, double distance)
    {
      double& known = this->Distances[block];
      if (distance < known)
      {
        if (known == Unreached)
        {
          reached.push_back(block);
        }
        known = distance;
        next.emplace(distance, block);
      }
    };
    for (const std::size_t block : first)
    {
      reach(block, 0);
    }
    double sum = 0;
    int count = 0;
    while (!next.empty())
    {
      const auto [distance, block] = next.top();
      next.pop();
      if (distance > this->Distances[block])
      {
        continue;
      }
      if (distance >= NearestSample && this->IsDeep(block) && std::isfinite(this->Smooth[block]))
      {
        sum += this->Smooth[block];
        ++count;
      }
      VisitNeighbors(block, this->Blocks,
        [&, from = distance, here = block](std::size_t other)
        {
          const double onward = from + this->Blocks.VoxelVolume() / this->AreaBetween(here, other);
          if (onward <= FarthestSample && this->Sides[other] == side)
          {
            reach(other, onward);
          }
        });
    }
    for (const std::size_t block : reached)
    {
      this->Distances[block] = Unreached;
    }
    return { count > 0 ? sum / count : 0, count };
  }

  const ImageGeometry& Blocks;
  const std::vector<float>& Smooth;
  const double EdgeContrast;
  const std::vector<float>& SquaredDepth;
  std::vector<Side> Sides;
  std::array<double, 3> Areas{}; // of the blocks' faces
  std::vector<double> Distances; // of MeanBehind()
};

} // namespace

std::optional<double> EvidenceOfNeighbor(const SeveredPart& part)
{
  if (part.Area == 0 || part.Samples == 0)
  {
    return std::nullopt;
  }
  const double step = part.Step / NeighborStep;
  const double edge = part.Edge / NeighborEdge;
  return std::max(step * step, edge * edge);
}

std::vector<SeveredPart> FindSeveredParts(const ImageGeometry& blocks, const BlockNodes& nodes,
  const std::vector<float>& smooth, const std::vector<float>& squaredDepth, double edgeContrast,
  const std::function<bool(std::size_t block)>& isKept)
{
  return SeveredSearch(blocks, nodes, smooth, edgeContrast, squaredDepth, isKept).Execute();
}

} // namespace FlipFree
