/**
 * Segmentations of 3D Slicer (.seg.nrrd), as its developer guide documents them, "Segmentation
 * labelmap file format": label maps whose labels, the segments, have names and colors in pairs of
 * the file's header, Segment0_Name:=liver. Segments that overlap are in several label maps, the
 * layers, along one more axis of the file; a label then means another segment in each of them.
 */
#ifndef FlipFreeSegmentationLayers_h
#define FlipFreeSegmentationLayers_h

#include "Exchange/VolumeFileHeader.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace FlipFree
{

struct Segment
{
  std::string Name;
  std::string Color; ///< #ffd24a; empty where the file has none
  int Label = 1;     ///< the value of its voxels
  int Layer = 0;     ///< in which label map
};

/// The segments that a header's pairs tell of, in their order; none for other files. Throws
/// FileProblem, naming the file, where a number is none.
std::vector<Segment> SegmentsOf(const std::map<std::string, std::string>& pairs,
  const std::string& file);

/// The same of a file: by these pairs, or by the label table of a NIfTI file.
std::vector<Segment> SegmentsOf(const VolumeFileHeader& header);

/// What to take from a file of label maps.
struct LabelChoice
{
  int Layer = 0;
  std::optional<int> Label; ///< none: the one that is taken where nobody has chosen
};

/// A segment by its name, exactly or else in whichever case; or a label by its value, "6", where
/// no segment has that name; or, for an empty text, the only layer. Throws FileProblem, which lists
/// the segments and suggests similar names, where there is no such segment, or where the choice is
/// not the only one.
LabelChoice ChooseLabel(const std::vector<Segment>& segments, int numberOfLayers,
  const std::string& choice, const std::string& file);

/// One layer as a label map, of `count` voxels of so many bytes each.
void CopyLayer(const void* voxels, std::size_t count, std::size_t bytes, const VoxelLayers& layers,
  int layer, void* labels);

} // namespace FlipFree

#endif
