#include "Guard/EmbeddingGuard.h"

#include "Geometry/TriangleIntersection.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace FlipFree
{
namespace
{

// Relative to the mean edge length.
constexpr double RelativeGap = 1e-3;

// Of the greatest coordinate: well above the rounding errors of positions and distances.
constexpr double RelativeResolution = 1e-12;

// In millimeters; boxes of motions are kept in single precision.
constexpr double MaximumPosition = 1e30;

// Longer displacements, in units of the surface's extent, are cut first: they are errors of the
// caller, and the rounding errors of their ends must not spoil the rest.
constexpr double MaximumDisplacement = 100;

// What fails keeps this part of the motion that was certain: the more must be taken off, the sooner
// it is done. But it keeps no more than the greatest part of its motion, and no less than the
// least: a vertex that others push into may well be able to move once they are held back.
constexpr double SafetyFactor = 0.9;
constexpr double MaximumPart = 0.5;
constexpr double MinimumPart = 0.12;

// Below this fraction of its displacement a vertex is not moved at all.
constexpr double MinimumScale = 1.0 / 64;

// By how much farther a neighbor's scale may carry it, in mean edge lengths: a region whose motion
// is long is held back as a whole, instead of being sheared where the scale changes.
constexpr double MaximumShear = 0.25;

// A motion is short when it takes the vertices no farther than this on average, in mean edge
// lengths: then few pairs are near enough to meet wherever their vertices are held on their ways.
// Either way the result is as certain; on real organs the guard took the least processor time with
// this.
constexpr double ShortMotion = 0.3;

std::vector<std::array<int, 3>> ListCorners(const FaceList& faces)
{
  std::vector<std::array<int, 3>> corners;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* const vertices = faces.Face(face);
    const int size = faces.FaceSize(face);
    // The corners of a triangle are all the same; the triangles that a larger face is cut into are
    // corners of it, except the middle ones of a fan.
    for (int corner = 0; corner < (size == 3 ? 1 : size); ++corner)
    {
      corners.push_back({ { vertices[(corner + size - 1) % size], vertices[corner],
        vertices[(corner + 1) % size] } });
    }
    for (int corner = 3; corner < size - 1; ++corner)
    {
      corners.push_back({ { vertices[0], vertices[corner - 1], vertices[corner] } });
    }
  }
  return corners;
}

// Some of the vertices; all of them at first.
struct ChangedVertices
{
  explicit ChangedVertices(Eigen::Index count)
    : Contains(count, 1)
  {
  }
  void Add(int vertex)
  {
    if (!this->Contains[vertex])
    {
      this->Contains[vertex] = 1;
      this->Vertices.push_back(vertex);
    }
  }
  void Clear()
  {
    if (this->AreAll)
    {
      std::fill(this->Contains.begin(), this->Contains.end(), 0);
    }
    for (int vertex : this->Vertices)
    {
      this->Contains[vertex] = 0;
    }
    this->Vertices.clear();
    this->AreAll = false;
  }
  // The first of them among these.
  int FirstOf(const std::array<int, 3>& vertices) const
  {
    for (int vertex : vertices)
    {
      if (this->Contains[vertex])
      {
        return vertex;
      }
    }
    return -1;
  }

  bool AreAll = true;
  std::vector<char> Contains; // per vertex
  std::vector<int> Vertices;  // unless they are all
};

template <std::size_t N>
bool AnyOf(const std::vector<char>& flags, const std::array<int, N>& vertices)
{
  return std::any_of(vertices.begin(), vertices.end(),
    [&](int vertex) { return flags[vertex] != 0; });
}

// Lowers limits from several threads at once. The least of them is the same in any order.
template <std::size_t N>
void Lower(std::vector<std::atomic<double>>& limits, const std::array<int, N>& vertices,
  double limit)
{
  for (int vertex : vertices)
  {
    double present = limits[vertex].load(std::memory_order_relaxed);
    while (limit < present &&
      !limits[vertex].compare_exchange_weak(present, limit, std::memory_order_relaxed))
    {
    }
  }
}

template <typename Item, typename Visit>
void ForEach(const std::vector<Item>& items, const ParallelFor& parallelFor, const Visit& visit)
{
  parallelFor(0, static_cast<std::ptrdiff_t>(items.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    { std::for_each(items.begin() + first, items.begin() + last, visit); });
}

} // namespace

// The motion that is being certified.
struct EmbeddingGuard::Attempt
{
  Attempt(const PointList& points, const PointList& displacements)
    : From(points)
    , Wanted(displacements)
    , Scales(points.rows(), 1.0)
    , ShearSteps(points.rows(), -1.0)
    , IsChanged(points.rows(), 0)
    , SafeUntil(points.rows())
    , IsDoubtful(points.rows())
    , Rough(points.rows(), points.row(0))
    , ChangedForCorners(points.rows())
    , ChangedForPairs(points.rows())
  {
    std::fill(this->SafeUntil.begin(), this->SafeUntil.end(), 1.0);
  }
  Motion Path() const { return { this->From, this->To }; }

  template <std::size_t N>
  void Doubt(const std::array<int, N>& vertices)
  {
    for (int vertex : vertices)
    {
      this->IsDoubtful[vertex].store(1, std::memory_order_relaxed);
    }
  }

  // The time from which on it makes no difference until when these two triangles stay apart,
  // because all their vertices are held back by others that far.
  double EnoughFor(const std::array<int, 3>& one, const std::array<int, 3>& two) const
  {
    double latest = -1;
    for (const auto* triangle : { &one, &two })
    {
      for (int vertex : *triangle)
      {
        if (this->Scales[vertex] > 0)
        {
          latest = std::max(latest, this->SafeUntil[vertex].load(std::memory_order_relaxed));
        }
      }
    }
    // A motion that ends sooner, or later, than at these times is cut to the same part.
    constexpr double last = MaximumPart / SafetyFactor;
    return latest < 0 || latest >= 1         ? 1.0
      : latest * SafetyFactor <= MinimumPart ? 0.0
                                             : std::min(latest, last);
  }

  // These two parts are not known to be apart for longer than that; not even at the start when it
  // is negative.
  template <std::size_t A, std::size_t B>
  void Blame(const std::array<int, A>& one, const std::array<int, B>& two, double until)
  {
    this->PairsAreClean = false;
    if (until < 0)
    {
      this->IsStartInDoubt = true;
      this->Doubt(one);
      this->Doubt(two);
    }
    Lower(this->SafeUntil, one, std::max(until, 0.0));
    Lower(this->SafeUntil, two, std::max(until, 0.0));
  }

  const PointList& From;
  PointList Wanted;
  PointList Scaled;
  PointList To;
  double EdgeLength = 0; // mean
  MotionGap Gap;
  std::vector<double> Scales;
  // By how much a vertex's scale may exceed its neighbors'; negative until it is asked for.
  std::vector<double> ShearSteps;
  std::vector<char> IsChanged; // while scales are lowered; per vertex
  // The part of the motion that the present pass has found certain.
  std::vector<std::atomic<double>> SafeUntil;
  std::atomic<bool> PairsAreClean{ true }; // in the present pass
  // Parts were found not to be apart at the start, or vertices held back before that was looked at.
  std::atomic<bool> IsStartInDoubt{ false };
  std::vector<std::atomic<char>> IsDoubtful; // per vertex

  // Vertices whose path changed since a part of the test was last run.
  RoughMotion Rough;
  ChangedVertices ChangedForCorners;
  ChangedVertices ChangedForPairs;

  bool IsShort = false;
  std::vector<MotionBox> VertexBoxes; // of a motion that is not short
  PairMemory Memory;
};

// Lends the guard's spare memory to an attempt, and takes it back however that ends.
class EmbeddingGuard::MemoryLoan
{
public:
  MemoryLoan(const EmbeddingGuard& guard, Attempt& attempt)
    : Guard(guard)
    , Memory(attempt.Memory)
  {
    this->Exchange();
  }
  ~MemoryLoan() { this->Exchange(); }
  MemoryLoan(const MemoryLoan&) = delete;
  MemoryLoan& operator=(const MemoryLoan&) = delete;

private:
  void Exchange()
  {
    const std::lock_guard<std::mutex> lock(this->Guard.SpareMutex);
    std::swap(this->Memory, this->Guard.Spare);
  }

  const EmbeddingGuard& Guard;
  PairMemory& Memory;
};

EmbeddingGuard::EmbeddingGuard(const ContourMesh& mesh)
  : Neighbors(mesh.Neighbors)
  , Triangles(mesh.Triangles)
  , Corners(ListCorners(mesh.Faces))
  , CornersAt(mesh.NumberOfPoints(), static_cast<int>(this->Corners.size()),
      [this](int corner, int i) { return this->Corners[corner][i]; })
  , TrianglesAt(mesh.NumberOfPoints(), static_cast<int>(mesh.Triangles.rows()),
      [&mesh](int triangle, int i) { return mesh.Triangles(triangle, i); })
  , WithoutStrangers(ListPairsWithoutStrangers(mesh.NumberOfPoints(), mesh.Triangles))
  , Layout(TriangleTree::TopologicalLayout(mesh.NumberOfPoints(), mesh.Triangles))
  , Tree(this->Layout, mesh.Triangles)
  , Strangers(this->Tree.PartnersOf(this->Tree.PairsOfStrangers(this->Layout, mesh.Triangles)))
{
}

GuardReport EmbeddingGuard::Limit(const PointList& points, PointList& displacements,
  const ParallelFor& parallelFor, const Monitor& monitor) const
{
  this->RequireFinite(points, "position", MaximumPosition);
  this->RequireFinite(displacements, "displacement", std::numeric_limits<double>::max());

  Attempt attempt(points, displacements);
  GuardReport report;
  const double extent = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  const double greatest = MaximumDisplacement * extent;
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    const double length = displacements.row(vertex).lpNorm<Eigen::Infinity>();
    if (length > greatest)
    {
      attempt.Wanted.row(vertex) *= greatest / length;
    }
  }
  attempt.Scaled = attempt.Wanted;
  attempt.To = points + attempt.Scaled;
  attempt.EdgeLength = this->MeanEdgeLength(points);
  attempt.Gap.Resolution = RelativeResolution * (points.cwiseAbs().maxCoeff() + greatest);
  attempt.Gap.Wanted = std::max(RelativeGap * attempt.EdgeLength, 2 * attempt.Gap.Resolution);

  const MemoryLoan loan(*this, attempt);
  while (true)
  {
    ++report.Passes;
    if (this->TestCorners(attempt, parallelFor) && this->TestPairs(attempt, parallelFor))
    {
      break;
    }
    if (!monitor(1 - 1.0 / report.Passes))
    {
      displacements.setZero();
      return report;
    }
    this->ScaleBack(attempt);
  }

  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    report.HeldBack += attempt.Scaled.row(vertex) != displacements.row(vertex) ? 1 : 0;
  }
  // If the start has a defect, it is where nothing could move.
  if (attempt.IsStartInDoubt)
  {
    const std::vector<char> doubtful(attempt.IsDoubtful.begin(), attempt.IsDoubtful.end());
    this->RequireEmbeddedNear(points, doubtful, parallelFor);
  }
  displacements = attempt.Scaled;
  return report;
}

