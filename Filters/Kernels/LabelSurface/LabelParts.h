/**
 * The parts of labels that get no surface: small ones, and cavities.
 *
 * A part is what is connected of a label, or of background, as surfaces show it: across faces of
 * voxels and, where labels touch by an edge or a corner, through the cells that have the label
 * (LabelCells). What goes takes the label with which it has the most faces of voxels in common,
 * background counting as a label; of several, background, or else the one whose part comes first in
 * the order of the voxels. Parts that go do not count until they have taken a label; those that
 * border only such wait for it, which comes, since the outside stays. So each voxel still has one
 * label, and walls remain shared. The result does not depend on the values of the labels.
 */
#ifndef FlipFreeLabelParts_h
#define FlipFreeLabelParts_h

#include "LabelSurface/LabelCells.h"

namespace FlipFree
{

struct LabelPartSettings
{
  /// Parts of labels with fewer voxels go.
  std::size_t SmallestPart = 0;
  /// Parts of the background that do not reach its outside go: cavities.
  bool FillCavities = false;

  bool KeepsAll() const { return this->SmallestPart <= 1 && !this->FillCavities; }
};

/// The parts of a grid's labels, background being one.
struct LabelParts
{
  LabelParts(const LabelGrid& grid, const LabelCells& cells);
  /// Those that are connected across faces of voxels alone.
  explicit LabelParts(const LabelGrid& grid);

  struct Part
  {
    int Label = 0;
    std::size_t Voxels = 0;
  };

  /// Voxels of one row with one label. Those of a row follow each other.
  struct Run
  {
    int Begin = 0;
    int Part = 0;
  };

  /// Where a run of a row ends.
  int EndOf(std::size_t run, std::size_t row) const
  {
    return run + 1 == this->RowBegin[row + 1] ? this->Size[0] : this->Runs[run + 1].Begin;
  }

  /// Calls visit(one, other, faces) for runs of two parts that have faces of voxels in common.
  template <typename Visit>
  void VisitBorders(const Visit& visit) const;

  /// In the order of their first voxels: the first one is the outside.
  std::vector<Part> Parts;
  std::vector<Run> Runs;
  std::vector<std::size_t> RowBegin; ///< rows are numbered j + Size[1] * k; the last is the end
  std::array<int, 3> Size{ { 0, 0, 0 } };

private:
  LabelParts(const LabelGrid& grid, const LabelCells* cells);
};

/// The grid without what goes, its labels by the same indices. No part is left that would go.
LabelGrid KeepParts(LabelGrid grid, const LabelPartSettings& settings,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif
