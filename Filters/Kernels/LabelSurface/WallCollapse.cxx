#include "LabelSurface/WallCollapse.h"

#include "Geometry/ClosestDirection.h"
#include "Geometry/DistanceQuery.h"
#include "Geometry/HullIntersection.h"

#include <Eigen/Geometry>

#include <numeric>
#include <queue>
#include <unordered_map>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

// Of a new triangle, unless those that move were worse: area over that of an equilateral triangle
// with the same sum of squared sides.
constexpr double LeastQuality = 0.15;

// Cosine between a triangle's normals before and after.
constexpr double LeastTurn = 0.2;

// Voxels. Above what rounding to single precision moves walls by (GridFrame.cxx).
constexpr double CenterClearance = 2e-3;

// Beside the quadrics, so that short edges go first where walls are flat.
constexpr double WeightOfLength = 1e-4;

// Of the triangles; rounds that take away less are the last ones.
constexpr double LeastProgress = 0.01;

// Collapses between two questions to the monitor.
constexpr int QuestionInterval = 256;

using Corners = std::array<int, 3>;

bool HasCorner(const Corners& triangle, int vertex)
{
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

// The others, in order.
std::array<int, 2> OthersOf(const Corners& triangle, int vertex)
{
  const int at = triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
  return { { triangle[(at + 1) % 3], triangle[(at + 2) % 3] } };
}

// Triangles by the boxes of space that they reach into.
class TriangleBins
{
public:
  explicit TriangleBins(double size)
    : Size(size)
  {
  }

  void Add(int triangle, const TriangleBox& box)
  {
    this->Visit(box, [&](std::int64_t bin) { this->Bins[bin].push_back(triangle); });
  }

  // With the box that it was added with.
  void Remove(int triangle, const TriangleBox& box)
  {
    this->Visit(box,
      [&](std::int64_t bin)
      {
        std::vector<int>& all = this->Bins[bin];
        *std::find(all.begin(), all.end(), triangle) = all.back();
        all.pop_back();
      });
  }

  // With those around, perhaps repeatedly.
  template <typename Take>
  void Find(const TriangleBox& box, const Take& take) const
  {
    this->Visit(box,
      [&](std::int64_t bin)
      {
        const auto found = this->Bins.find(bin);
        if (found != this->Bins.end())
        {
          std::for_each(found->second.begin(), found->second.end(), take);
        }
      });
  }

private:
  template <typename See>
  void Visit(const TriangleBox& box, const See& see) const
  {
    std::array<std::int64_t, 3> low;
    std::array<std::int64_t, 3> high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = static_cast<std::int64_t>(std::floor(box.Low[axis] / this->Size));
      high[axis] = static_cast<std::int64_t>(std::floor(box.High[axis] / this->Size));
    }
    constexpr std::int64_t stride = std::int64_t(1) << 20; // bins along an axis, and more collide
    for (std::int64_t k = low[2]; k <= high[2]; ++k)
    {
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
      {
        for (std::int64_t i = low[0]; i <= high[0]; ++i)
        {
          see((k * stride + j) * stride + i);
        }
      }
    }
  }

  const double Size;
  std::unordered_map<std::int64_t, std::vector<int>> Bins;
};

double DistanceToTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
  const Vector3d& c)
{
  const Vector3d normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  const auto isLeft = [&](const Vector3d& from, const Vector3d& to)
  { return (to - from).cross(p - from).dot(normal) >= 0; };
  if (squared > 0 && isLeft(a, b) && isLeft(b, c) && isLeft(c, a))
  {
    return std::abs((p - a).dot(normal)) / std::sqrt(squared);
  }
  const auto toEdge = [&p](const Vector3d& from, const Vector3d& to)
  {
    const Vector3d along = to - from;
    const double length = along.squaredNorm();
    const double part = length > 0 ? (p - from).dot(along) / length : 0;
    return (from + std::max(0.0, std::min(1.0, part)) * along - p).norm();
  };
  return std::min({ toEdge(a, b), toEdge(b, c), toEdge(c, a) });
}

double QualityOf(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / sides : 0;
}

