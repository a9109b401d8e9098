#include "Evidence/SeveredParts.h"

#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

namespace FlipFree
{
namespace
{

// Where gray values are compared, in millimeters from the cut: beyond its partial volume.
constexpr double NearestSample = 2;
constexpr double FarthestSample = 8;
constexpr double LeastDepth = 3.5;

class SeveredSearch
{
public:
  SeveredSearch(const ImageGeometry& blocks, const BlockNodes& nodes,
    const std::vector<float>& smooth, double edgeContrast, const std::vector<float>& squaredDepth,
    const std::function<bool(std::size_t block)>& isKept)
    : Blocks(blocks)
    , Nodes(nodes)
    , Smooth(smooth)
    , EdgeContrast(edgeContrast)
    , SquaredDepth(squaredDepth)
    , Kept(isKept)
  {
  }

  std::vector<SeveredPart> Execute()
  {
    std::vector<SeveredPart> parts;
    this->IsFound.assign(this->Nodes.NumberOfBlocks(), false);
    for (std::size_t block = 0; block < this->IsFound.size(); ++block)
    {
      if (!this->IsFound[block] && this->IsSevered(block))
      {
        parts.push_back(this->PartOf(block));
      }
    }
    return parts;
  }

private:
  bool IsSevered(std::size_t block) const
  {
    return this->Nodes.IsNode(block) && !this->Kept(block);
  }
  bool IsKept(std::size_t block) const { return this->Nodes.IsNode(block) && this->Kept(block); }

  SeveredPart PartOf(std::size_t first)
  {
    SeveredPart part;
    part.Blocks = { first };
    this->IsFound[first] = true;
    for (std::size_t at = 0; at < part.Blocks.size(); ++at) // which grows
    {
      VisitNeighbors(part.Blocks[at], this->Blocks,
        [&](std::size_t other)
        {
          if (this->IsSevered(other) && !this->IsFound[other])
          {
            this->IsFound[other] = true;
            part.Blocks.push_back(other);
          }
        });
    }
    part.Volume = static_cast<double>(part.Blocks.size()) * this->Blocks.VoxelVolume();
    this->MeasureCut(part);
    return part;
  }

  void MeasureCut(SeveredPart& part) const
  {
    std::vector<std::size_t> own;
    std::vector<std::size_t> rest;
    double attenuated = 0;
    for (const std::size_t block : part.Blocks)
    {
      VisitNeighbors(block, this->Blocks,
        [&](std::size_t other)
        {
          if (!this->IsKept(other))
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
    const auto [meanOfPart, samplesOfPart] =
      this->MeanBehind(own, [this](std::size_t block) { return this->IsSevered(block); });
    const auto [meanOfRest, samplesOfRest] =
      this->MeanBehind(rest, [this](std::size_t block) { return this->IsKept(block); });
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
    return this->Blocks.VoxelVolume() / this->Blocks.Spacing[axis];
  }

  // The mean gray value, and the number, of the blocks behind the first ones, from face to face.
  template <typename Belongs>
  std::pair<double, int> MeanBehind(const std::vector<std::size_t>& first,
    const Belongs& belongs) const
  {
    using Place = std::pair<double, std::size_t>; // millimeters
    std::unordered_map<std::size_t, double> distances;
    std::priority_queue<Place, std::vector<Place>, std::greater<>> next;
    for (const std::size_t block : first)
    {
      if (distances.emplace(block, 0).second)
      {
        next.emplace(0, block);
      }
    }
    double sum = 0;
    int count = 0;
    while (!next.empty())
    {
      const auto [distance, block] = next.top();
      next.pop();
      if (distance > distances[block])
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
          const double reached = from + this->Blocks.VoxelVolume() / this->AreaBetween(here, other);
          if (reached > FarthestSample || !belongs(other))
          {
            return;
          }
          const auto known = distances.emplace(other, reached);
          if (known.second || reached < known.first->second)
          {
            known.first->second = reached;
            next.emplace(reached, other);
          }
        });
    }
    return { count > 0 ? sum / count : 0, count };
  }

  const ImageGeometry& Blocks;
  const BlockNodes& Nodes;
  const std::vector<float>& Smooth;
  const double EdgeContrast;
  const std::vector<float>& SquaredDepth;
  const std::function<bool(std::size_t)>& Kept;
  std::vector<bool> IsFound;
};

} // namespace

std::optional<double> EvidenceOfNeighbor(const SeveredPart& part, const NeighborSettings& settings,
  double spread, Modality modality)
{
  if (part.Area == 0 || part.Samples < settings.LeastSamples)
  {
    return std::nullopt;
  }
  const double least = modality == Modality::MR ? 0 : settings.LeastStepInCT;
  const double step = part.Step / std::max(settings.Step * spread, least);
  const double edge = part.Edge / settings.Edge;
  return std::max(step * step, edge * edge);
}

std::vector<SeveredPart> FindSeveredParts(const ImageGeometry& blocks, const BlockNodes& nodes,
  const std::vector<float>& smooth, const std::vector<float>& squaredDepth, double edgeContrast,
  const std::function<bool(std::size_t block)>& isKept)
{
  return SeveredSearch(blocks, nodes, smooth, edgeContrast, squaredDepth, isKept).Execute();
}

} // namespace FlipFree
