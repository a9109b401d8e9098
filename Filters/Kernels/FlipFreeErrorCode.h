/**
 * Why a filter failed: GetErrorCode() of FlipFree's filters is vtkErrorCode::UserError plus one of
 * these numbers, which do not change between versions, and vtkErrorCode::NoError after a success.
 * vtkErrorCode::UserError itself is a failure of another kind, such as a lack of memory. The reader
 * and the writer of images give VTK's own codes.
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
  EmptyMask = 1,        ///< a label map without the label, or a surface around no voxel
  GeometryMismatch = 2, ///< two images are not on the same grid
  InsideOut = 3,        ///< a surface whose faces are clockwise, seen from outside
  InvalidGeometry = 4,  ///< of an image: spacing, direction, dimensions
  InvalidLine = 5,      ///< of a tube: too few points, radii that are not positive
  InvalidMesh = 6,      ///< faces that do not make up a surface
  NoContrast = 7,       ///< between the seed and its surroundings
  NonFiniteValue = 8,   ///< NaN or infinity
  NotFourValent = 9,    ///< a surface to be deformed without four edges at each vertex
  OpenSurface = 10,     ///< a surface with a boundary
  OutOfRange = 11,      ///< of a parameter or a position
  RepeatedPoint = 12,   ///< of a line
  SeedWithoutVoxels = 13,
  SelfIntersecting = 14,
  SingularSystem = 15,   ///< the equations of a deformation have no unique solution
  TooLarge = 16,         ///< for the type of an index
  UnreachablePoint = 17, ///< a constraint that cannot be obeyed
  InvalidInput = 18      ///< a data set without what the filter needs: points, scalars, an array
};

} // namespace FlipFree

#endif