class Collapser
{
public:
  Collapser(const CollapseSettings& settings, SharedWalls& walls, PointList& indices)
    : Settings(settings)
    , Walls(walls)
    , Indices(indices)
    , Alive(walls.Labels.size(), 1)
    , Stars(walls.Points.rows())
    , Stamps(walls.Points.rows(), 0)
    , Quadrics(walls.Points.rows(), Eigen::Matrix4d::Zero())
    , Gone(walls.Labels.size())
    , Count(static_cast<int>(walls.Labels.size()))
    , Before(walls.Points, walls.Triangles)
    , Bins(this->SizeOfBins())
    , Seen(walls.Labels.size(), -1)
  {
    for (int triangle = 0; triangle < this->Count; ++triangle)
    {
      this->Bins.Add(triangle, this->BoxOfTriangle(triangle));
      const Corners corners = this->At(triangle);
      const Vector3d a = this->Point(corners[0]);
      const Vector3d normal = (this->Point(corners[1]) - a).cross(this->Point(corners[2]) - a);
      const double twice = normal.norm();
      Eigen::Vector4d plane = Eigen::Vector4d::Zero();
      if (twice > 0)
      {
        plane << normal / twice, -normal.dot(a) / twice;
      }
      for (const int corner : corners)
      {
        this->Stars[corner].push_back(triangle);
        this->Quadrics[corner] += twice / 6 * plane * plane.transpose();
      }
    }
  }

  bool Run(const Monitor& monitor)
  {
    const int first = this->Count;
    const double toDo = std::max(1, first - this->Settings.Triangles);
    int before = 0;
    do
    {
      before = this->Count;
      if (!this->RunRound([&] { return monitor((first - this->Count) / toDo); }))
      {
        return false;
      }
    } while (this->Count > this->Settings.Triangles && this->Count < (1 - LeastProgress) * before);
    this->Compact();
    return true;
  }

private:
  struct Candidate
  {
    double Cost;
    int From;
    int To;
    std::array<int, 2> Stamps; // of the quadrics that it costs

    bool operator<(const Candidate& other) const // the queue has the greatest first
    {
      return std::tie(other.Cost, other.From, other.To) <
        std::tie(this->Cost, this->From, this->To);
    }
  };

  // What is refused may be allowed once its surroundings have changed, in the next round.
  template <typename Proceed>
  bool RunRound(const Proceed& proceed)
  {
    for (int vertex = 0; vertex < static_cast<int>(this->Stars.size()); ++vertex)
    {
      for (const Spoke& spoke : this->SpokesOf(vertex))
      {
        this->Push(vertex, spoke.Vertex);
      }
    }
    for (int turn = 0; !this->Queue.empty() && this->Count > this->Settings.Triangles; ++turn)
    {
      if (turn % QuestionInterval == 0 && !proceed())
      {
        return false;
      }
      const Candidate next = this->Queue.top();
      this->Queue.pop();
      if (next.Stamps == this->StampsOf(next.From, next.To) &&
        this->MayCollapse(next.From, next.To))
      {
        this->Collapse(next.From, next.To);
      }
    }
    return true;
  }

  // A neighbor of a vertex, and the triangles at the edge to it.
  struct Spoke
  {
    int Vertex;
    int Triangles = 0;
  };

  Vector3d Point(int vertex) const { return this->Walls.Points.row(vertex).transpose(); }
  Corners At(int triangle) const
  {
    const int* const row = this->Walls.Triangles.row(triangle).data();
    return { { row[0], row[1], row[2] } };
  }
  TriangleBox BoxOfTriangle(int triangle) const
  {
    return BoxOf(this->Walls.Points, this->At(triangle));
  }
  std::array<int, 2> StampsOf(int one, int two) const
  {
    return { { this->Stamps[one], this->Stamps[two] } };
  }

  double SizeOfBins() const
  {
    double sum = 0;
    for (Eigen::Index triangle = 0; triangle < this->Walls.Triangles.rows(); ++triangle)
    {
      const Corners corners = this->At(static_cast<int>(triangle));
      sum += (this->Point(corners[0]) - this->Point(corners[1])).norm();
    }
    constexpr double edges = 3;
    return std::max<double>(edges * sum / std::max<Eigen::Index>(1, this->Walls.Triangles.rows()),
      std::numeric_limits<float>::min());
  }