void EmbeddingGuard::RequireEmbedded(const PointList& points, const ParallelFor& parallelFor) const
{
  this->RequireFinite(points, "position", MaximumPosition);
  this->RequireEmbeddedNear(points, std::vector<char>(points.rows(), 1), parallelFor);
}

void EmbeddingGuard::RequireFinite(const PointList& points, const char* what, double greatest) const
{
  if (points.rows() != static_cast<Eigen::Index>(this->Neighbors.size()))
  {
    throw std::invalid_argument("The guard was made for a mesh of " +
      std::to_string(this->Neighbors.size()) + " vertices and got one " + what + " for each of " +
      std::to_string(points.rows()));
  }
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    if (!points.row(vertex).allFinite() || points.row(vertex).cwiseAbs().maxCoeff() > greatest)
    {
      throw std::invalid_argument("The " + std::string(what) + " of vertex " +
        std::to_string(vertex) +
        " is not finite, or too large to be computed with; check the image and the surface it "
        "comes "
        "from");
    }
  }
}

void EmbeddingGuard::RequireEmbeddedNear(const PointList& points, const std::vector<char>& vertices,
  const ParallelFor& parallelFor) const
{
  const std::vector<TriangleBox> boxes = this->Tree.RefitBoxes(points, this->Triangles);
  std::vector<int> triangles;
  for (int triangle = 0; triangle < this->Triangles.rows(); ++triangle)
  {
    if (AnyOf(vertices, this->Triangle(triangle)))
    {
      triangles.push_back(triangle);
    }
  }
  const std::vector<char> flags = this->Tree.NodesAbove(triangles).Contains;
  const auto pairs = this->Tree.SelfPairs([&](int node, int other)
    { return (flags[node] || flags[other]) && boxes[node].Touches(boxes[other]); },
    [&](int one, int two) { return TrianglesIntersect(points, this->Triangles, one, two); },
    parallelFor);
  if (pairs.empty())
  {
    return;
  }
  const auto first = *std::min_element(pairs.begin(), pairs.end());
  const std::array<int, 3> one = this->Triangle(first.first);
  const std::array<int, 3> two = this->Triangle(first.second);
  std::ostringstream message;
  message << "The surface intersects itself before it is moved, in " << pairs.size()
          << " pairs of triangles; the first are those of the vertices (" << one[0] << ", "
          << one[1] << ", " << one[2] << ") and (" << two[0] << ", " << two[1] << ", " << two[2]
          << "), near (" << points(one[0], 0) << ", " << points(one[0], 1) << ", "
          << points(one[0], 2) << "); start from a surface without self-intersections";
  throw std::invalid_argument(message.str());
}

