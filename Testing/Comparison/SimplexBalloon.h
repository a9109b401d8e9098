/**
 * ITK's deformable simplex mesh, inflated by a force that is a function of space.
 */
#ifndef FlipFreeSimplexBalloon_h
#define FlipFreeSimplexBalloon_h

#include "SimplexSphere.h"

#include "itkDefaultDynamicMeshTraits.h"
#include "itkDeformableSimplexMesh3DFilter.h"
#include "itkSimplexMesh.h"

#include <functional>

namespace FlipFree
{

using ItkSimplexMesh =
  itk::SimplexMesh<double, 3, itk::DefaultDynamicMeshTraits<double, 3, 3, double, double, double>>;

/// The base class moves the vertices and spreads them along the surface. Three things are added:
///  - the force outward is a function of space, in millimeters, where ITK's reads a gradient image
///    in voxels of a grid at the origin;
///  - the force that keeps the shape smooth: ITK 5.2 computes its reference from the vertex's own
///    simplex angle, so that it is always zero; here it is that of the mean angle around, as
///    documented there;
///  - the motion stops when the volume has settled, or at an abort.
class SimplexBalloon : public itk::DeformableSimplexMesh3DFilter<ItkSimplexMesh, ItkSimplexMesh>
{
public:
  using Self = SimplexBalloon;
  using Superclass = itk::DeformableSimplexMesh3DFilter<ItkSimplexMesh, ItkSimplexMesh>;
  using Pointer = itk::SmartPointer<Self>;
  using Force = std::function<double(const Eigen::Vector3d& point)>;
  itkNewMacro(Self);

  void SetStart(const SimplexMesh& mesh);
  /// The step along the outward normal, in millimeters, per iteration.
  void SetForce(Force force) { this->Outward = std::move(force); }
  /// Stops when the volume inside has changed by less than this fraction over 25 iterations; zero:
  /// never.
  void SetVolumeTolerance(double fraction) { this->VolumeTolerance = fraction; }

  /// After the update, as SurfacePoints orders them.
  PointList GetSurfacePoints() const;
  int GetElapsedIterations() const { return this->Elapsed; }

protected:
  SimplexBalloon() = default;
  ~SimplexBalloon() override = default;

  void ComputeGeometry() override;
  void ComputeInternalForce(itk::SimplexMeshGeometry* data) override;
  void ComputeExternalForce(itk::SimplexMeshGeometry* data,
    const GradientImageType* gradient) override;
  void ComputeDisplacement() override;

private:
  PointList Vertices() const;
  double Volume() const;

  SimplexMesh Start;
  Force Outward;
  double VolumeTolerance = 0;
  double LastVolume = 0;
  int Elapsed = 0;
};

} // namespace FlipFree

#endif
