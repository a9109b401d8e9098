/**
 * Why a filter of FlipFree has failed, in C++. After a failure, its GetErrorCode() is
 * vtkErrorCode::UserError plus one of these numbers, which keep their meaning; after a success,
 * vtkErrorCode::NoError; after any other failure, such as a lack of memory, plain
 * vtkErrorCode::UserError. Failures of the pipeline, such as a missing input, do not change it, and
 * the reader and the writer of images give VTK's own codes.
 *
 *     filter->Update();
 *     if (filter->GetErrorCode() ==
 *       vtkErrorCode::UserError + static_cast<int>(FlipFree::ErrorCode::NoContrast))
 */
#ifndef FlipFreeErrorCode_h
#define FlipFreeErrorCode_h

namespace FlipFree
{

enum class ErrorCode
{
  /// A label map without the label, or hardly any of it; a surface around no voxel.
  EmptyMask = 1,
  /// Images on two grids, or meshes with other polygons.
  GeometryMismatch = 2,
  /// A surface whose faces are clockwise, seen from outside.
  InsideOut = 3,
  /// An image without voxels, or with an invalid spacing or direction.
  InvalidGeometry = 4,
  /// Too few points, or radii that are not positive.
  InvalidLine = 5,
  /// Points or faces that do not make up a surface.
  InvalidMesh = 6,
  /// The seed, a vessel, or what was found has too little contrast to its surroundings.
  NoContrast = 7,
  /// NaN or infinity.
  NonFiniteValue = 8,
  /// A surface to be deformed without four edges at each vertex.
  NotFourValent = 9,
  /// A surface with a boundary.
  OpenSurface = 10,
  /// A parameter, a number of things, or a position.
  OutOfRange = 11,
  /// A line with the same point twice.
  RepeatedPoint = 12,
  /// A sphere, or what is left of it, that holds no voxel center.
  SeedWithoutVoxels = 13,
  /// A surface, or what would become of it by a refinement.
  SelfIntersecting = 14,
  /// The equations of a deformation have no unique solution.
  SingularSystem = 15,
  /// More elements than the type of an index can number.
  TooLarge = 16,
  /// A constraint that cannot be obeyed.
  UnreachablePoint = 17,
  /// A data set without what the filter needs, such as scalars or an array.
  InvalidInput = 18
};

} // namespace FlipFree

#endif