double EmbeddingGuard::MeanEdgeLength(const PointList& points) const
{
  double sum = 0;
  for (std::size_t vertex = 0; vertex < this->Neighbors.size(); ++vertex)
  {
    for (int neighbor : this->Neighbors[vertex])
    {
      sum += (points.row(vertex) - points.row(neighbor)).norm();
    }
  }
  return sum / (4.0 * this->Neighbors.size());
}

bool EmbeddingGuard::TestCorners(Attempt& attempt, const ParallelFor& parallelFor) const
{
  const Motion motion = attempt.Path();
  std::atomic<bool> isClean{ true };
  const auto test = [&](const Corner& corner)
  {
    const double until = UprightUntil(motion, corner);
    if (!(until >= 1))
    {
      isClean = false;
      Lower(attempt.SafeUntil, corner, until);
    }
  };
  // At first everything has changed; later it is little, and a pass costs as little.
  ChangedVertices& changed = attempt.ChangedForCorners;
  if (changed.AreAll)
  {
    ForEach(this->Corners, parallelFor, test);
  }
  else
  {
    ForEach(changed.Vertices, parallelFor,
      [&](int vertex)
      {
        this->CornersAt.ForEachAt(vertex,
          [&](int index)
          {
            if (changed.FirstOf(this->Corners[index]) == vertex)
            {
              test(this->Corners[index]);
            }
          });
      });
  }
  changed.Clear();
  return isClean;
}

