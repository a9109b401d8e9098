// Any closed mesh as a start: by its edge midpoints, and as a surface that stays as it is.
#include "Deformation/StartSurface.h"
#include "Error.h"
#include "ExampleSurfaces.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/MidpointMesh.h"
#include "Mesh/SurfaceTopology.h"

#include <gtest/gtest.h>

#include <set>

namespace FlipFree
{
namespace
{

PolygonMesh MeshOf(const Surface& surface)
{
  return { surface.Points, FacesOf(surface.Triangles) };
}

GivenSurface Given(const PolygonMesh& mesh)
{
  return { "the surface", mesh.Points, mesh.Faces };
}

double VolumeOf(const PolygonMesh& mesh)
{
  return EnclosedVolume(mesh.Points, Triangulate(mesh.Faces));
}

Surface Tetrahedron(double size)
{
  Surface surface;
  surface.Points.resize(4, 3);
  surface.Points << 0, 0, 0, size, 0, 0, 0, size, 0, 0, 0, size;
  surface.Triangles.resize(4, 3);
  surface.Triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  return surface;
}

// What is wrong with a mesh as a start, and as a fixed surface.
void ExpectRefused(const PolygonMesh& mesh, const std::string& words)
{
  const std::string start = ErrorOf([&] { MakeStartSurface(Given(mesh), true, SerialFor); });
  EXPECT_NE(start.find(words), std::string::npos) << start;
  EXPECT_NE(start.find("the surface"), std::string::npos) << start;
}

} // namespace

TEST(MidpointMesh, OfATetrahedronIsAnOctahedron)
{
  const PolygonMesh octahedron = MakeMidpointMesh(MeshOf(Tetrahedron(2)), "it");
  ASSERT_EQ(octahedron.Points.rows(), 6);
  EXPECT_EQ(octahedron.Faces.NumberOfFaces(), 8);
  EXPECT_EQ(BuildContourMesh(6, octahedron.Faces).EulerNumber(), 2);
  // Four corners of an eighth of the volume each are cut off.
  EXPECT_NEAR(VolumeOf(octahedron), 0.5 * 8.0 / 6, 1e-12);
  for (const auto point : octahedron.Points.rowwise())
  {
    EXPECT_TRUE((point.array() == 0).any() || std::abs(point.sum() - 2) < 1e-12);
  }
}

TEST(MidpointMesh, HasFourNeighborsEverywhereAndTheSameTopology)
{
  const QuadSphere quads = MakeQuadSphere(5, { 0, 0, 0 }, 3, QuadSphereSpacing::Equiangular);
  for (const PolygonMesh& mesh : { MeshOf(Box({ 0, 0, 0 }, { 1, 2, 3 })),
         MeshOf(Potato(9, { 1, 2, 3 }, 10)), PolygonMesh{ quads.Points, quads.Faces },
         MeshOf(Joined(Tetrahedron(1),
           Moved(Tetrahedron(1), Eigen::Matrix3d::Identity(), { 5, 0, 0 }))) })
  {
    const auto edges = CollectEdges(static_cast<int>(mesh.Points.rows()), mesh.Faces);
    const int euler = MeasureTopology(mesh.Faces, edges).EulerNumber();
    const PolygonMesh midpoints = MakeMidpointMesh(mesh, "it");
    EXPECT_EQ(midpoints.Points.rows(), static_cast<Eigen::Index>(edges.size()));
    const ContourMesh contours =
      BuildContourMesh(static_cast<int>(midpoints.Points.rows()), midpoints.Faces);
    EXPECT_EQ(contours.EulerNumber(), euler);
    EXPECT_GT(VolumeOf(midpoints), 0.4 * VolumeOf(mesh));
    EXPECT_LT(VolumeOf(midpoints), 1.01 * VolumeOf(mesh));
  }
}

TEST(MidpointMesh, SplittingKeepsTheSurfaceAndBringsItsMidpointsNearer)
{
  PolygonMesh mesh = MeshOf(Box({ 0, 0, 0 }, { 1, 2, 3 }));
  double missing = 6 - VolumeOf(MakeMidpointMesh(mesh, "it"));
  for (int split = 0; split < 3; ++split)
  {
    mesh = SplitTriangles(mesh);
    EXPECT_EQ(mesh.Faces.NumberOfFaces(), 12 << 2 * (split + 1));
    EXPECT_NEAR(VolumeOf(mesh), 6, 1e-12);
    const double less = 6 - VolumeOf(MakeMidpointMesh(mesh, "it"));
    EXPECT_LT(less, 0.6 * missing);
    missing = less;
  }
}

TEST(MidpointMesh, UnusedPointsAreLeftOut)
{
  const Surface box = Box({ 0, 0, 0 }, { 1, 1, 1 });
  PolygonMesh more = MeshOf(box);
  more.Points.resize(10, 3);
  more.Points << Eigen::RowVector3d(9, 9, 9), box.Points, Eigen::RowVector3d(8, 8, 8);
  for (int& vertex : more.Faces.Connectivity)
  {
    ++vertex;
  }
  const PolygonMesh same = WithoutUnusedPoints(more);
  EXPECT_EQ(same.Points, box.Points);
  EXPECT_EQ(same.Faces.Connectivity, MeshOf(box).Faces.Connectivity);
}

TEST(StartSurface, TakesAFourValentMeshAsItIsAndAnyOtherClosedOneByItsMidpoints)
{
  const QuadSphere sphere = MakeQuadSphere(6, { 1, 2, 3 }, 10, QuadSphereSpacing::Equiangular);
  const DeformableSurface same =
    MakeStartSurface({ "it", sphere.Points, sphere.Faces }, true, SerialFor);
  EXPECT_EQ(same.Points, sphere.Points);
  EXPECT_EQ(same.Mesh.Faces.Connectivity, sphere.Faces.Connectivity);
  // As STL and PLY files hold it.
  const PolygonMesh cut{ sphere.Points, FacesOf(Triangulate(sphere.Faces)) };
  const DeformableSurface start = MakeStartSurface(Given(cut), true, SerialFor);
  EXPECT_EQ(start.Points.rows(), 3 * cut.Faces.NumberOfFaces() / 2);
  EXPECT_EQ(start.Mesh.EulerNumber(), 2);
  EXPECT_NEAR(EnclosedVolume(start.Points, start.Mesh.Triangles) / VolumeOf(cut), 1, 0.05);
}

// The faces around some vertices are not convex, so that some cut of them meets others.
TEST(StartSurface, IsEmbeddedForEveryCut)
{
  for (const int n : { 6, 12 })
  {
    const PolygonMesh mesh = MeshOf(Potato(n, { 1, 2, 3 }, 10));
    const PolygonMesh midpoints = MakeMidpointMesh(mesh, "it");
    ASSERT_GT(CountSelfIntersections(midpoints.Points, midpoints.Faces), 0);
    const DeformableSurface start = MakeStartSurface(Given(mesh), true, SerialFor);
    EXPECT_EQ(CountSelfIntersections(start.Points, start.Mesh.Faces), 0);
    ASSERT_EQ(start.Points.rows(), midpoints.Points.rows());
    EXPECT_LT((start.Points - midpoints.Points).rowwise().norm().maxCoeff(), 5.0 / n);
    // Without the guard, nobody relies on it.
    EXPECT_EQ(MakeStartSurface(Given(mesh), false, SerialFor).Points, midpoints.Points);
  }
}

// Where the corner of one piece would be cut off, there is another.
TEST(StartSurface, IsSplitWhereItsMidpointsWouldMeet)
{
  const Surface outer = Tetrahedron(16);
  Surface inner = Moved(Tetrahedron(0.5), Eigen::Matrix3d::Identity(), { 2.5, 2.5, 2.5 });
  inner.Triangles.col(0).swap(inner.Triangles.col(1)); // a cavity
  const PolygonMesh mesh = MeshOf(Joined(outer, inner));
  ASSERT_EQ(CountSelfIntersections(mesh.Points, mesh.Faces), 0);
  const PolygonMesh midpoints = MakeMidpointMesh(mesh, "it");
  ASSERT_GT(CountSelfIntersections(midpoints.Points, midpoints.Faces), 0);
  const DeformableSurface start = MakeStartSurface(Given(mesh), true, SerialFor);
  EXPECT_EQ(CountSelfIntersections(start.Points, start.Mesh.Faces), 0);
  EXPECT_GT(start.Points.rows(), midpoints.Points.rows());
}

TEST(StartSurface, IsRefusedWhereItIsNoClosedEmbeddedSurface)
{
  const PolygonMesh box = MeshOf(Box({ 0, 0, 0 }, { 1, 1, 1 }));
  PolygonMesh open = box;
  open.Faces.Offsets.pop_back();
  open.Faces.Connectivity.resize(33);
  ExpectRefused(open, "is on one face only; fill holes");
  PolygonMesh turned = box;
  std::swap(turned.Faces.Connectivity[0], turned.Faces.Connectivity[1]);
  ExpectRefused(turned, "is used twice in the same direction; orient the faces alike");
  PolygonMesh triple = box;
  triple.Faces.Append({ 0, 3, 7 });
  ExpectRefused(triple, "is on 3 faces; part what touches along it");
  PolygonMesh doubled = box;
  doubled.Faces.Connectivity[1] = doubled.Faces.Connectivity[0];
  ExpectRefused(doubled, "has the same point twice in a row");
  const Surface tip = Tetrahedron(1);
  Surface bowTie = Joined(tip, Moved(tip, -Eigen::Matrix3d::Identity(), { 0, 0, 0 }));
  bowTie.Triangles.bottomRows(4).col(0).swap(bowTie.Triangles.bottomRows(4).col(1));
  bowTie.Triangles = (bowTie.Triangles.array() == 4).select(0, bowTie.Triangles);
  ExpectRefused(MeshOf(bowTie), "the faces around point 0 of the surface do not form one ring");
  const Surface crossed = Joined(tip, Moved(tip, Eigen::Matrix3d::Identity(), { 0.1, 0.1, 0.1 }));
  ExpectRefused(MeshOf(crossed), "intersects itself");
  PolygonMesh inside = box;
  for (int face = 0; face < inside.Faces.NumberOfFaces(); ++face)
  {
    std::swap(inside.Faces.Connectivity[3 * face], inside.Faces.Connectivity[3 * face + 1]);
  }
  ExpectRefused(inside, "is inside out");
  ExpectRefused(NeckOfTwoFaces(),
    "of the surface, faces 0 and 1 share more than a vertex or an edge: both can be cut along the "
    "same diagonal, which would then be an edge of more than two triangles, near (0, 1, 0) mm; cut "
    "one of them along another diagonal, or refine the surface there");
}

TEST(FixedSurface, IsTheVeryMeshThatIsGiven)
{
  const PolygonMesh potato = MeshOf(Potato(9, { 1, 2, 3 }, 10));
  const DeformableSurface fixed = MakeFixedSurface(Given(potato), SerialFor);
  EXPECT_EQ(fixed.Points, potato.Points);
  EXPECT_EQ(fixed.Mesh.Faces.Connectivity, potato.Faces.Connectivity);
  std::set<std::pair<int, int>> edges;
  for (const SurfaceEdge& edge : CollectEdges(static_cast<int>(potato.Points.rows()), potato.Faces))
  {
    edges.insert({ edge.Lower, edge.Higher });
    edges.insert({ edge.Higher, edge.Lower });
  }
  for (int vertex = 0; vertex < fixed.Mesh.NumberOfPoints(); ++vertex)
  {
    for (const int neighbor : fixed.Mesh.Neighbors[vertex])
    {
      EXPECT_EQ(edges.count({ vertex, neighbor }), 1U);
    }
  }
}

TEST(FixedSurface, IsRefusedWhereItIsNoClosedEmbeddedSurface)
{
  PolygonMesh open = MeshOf(Box({ 0, 0, 0 }, { 1, 1, 1 }));
  open.Faces.Offsets.pop_back();
  open.Faces.Connectivity.resize(33);
  EXPECT_NE(ErrorOf([&] { MakeFixedSurface(Given(open), SerialFor); }).find("fill holes"),
    std::string::npos);
  const Surface tip = Tetrahedron(1);
  const PolygonMesh crossed =
    MeshOf(Joined(tip, Moved(tip, Eigen::Matrix3d::Identity(), { 0.1, 0.1, 0.1 })));
  EXPECT_NE(ErrorOf([&] { MakeFixedSurface(Given(crossed), SerialFor); }).find("intersects itself"),
    std::string::npos);
}

} // namespace FlipFree
