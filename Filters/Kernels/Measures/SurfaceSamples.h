/**
 * Evenly distributed samples of a surface, each of which stands for a patch of area.
 */
#ifndef FlipFreeSurfaceSamples_h
#define FlipFreeSurfaceSamples_h

#include "KernelTypes.h"

#include <algorithm>
#include <string>
#include <vector>

namespace FlipFree
{

/// Each triangle is divided into n^2 congruent patches, n along each edge, and each patch is
/// sampled at its centroid. The samples are numbered triangle by triangle.
class SurfaceSamples
{
public:
  /// Neighboring samples of a triangle are at most `spacing` (mm) apart; those of a triangle that
  /// is longer than about 500 times that, a 500th of its length. Throws Error, naming the surface
  /// by `name`, when it has no area, or too large a one, or would need more than a hundred million
  /// samples. Keeps a reference to the points.
  SurfaceSamples(const PointList& points, TriangleList triangles, double spacing,
    const std::string& name);

  std::size_t Size() const { return this->Offsets.back(); }
  const PointList& GetPoints() const { return this->Points; }
  const TriangleList& GetTriangles() const { return this->Triangles; }

  Eigen::RowVector3d PositionOf(std::size_t sample, Eigen::Index triangle) const;

  /// Of each patch of a triangle.
  double PatchAreaOf(Eigen::Index triangle) const { return this->PatchAreas[triangle]; }

  /// The sample next to a corner (0 to 2) of a triangle, and its distance to this corner.
  std::size_t SampleAt(Eigen::Index triangle, int corner) const;
  double DistanceToSampleAt(Eigen::Index triangle, int corner) const;

  /// Calls visit(sample, triangle) for a range of samples.
  template <typename Visit>
  void ForEach(std::size_t first, std::size_t last, const Visit& visit) const
  {
    const auto after = std::upper_bound(this->Offsets.begin(), this->Offsets.end(), first);
    Eigen::Index triangle = after - this->Offsets.begin() - 1;
    for (std::size_t sample = first; sample < last; ++sample)
    {
      triangle += sample == this->Offsets[triangle + 1];
      visit(sample, triangle);
    }
  }

private:
  const PointList& Points;
  TriangleList Triangles;
  std::vector<std::size_t> Offsets; // the first sample of each triangle, and the end
  std::vector<int> Divisions;       // per triangle
  std::vector<double> PatchAreas;
};

} // namespace FlipFree

#endif
