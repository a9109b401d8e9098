// Two caps of a sphere may move, the lower one by halves; what lies between them stays.
#include "Deformation/MobileComponents.h"
#include "Deformation/StartSurface.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

class TwoCaps
{
public:
  TwoCaps()
    : Sphere(MakeStartSphere(8, Eigen::Vector3d::Zero(), 10))
    , Mobility(Eigen::VectorXd::Zero(this->Sphere.Points.rows()))
  {
    for (Eigen::Index vertex = 0; vertex < this->Mobility.size(); ++vertex)
    {
      this->Mobility[vertex] = this->IsUpper(vertex) ? 1 : (this->IsLower(vertex) ? 0.5 : 0);
    }
  }

  bool IsUpper(Eigen::Index vertex) const { return this->Sphere.Points(vertex, 2) > 7; }
  bool IsLower(Eigen::Index vertex) const { return this->Sphere.Points(vertex, 2) < -7; }

  // Vertices between the caps, which stay, are far from their targets.
  CorrespondenceField FieldOf(double upper, double lower) const
  {
    CorrespondenceField field;
    field.Displacements = PointList::Zero(this->Mobility.size(), 3);
    field.States.assign(this->Mobility.size(), VertexState::Matched);
    for (Eigen::Index vertex = 0; vertex < this->Mobility.size(); ++vertex)
    {
      field.Displacements(vertex, 0) =
        this->IsUpper(vertex) ? upper : (this->IsLower(vertex) ? lower : 50);
    }
    return field;
  }

  const DeformableSurface Sphere;
  Eigen::VectorXd Mobility;
};

PointList RestrictedOnes(const MobileComponents& mobile, const TwoCaps& caps)
{
  PointList motion = PointList::Ones(caps.Mobility.size(), 3);
  mobile.Restrict(motion);
  return motion;
}

} // namespace

TEST(MobileComponents, RestEachByItself)
{
  const TwoCaps caps;
  MobileComponents mobile(caps.Mobility);
  mobile.BeginLevel(caps.Sphere.Mesh);
  const PointList before = RestrictedOnes(mobile, caps);
  for (Eigen::Index vertex = 0; vertex < before.rows(); ++vertex)
  {
    ASSERT_EQ(before(vertex, 1), caps.Mobility[vertex]) << vertex;
  }

  const ScheduleSettings schedule; // a tenth of a voxel
  const double voxel = 2;
  const CorrespondenceField field = caps.FieldOf(0.1, 3);
  // The caps have the same number of vertices.
  EXPECT_NEAR(mobile.MeasureDistances(field), (0.1 + 0.5 * 3) / 1.5, 1e-12);
  mobile.FindThoseAtRest(schedule, voxel);
  EXPECT_FALSE(mobile.AreAllAtRest());
  const PointList after = RestrictedOnes(mobile, caps);
  for (Eigen::Index vertex = 0; vertex < after.rows(); ++vertex)
  {
    ASSERT_EQ(after(vertex, 1), caps.IsLower(vertex) ? 0.5 : 0) << vertex;
  }

  // The distance of the lower one does not fall.
  for (std::size_t iteration = 1; iteration <= ScheduleSettings::ChangeSpan; ++iteration)
  {
    EXPECT_FALSE(mobile.AreAllAtRest());
    mobile.MeasureDistances(field);
    mobile.FindThoseAtRest(schedule, voxel);
  }
  EXPECT_TRUE(mobile.AreAllAtRest());
  EXPECT_EQ(RestrictedOnes(mobile, caps).norm(), 0);
  mobile.BeginLevel(caps.Sphere.Mesh);
  EXPECT_FALSE(mobile.AreAllAtRest());
}

TEST(MobileComponents, AreLedByMatchedVerticesAlone)
{
  const TwoCaps caps;
  MobileComponents mobile(caps.Mobility);
  mobile.BeginLevel(caps.Sphere.Mesh);
  CorrespondenceField field = caps.FieldOf(4, 4);
  for (Eigen::Index vertex = 0; vertex < caps.Mobility.size(); ++vertex)
  {
    if (caps.IsLower(vertex))
    {
      field.States[vertex] = VertexState::Solitary;
      field.Displacements.row(vertex).setZero();
    }
  }
  EXPECT_NEAR(mobile.MeasureDistances(field), 4, 1e-12);
}

TEST(MobileComponents, MoveFreelyWhereTheyWerePulled)
{
  const TwoCaps caps;
  MobileComponents mobile(caps.Mobility);
  const double voxel = 2;
  const PointList& from = caps.Sphere.Points;
  PointList to = from;
  to.col(0).array() += voxel / 8;
  to(0, 0) = from(0, 0) + 5 * voxel;
  mobile.FreePulled(from, to, voxel);
  const PointList motion = RestrictedOnes(mobile, caps);
  EXPECT_EQ(motion(0, 1), 1);
  for (Eigen::Index vertex = 1; vertex < motion.rows(); ++vertex)
  {
    ASSERT_NEAR(motion(vertex, 1), caps.IsUpper(vertex) ? 1 : 0.5, 1e-9) << vertex;
  }
}
