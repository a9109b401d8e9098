/**
 * The arithmetic of anisotropic diffusion on rows of voxels, for the instructions that the machine
 * has. Each voxel gets the same bits whichever they are, and whatever row it is part of: nothing is
 * contracted, reordered or approximated by what differs between machines.
 *
 * All equations move gray values across the faces between voxels. The flux through a face is made
 * once and counted on both of its sides.
 */
#ifndef FlipFreeDiffusionRows_h
#define FlipFreeDiffusionRows_h

#include "Image/AnisotropicDiffusion.h"

#include <array>

namespace FlipFree
{

/// What a step needs to know, by axis.
struct DiffusionCoefficients
{
  std::array<float, 3> InverseSpacing;
  std::array<float, 3> Weight; ///< of a flux, in the step
  float Fall;                  ///< of the conductance, per square of a difference or a gradient
  float TimeStep;
};

/// The faces across an axis between two rows of voxels: the voxels on both sides, and their
/// neighbors along the two other axes, `Others`.
struct FaceRows
{
  struct Side
  {
    const float* Voxels;
    std::array<const float*, 2> Previous;
    std::array<const float*, 2> Next;
  };
  int Axis;
  std::array<int, 2> Others;
  Side Near;
  Side Far;
};

/// A row of voxels, its neighbors along each axis, and the fluxes through the faces to them.
struct VoxelRows
{
  const float* Voxels;
  std::array<const float*, 3> Previous;
  std::array<const float*, 3> Next;
  std::array<const float*, 3> PreviousFlux;
  std::array<const float*, 3> NextFlux;
};

/// One row's worth of arithmetic. The arrays written to overlap no other.
struct DiffusionRows
{
  void (
    *Flux)(const FaceRows& rows, const DiffusionCoefficients& coefficients, int size, float* flux);
  void (
    *Step)(const VoxelRows& rows, const DiffusionCoefficients& coefficients, int size, float* out);
};

/// By the widest vectors that the machine has, or with `plain` by those that every machine has.
DiffusionRows ChooseDiffusionRows(DiffusionEquation equation, bool plain = false);

} // namespace FlipFree

#endif