bool EmbeddingGuard::TestPairs(Attempt& attempt, const ParallelFor& parallelFor) const
{
  const Motion motion = attempt.Path();
  ChangedVertices& changed = attempt.ChangedForPairs;
  if (changed.AreAll)
  {
    // Corners have held these back; where nothing moves, nothing is asked about the start.
    for (std::size_t vertex = 0; vertex < attempt.Scales.size(); ++vertex)
    {
      if (attempt.Scales[vertex] == 0)
      {
        attempt.IsStartInDoubt = true;
        attempt.IsDoubtful[vertex] = 1;
      }
    }
    attempt.IsShort =
      (motion.To - motion.From).rowwise().norm().mean() <= ShortMotion * attempt.EdgeLength;
    parallelFor(0, motion.From.rows(),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
        {
          attempt.Rough.Update(motion, static_cast<int>(vertex));
        }
      });
  }
  std::vector<int> triangles; // that changed, unless all did
  for (int vertex : changed.Vertices)
  {
    attempt.Rough.Update(motion, vertex);
    this->TrianglesAt.ForEachAt(vertex, [&](int triangle) { triangles.push_back(triangle); });
  }
  attempt.PairsAreClean = true;
  if (attempt.IsShort)
  {
    this->TestPairsOfShortMotion(attempt, triangles, parallelFor);
  }
  else
  {
    this->TestPairsOfLongMotion(attempt, triangles, parallelFor);
  }
  this->TestPairsWithoutStrangers(attempt, parallelFor);
  changed.Clear();
  return attempt.PairsAreClean;
}

