/**
 * Where a surface comes from, as text that travels with it: the version, the image's grid, seeds,
 * points, and all parameters, including those left at their defaults, so that it keeps its meaning
 * when defaults change.
 *
 * The text is a session: the JSON, here in one line, that front ends save and repeat with the
 * same bits. Some keys are optional: `together` for organs that were segmented together, and
 * `fixed` for the surfaces that they avoided; `startLabels`, a label map in place of the seed;
 * `startSurface`, if the start surface came from elsewhere and cannot be repeated. Coordinates are
 * LPS millimeters. The image and files have no names here: callers that know them add them.
 * Constraints are sorted, because their order means nothing.
 *
 * Files of surfaces that have no other place for it hold it in comments.
 */
#ifndef FlipFreeProvenance_h
#define FlipFreeProvenance_h

#include "Deformation/VolumeSegmentation.h"
#include "Image/PointConstraint.h"

#include <string>
#include <vector>

namespace FlipFree
{

/// From what an organ is found.
struct OrganProvenance
{
  std::string Name = "organ";
  SeedSphere Seed;
  ConstraintList Constraints;
  bool HasStartSurface = false; ///< which the text does not hold
  int StartLabel = -1;          ///< of a label map in place of the seed; negative if there is none
};

std::string ProvenanceOf(const OrganProvenance& organ, const VolumeSegmentationSettings& settings,
  const ImageGeometry& geometry);

/// Of organs that were segmented together, and kept off this many fixed surfaces.
std::string ProvenanceOf(const std::vector<OrganProvenance>& organs, std::size_t fixed,
  const VolumeSegmentationSettings& settings, const ImageGeometry& geometry);

// What vessels share.

/// The constraints as a list of objects.
std::string JsonOf(ConstraintList constraints);

/// The session of entries that are JSON already; `more` stands behind them.
std::string SessionOf(const ImageGeometry& geometry, const std::vector<std::string>& organs,
  const std::string& more = {});

/// What a file of a surface says before the data, a comment each: the version and the coordinate
/// system, and the provenance, unless it is empty, in lines of about 100 letters after the word
/// `provenance`. Together they are the text.
std::vector<std::string> CommentsOn(const std::string& provenance);

/// How the nth organ is shown, from 0, unless somebody chooses: #ffd24a.
std::string DefaultColor(std::size_t organ);

} // namespace FlipFree

#endif