  std::vector<Spoke> SpokesOf(int vertex) const
  {
    std::vector<Spoke> spokes;
    for (const int triangle : this->Stars[vertex])
    {
      for (const int other : OthersOf(this->At(triangle), vertex))
      {
        auto found = std::find_if(spokes.begin(), spokes.end(),
          [other](const Spoke& spoke) { return spoke.Vertex == other; });
        if (found == spokes.end())
        {
          found = spokes.insert(spokes.end(), { other, 0 });
        }
        ++found->Triangles;
      }
    }
    return spokes;
  }

  void Push(int from, int to)
  {
    const Vector3d place = this->Point(to);
    const double length = (this->Point(from) - place).norm();
    if (this->Settings.EdgeLength > 0 && length > this->Settings.EdgeLength)
    {
      return;
    }
    const Eigen::Vector4d at = place.homogeneous();
    const double cost = at.dot(this->Quadrics[from] * at) + at.dot(this->Quadrics[to] * at) +
      WeightOfLength * length * length * length * length;
    this->Queue.push({ cost, from, to, this->StampsOf(from, to) });
  }

  bool MayCollapse(int from, int to)
  {
    return this->KeepsTopology(from, to) && this->KeepsShape(from, to) &&
      this->KeepsVoxels(from, to) && this->KeepsTolerance(from, to) && this->KeepsApart(from, to);
  }

  bool KeepsTopology(int from, int to) const
  {
    const std::vector<Spoke> spokes = this->SpokesOf(from);
    const std::vector<Spoke> others = this->SpokesOf(to);
    const auto curve = [](const Spoke& spoke) { return spoke.Triangles != 2; };
    const auto onCurves = std::count_if(spokes.begin(), spokes.end(), curve);
    const auto edge = std::find_if(spokes.begin(), spokes.end(),
      [to](const Spoke& spoke) { return spoke.Vertex == to; });
    if (edge == spokes.end() || (onCurves != 0 && (onCurves != 2 || !curve(*edge))) ||
      (onCurves == 0 && !this->IsOneFan(from, spokes.size())))
    {
      return false;
    }
    const auto isSpoke = [](const std::vector<Spoke>& all, int vertex, bool ofCurve)
    {
      return std::any_of(all.begin(), all.end(),
        [&](const Spoke& spoke)
        { return spoke.Vertex == vertex && (!ofCurve || spoke.Triangles != 2); });
    };
    int common = 0;
    for (const Spoke& spoke : spokes)
    {
      common += isSpoke(others, spoke.Vertex, false) ? 1 : 0;
      // A curve of three edges would become one of two.
      if (onCurves != 0 && curve(spoke) && isSpoke(others, spoke.Vertex, true))
      {
        return false;
      }
    }
    return common == edge->Triangles &&
      std::none_of(this->Stars[from].begin(), this->Stars[from].end(),
        [&](int triangle)
        {
          const auto [one, two] = OthersOf(this->At(triangle), from);
          return one != to && two != to && this->HasTriangle(to, one, two);
        });
  }

  bool HasTriangle(int vertex, int one, int two) const
  {
    return std::any_of(this->Stars[vertex].begin(), this->Stars[vertex].end(),
      [&](int triangle)
      {
        const Corners corners = this->At(triangle);
        return HasCorner(corners, one) && HasCorner(corners, two);
      });
  }

  bool IsOneFan(int vertex, std::size_t size) const
  {
    const std::vector<int>& star = this->Stars[vertex];
    const auto [first, second] = OthersOf(this->At(star.front()), vertex);
    int now = second;
    int last = star.front();
    std::size_t turns = 1;
    while (now != first && turns <= size)
    {
      const int at = now;
      const int before = last;
      const auto next = std::find_if(star.begin(), star.end(),
        [&](int triangle) { return triangle != before && HasCorner(this->At(triangle), at); });
      if (next == star.end())
      {
        return false;
      }
      const auto others = OthersOf(this->At(*next), vertex);
      last = *next;
      now = others[0] == at ? others[1] : others[0];
      ++turns;
    }
    return turns == size && turns == star.size();
  }

  // Calls test(triangle, one, two) for the triangles that move, with their other corners.
  template <typename Test>
  bool AllMoving(int from, int to, const Test& test) const
  {
    return std::all_of(this->Stars[from].begin(), this->Stars[from].end(),
      [&](int triangle)
      {
        const Corners corners = this->At(triangle);
        const auto others = OthersOf(corners, from);
        return HasCorner(corners, to) || test(triangle, others[0], others[1]);
      });
  }