void EmbeddingGuard::TestPairsOfShortMotion(Attempt& attempt, const std::vector<int>& triangles,
  const ParallelFor& parallelFor) const
{
  if (attempt.ChangedForPairs.AreAll)
  {
    const float margin = static_cast<float>(attempt.Gap.Wanted / 2 * (1 + 1e-6));
    std::vector<SweptBox>& boxes = attempt.Memory.SweptBoxes;
    this->Tree.Refit(
      boxes,
      [&](int triangle) { return SweptBox(attempt.Rough, this->Triangle(triangle), margin); },
      parallelFor);
    const auto meet = [&boxes](int node, int other)
    { return !boxes[node].IsApartFrom(boxes[other]); };
    // As many parts for any number of threads.
    constexpr int parts = 64;
    const auto firstNode = [this](std::ptrdiff_t part)
    { return static_cast<int>(this->Tree.NumberOfNodes() * part / parts); };
    std::vector<std::vector<TrianglePair>>& unsettled = attempt.Memory.Unsettled;
    unsettled.resize(parts);
    parallelFor(0, parts,
      [&](std::ptrdiff_t firstPart, std::ptrdiff_t lastPart)
      {
        for (std::ptrdiff_t part = firstPart; part < lastPart; ++part)
        {
          unsettled[part].clear();
          const auto test = [&](int one, int two)
          {
            if (!this->Settle(attempt, { one, two }))
            {
              unsettled[part].emplace_back(one, two);
            }
          };
          this->Tree.VisitPairsBelow(this->Strangers, firstNode(part), firstNode(part + 1), meet,
            test);
        }
      });
    return;
  }
  std::vector<char> isChanged(this->Triangles.rows(), 0);
  for (int triangle : triangles)
  {
    isChanged[triangle] = 1;
  }
  ForEach(attempt.Memory.Unsettled, parallelFor,
    [&](const std::vector<TrianglePair>& pairs)
    {
      for (const TrianglePair& pair : pairs)
      {
        if (isChanged[pair.first] || isChanged[pair.second])
        {
          this->Settle(attempt, pair);
        }
      }
    });
}

void EmbeddingGuard::TestPairsOfLongMotion(Attempt& attempt, const std::vector<int>& triangles,
  const ParallelFor& parallelFor) const
{
  const Motion motion = attempt.Path();
  const double margin = attempt.Gap.Wanted / 2;
  std::vector<MotionBox>& vertexBoxes = attempt.VertexBoxes;
  std::vector<MotionBox>& boxes = attempt.Memory.MotionBoxes;
  const auto boxOf = [&](int triangle)
  {
    MotionBox box = vertexBoxes[this->Triangles(triangle, 0)];
    box.Merge(vertexBoxes[this->Triangles(triangle, 1)]);
    box.Merge(vertexBoxes[this->Triangles(triangle, 2)]);
    return box;
  };
  const auto meet = [&boxes](int node, int other)
  { return !boxes[node].StaysApartFrom(boxes[other]); };
  const auto test = [&](int one, int two) { this->Settle(attempt, { one, two }); };
  if (attempt.ChangedForPairs.AreAll)
  {
    vertexBoxes.resize(motion.From.rows());
    parallelFor(0, motion.From.rows(),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
        {
          vertexBoxes[vertex] = MotionBox(motion, static_cast<int>(vertex), margin);
        }
      });
    this->Tree.Refit(boxes, boxOf, parallelFor);
    this->Tree.VisitPairsBelow(this->Strangers, meet, test, parallelFor);
  }
  else
  {
    for (int vertex : attempt.ChangedForPairs.Vertices)
    {
      vertexBoxes[vertex] = MotionBox(motion, vertex, margin);
    }
    const TriangleTree::NodeSet nodes = this->Tree.NodesAbove(triangles);
    this->Tree.RefitSome(boxes, boxOf, nodes, parallelFor);
    this->Tree.VisitSomePairsBelow(this->Strangers, nodes, meet, test, parallelFor);
  }
}

