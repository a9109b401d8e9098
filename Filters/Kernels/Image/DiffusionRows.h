/**
 * The arithmetic of anisotropic diffusion on rows of voxels, compiled for several instruction sets.
 * The results do not depend on the instruction set or on the row's place in memory: nothing is
 * contracted or reordered.
 */
#ifndef FlipFreeDiffusionRows_h
#define FlipFreeDiffusionRows_h

#include <array>

namespace FlipFree
{

struct DiffusionCoefficients
{
  std::array<float, 3> Weight; ///< of a flux along each axis, in one step
  float Fall;                  ///< of the conductance, per squared difference
};

/// The fluxes along each axis through the faces on one side of a row.
using RowFluxes = std::array<const float*, 3>;

struct DiffusionRows
{
  /// The fluxes through the faces between two rows.
  void (*Flux)(const float* near, const float* far, const DiffusionCoefficients& coefficients,
    int size, float* flux);
  /// One time step. `out` overlaps no other array.
  void (*Step)(const float* voxels, const RowFluxes& previous, const RowFluxes& next,
    const DiffusionCoefficients& coefficients, int size, float* out);
};

/// For the widest vectors that the machine has, or with `plain` for those that all machines have.
DiffusionRows ChooseDiffusionRows(bool plain = false);

} // namespace FlipFree

#endif