  bool KeepsShape(int from, int to) const
  {
    const Vector3d u = this->Point(from);
    const Vector3d v = this->Point(to);
    double worst = 1;
    for (const int triangle : this->Stars[from])
    {
      const auto [one, two] = OthersOf(this->At(triangle), from);
      worst = std::min(worst, QualityOf(u, this->Point(one), this->Point(two)));
    }
    return this->AllMoving(from, to,
      [&](int /*triangle*/, int one, int two)
      {
        const Vector3d a = this->Point(one);
        const Vector3d b = this->Point(two);
        const Vector3d before = (a - u).cross(b - u);
        const Vector3d after = (a - v).cross(b - v);
        const double longest = this->Settings.EdgeLength;
        return QualityOf(v, a, b) >= std::min(worst, LeastQuality) && after.squaredNorm() > 0 &&
          before.dot(after) >= LeastTurn * before.norm() * after.norm() &&
          (longest <= 0 || ((a - v).norm() <= longest && (b - v).norm() <= longest));
      });
  }

  // The vertices that have gone at the moving triangles, and the one that goes, with their walls.
  template <typename Take>
  void VisitGone(int from, const Take& take) const
  {
    for (const int triangle : this->Stars[from])
    {
      take(from, triangle);
      for (const int vertex : this->Gone[triangle])
      {
        take(vertex, triangle);
      }
    }
  }

  // The new triangle of the same wall that is nearest to a vertex that has gone.
  struct Nearest
  {
    double Distance = std::numeric_limits<double>::infinity();
    int Triangle = -1;
  };
  Nearest NearestTo(int vertex, int wallOf, int from, int to) const
  {
    Nearest nearest;
    const Vector3d p = this->Point(vertex);
    const Vector3d v = this->Point(to);
    this->AllMoving(from, to,
      [&](int triangle, int one, int two)
      {
        if (this->Walls.Labels[triangle] == this->Walls.Labels[wallOf])
        {
          const double distance = DistanceToTriangle(p, v, this->Point(one), this->Point(two));
          if (distance < nearest.Distance)
          {
            nearest = { distance, triangle };
          }
        }
        return true;
      });
    return nearest;
  }

  bool KeepsTolerance(int from, int to) const
  {
    bool keeps = true;
    this->VisitGone(from,
      [&](int vertex, int triangle)
      {
        keeps =
          keeps && this->NearestTo(vertex, triangle, from, to).Distance <= this->Settings.Tolerance;
      });
    return keeps && this->AreNearBefore(from, to);
  }

  // The middles of new edges and triangles, to the walls as they were.
  bool AreNearBefore(int from, int to) const
  {
    std::vector<Vector3d> samples;
    const Vector3d v = this->Point(to);
    this->AllMoving(from, to,
      [&](int /*triangle*/, int one, int two)
      {
        const Vector3d a = this->Point(one);
        const Vector3d b = this->Point(two);
        samples.insert(samples.end(), { (v + a) / 2, (v + b) / 2, (v + a + b) / 3 });
        return true;
      });
    PointList points(static_cast<Eigen::Index>(samples.size()), 3);
    for (std::size_t sample = 0; sample < samples.size(); ++sample)
    {
      points.row(static_cast<Eigen::Index>(sample)) = samples[sample].transpose();
    }
    return points.rows() == 0 ||
      this->Before.DistancesOf(points).maxCoeff() <= this->Settings.Tolerance;
  }

  bool KeepsVoxels(int from, int to) const
  {
    return !this->Settings.KeepVoxels ||
      this->AllMoving(from, to,
        [&](int /*triangle*/, int one, int two) {
          return this->IsFreeOfCenters({ { from, to, one, two } });
        });
  }