bool EmbeddingGuard::Settle(Attempt& attempt, const TrianglePair& pair) const
{
  const std::array<int, 3> one = this->Triangle(pair.first);
  const std::array<int, 3> two = this->Triangle(pair.second);
  const QuickProof proof = ProveApart(attempt.Rough, one, two, attempt.Gap.Wanted);
  if (proof >= QuickProof::ApartThroughout)
  {
    return proof == QuickProof::ApartOnAnyPart;
  }
  const double enough = attempt.EnoughFor(one, two);
  if (enough > 0 || proof != QuickProof::ApartAtStart)
  {
    const double until = ApartUntil(attempt.Path(), one, two, attempt.Gap, enough);
    if (!(until >= 1))
    {
      attempt.Blame(one, two, until);
    }
  }
  return false;
}

void EmbeddingGuard::TestPairsWithoutStrangers(Attempt& attempt,
  const ParallelFor& parallelFor) const
{
  const Motion motion = attempt.Path();
  const std::vector<char>& changed = attempt.ChangedForPairs.Contains;
  const auto test = [&](const auto& one, const auto& two)
  {
    if (AnyOf(changed, one) || AnyOf(changed, two))
    {
      const double until = ApartUntil(motion, one, two, attempt.Gap);
      if (!(until >= 1))
      {
        attempt.Blame(one, two, until);
      }
    }
  };
  ForEach(this->WithoutStrangers.VertexFaces, parallelFor,
    [&](const FeaturePairs::VertexFace& pair) { test(pair.Vertex, pair.Face); });
  ForEach(this->WithoutStrangers.EdgeEdges, parallelFor,
    [&](const FeaturePairs::EdgeEdge& pair) { test(pair.One, pair.Two); });
}

void EmbeddingGuard::ScaleBack(Attempt& attempt) const
{
  const double shear = MaximumShear * attempt.EdgeLength;
  // What is changed at first changes what is near.
  std::vector<char>& isChanged = attempt.IsChanged;
  std::vector<int> queue;
  std::vector<int> changed;
  const auto change = [&](int vertex, double scale)
  {
    attempt.Scales[vertex] = scale;
    queue.push_back(vertex);
    if (!isChanged[vertex])
    {
      isChanged[vertex] = 1;
      changed.push_back(vertex);
    }
  };
  for (int vertex = 0; vertex < static_cast<int>(attempt.SafeUntil.size()); ++vertex)
  {
    const double until = attempt.SafeUntil[vertex].load(std::memory_order_relaxed);
    if (until < 1)
    {
      if (attempt.Scales[vertex] > 0)
      {
        const double scale = attempt.Scales[vertex] *
          std::max(MinimumPart, std::min(MaximumPart, SafetyFactor * until));
        change(vertex, scale < MinimumScale ? 0 : scale);
      }
      attempt.SafeUntil[vertex].store(1, std::memory_order_relaxed);
    }
  }
  for (std::size_t head = 0; head < queue.size();)
  {
    const int vertex = queue[head++];
    const double scale = attempt.Scales[vertex];
    for (int neighbor : this->Neighbors[vertex])
    {
      double& step = attempt.ShearSteps[neighbor];
      if (step < 0)
      {
        step = shear / attempt.Wanted.row(neighbor).norm();
      }
      const double limit = scale + step;
      if (attempt.Scales[neighbor] > limit)
      {
        change(neighbor, limit);
      }
    }
  }
  for (int vertex : changed)
  {
    isChanged[vertex] = 0;
    attempt.Scaled.row(vertex) = attempt.Scales[vertex] * attempt.Wanted.row(vertex);
    attempt.To.row(vertex) = attempt.From.row(vertex) + attempt.Scaled.row(vertex);
    attempt.ChangedForCorners.Add(vertex);
    attempt.ChangedForPairs.Add(vertex);
  }
}

} // namespace FlipFree
