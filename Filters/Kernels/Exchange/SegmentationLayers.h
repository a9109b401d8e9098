/**
 * Segmentations of 3D Slicer (.seg.nrrd), as its developer guide documents them, "Segmentation
 * labelmap file format": label maps whose labels, the segments, have names and colors in pairs of
 * the file's header, Segment0_Name:=liver. Segments that overlap are in several label maps, the
 * layers, along one more axis of the file; a label then means another segment in each of them.
 */
#ifndef FlipFreeSegmentationLayers_h
#define FlipFreeSegmentationLayers_h

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

/// How the voxels of several layers are stored.
enum class LayerOrder
{
  VoxelByVoxel, ///< all layers' values of a voxel together: the axis of layers is the first
  LayerByLayer  ///< it is the last
};

/// One layer as a label map, of `count` voxels.
template <typename T>
void CopyLayer(const T* voxels, std::size_t count, int numberOfLayers, int layer, LayerOrder order,
  T* labels)
{
  const bool isByVoxel = order == LayerOrder::VoxelByVoxel;
  const std::size_t step = isByVoxel ? static_cast<std::size_t>(numberOfLayers) : 1;
  const T* from = voxels + static_cast<std::size_t>(layer) * (isByVoxel ? 1 : count);
  for (std::size_t voxel = 0; voxel < count; ++voxel)
  {
    labels[voxel] = from[voxel * step];
  }
}

} // namespace FlipFree

#endif