  bool IsFreeOfCenters(const std::array<int, 4>& tetrahedron) const
  {
    HullCorners hull;
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d high = -low;
    for (int corner = 0; corner < 4; ++corner)
    {
      hull[corner] = this->Indices.row(tetrahedron[corner]).transpose();
      low = low.cwiseMin(hull[corner]);
      high = high.cwiseMax(hull[corner]);
    }
    low = (low.array() - CenterClearance).ceil();
    high = (high.array() + CenterClearance).floor();
    for (double k = low[2]; k <= high[2]; ++k)
    {
      for (double j = low[1]; j <= high[1]; ++j)
      {
        for (double i = low[0]; i <= high[0]; ++i)
        {
          const Vector3d center(i, j, k);
          if (!(ProvenDistance(hull, { { center, center, center, center } }) > CenterClearance))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

  bool KeepsApart(int from, int to)
  {
    std::vector<Hull> swept;
    std::vector<Hull> moved;
    TriangleBox all;
    this->AllMoving(from, to,
      [&](int /*triangle*/, int one, int two)
      {
        swept.push_back({ { from, to, one, two } });
        moved.push_back({ { to, one, two, two } });
        all.Merge(BoxOf(this->Walls.Points, swept.back()));
        return true;
      });
    for (std::size_t one = 0; one < moved.size(); ++one)
    {
      for (std::size_t two = one + 1; two < moved.size(); ++two)
      {
        if (!this->MeetOnlyInCommon(moved[one], moved[two]))
        {
          return false;
        }
      }
    }
    bool apart = true;
    ++this->Search;
    this->Bins.Find(all,
      [&](int triangle)
      {
        if (!apart || this->Seen[triangle] == this->Search)
        {
          return;
        }
        this->Seen[triangle] = this->Search;
        const Corners corners = this->At(triangle);
        if (HasCorner(corners, from))
        {
          return;
        }
        const Hull hull{ { corners[0], corners[1], corners[2], corners[2] } };
        apart = std::all_of(swept.begin(), swept.end(),
          [&](const Hull& tetrahedron) { return this->MeetOnlyInCommon(tetrahedron, hull); });
      });
    return apart;
  }

  // By the claim of FaceHulls.h: for each subset of the common vertices, one hull with these and
  // the other one without are apart.
  bool MeetOnlyInCommon(const Hull& one, const Hull& two) const
  {
    if (!BoxOf(this->Walls.Points, one).Touches(BoxOf(this->Walls.Points, two)))
    {
      return true;
    }
    const auto distinct = [](const Hull& hull)
    {
      std::vector<int> corners(hull.begin(), hull.end());
      if (hull[3] == hull[2])
      {
        corners.pop_back();
      }
      return corners;
    };
    const std::vector<int> ofOne = distinct(one);
    const std::vector<int> ofTwo = distinct(two);
    std::vector<int> common;
    std::vector<int> rest;
    for (const int corner : ofOne)
    {
      const bool isCommon = std::find(ofTwo.begin(), ofTwo.end(), corner) != ofTwo.end();
      (isCommon ? common : rest).push_back(corner);
    }
    if (common.size() > 2)
    {
      return false;
    }
    for (unsigned int subset = 0; subset < 1U << common.size(); ++subset)
    {
      std::vector<int> first = rest;
      std::vector<int> second;
      for (std::size_t i = 0; i < common.size(); ++i)
      {
        if ((subset >> i & 1U) != 0)
        {
          first.push_back(common[i]);
        }
      }
      std::copy_if(ofTwo.begin(), ofTwo.end(), std::back_inserter(second),
        [&first](int corner)
        { return std::find(first.begin(), first.end(), corner) == first.end(); });
      if (!first.empty() && !second.empty() &&
        HullsMeet(this->Walls.Points, HullOf(first), HullOf(second)))
      {
        return false;
      }
    }
    return true;
  }

  static Hull HullOf(const std::vector<int>& corners)
  {
    Hull hull;
    for (std::size_t i = 0; i < hull.size(); ++i)
    {
      hull[i] = corners[std::min(i, corners.size() - 1)];
    }
    return hull;
  }

  void Collapse(int from, int to)
  {
    std::vector<std::pair<int, int>> kept; // a vertex that has gone, and the triangle in its place
    this->VisitGone(from,
      [&](int vertex, int triangle)
      { kept.emplace_back(vertex, this->NearestTo(vertex, triangle, from, to).Triangle); });
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (const int triangle : this->Stars[from])
    {
      this->Gone[triangle].clear();
      this->Bins.Remove(triangle, this->BoxOfTriangle(triangle));
      if (HasCorner(this->At(triangle), to))
      {
        this->Remove(triangle, from);
        continue;
      }
      for (int corner = 0; corner < 3; ++corner)
      {
        int& vertex = this->Walls.Triangles(triangle, corner);
        vertex = vertex == from ? to : vertex;
      }
      this->Stars[to].push_back(triangle);
      this->Bins.Add(triangle, this->BoxOfTriangle(triangle));
    }
    for (const auto& [vertex, triangle] : kept)
    {
      this->Gone[triangle].push_back(vertex);
    }
    this->Quadrics[to] += this->Quadrics[from];
    this->Stars[from].clear();
    ++this->Stamps[to];
    for (const Spoke& spoke : this->SpokesOf(to))
    {
      this->Push(spoke.Vertex, to);
      this->Push(to, spoke.Vertex);
    }
  }

  void Remove(int triangle, int from)
  {
    this->Alive[triangle] = 0;
    --this->Count;
    for (const int corner : this->At(triangle))
    {
      if (corner != from)
      {
        auto& star = this->Stars[corner];
        star.erase(std::find(star.begin(), star.end(), triangle));
      }
    }
  }

  void Compact()
  {
    std::vector<int> number(this->Stars.size(), -1);
    Eigen::Index points = 0;
    for (std::size_t vertex = 0; vertex < number.size(); ++vertex)
    {
      if (!this->Stars[vertex].empty())
      {
        this->Walls.Points.row(points) = this->Walls.Points.row(static_cast<Eigen::Index>(vertex));
        this->Indices.row(points) = this->Indices.row(static_cast<Eigen::Index>(vertex));
        number[vertex] = static_cast<int>(points++);
      }
    }
    this->Walls.Points.conservativeResize(points, 3);
    this->Indices.conservativeResize(points, 3);
    Eigen::Index rows = 0;
    for (std::size_t triangle = 0; triangle < this->Alive.size(); ++triangle)
    {
      if (this->Alive[triangle])
      {
        const Corners corners = this->At(static_cast<int>(triangle));
        this->Walls.Labels[rows] = this->Walls.Labels[triangle];
        this->Walls.Triangles.row(rows++) << number[corners[0]], number[corners[1]],
          number[corners[2]];
      }
    }
    this->Walls.Triangles.conservativeResize(rows, 3);
    this->Walls.Labels.resize(rows);
  }

  const CollapseSettings& Settings;
  SharedWalls& Walls;
  PointList& Indices;
  std::vector<char> Alive;             // triangles
  std::vector<std::vector<int>> Stars; // triangles, by vertex
  std::vector<int> Stamps;             // of quadrics
  std::vector<Eigen::Matrix4d> Quadrics;
  std::vector<std::vector<int>> Gone; // vertices that triangles have taken the place of
  int Count;
  const DistanceQuery Before; // of the walls as they were
  TriangleBins Bins;
  std::vector<int> Seen; // the latest search that has seen a triangle
  int Search = 0;
  std::priority_queue<Candidate> Queue;
};

} // namespace

bool CollapseWalls(const CollapseSettings& settings, const Monitor& monitor, SharedWalls& walls,
  PointList& indices)
{
  return Collapser(settings, walls, indices).Run(monitor);
}

double CollapseDistance(const SharedWalls& before, const SharedWalls& after,
  const ParallelFor& parallelFor)
{
  PointList middles(4 * after.Triangles.rows(), 3);
  for (Eigen::Index triangle = 0; triangle < after.Triangles.rows(); ++triangle)
  {
    const auto at = [&](int corner) -> Eigen::RowVector3d
    { return after.Points.row(after.Triangles(triangle, corner)); };
    middles.middleRows<4>(4 * triangle) << (at(0) + at(1)) / 2, (at(1) + at(2)) / 2,
      (at(2) + at(0)) / 2, (at(0) + at(1) + at(2)) / 3;
  }
  const auto greatest = [&](const PointList& points, const SharedWalls& walls)
  {
    const DistanceQuery query(walls.Points, walls.Triangles);
    Eigen::VectorXd distances(points.rows());
    parallelFor(0, points.rows(),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        distances.segment(first, last - first) =
          query.DistancesOf(points.middleRows(first, last - first));
      });
    return distances.maxCoeff();
  };
  return std::max(greatest(before.Points, after), greatest(middles, before));
}

} // namespace FlipFree
