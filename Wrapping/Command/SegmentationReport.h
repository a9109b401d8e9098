/**
 * What `flipfree segment` prints of a result.
 */
#ifndef FlipFreeCommandSegmentationReport_h
#define FlipFreeCommandSegmentationReport_h

#include "OrganFilter.h"
#include "SegmentRequest.h"

#include <string>

class vtkPolyData;

namespace Command
{

/// A line with volume, convergence, validity, confidence and seconds, unless it is to be quiet; a
/// warning where the surface is not certified.
void Report(const OrganFilter& filter, const SegmentRequest& request, double readingSeconds);

/// Prints what Summary.h says, at once.
void PrintSummary(const std::string& text);

/// Where no vertex found a boundary, the surface is not an organ's: nothing is written. Python has
/// the same words (_boundary_found.py).
constexpr const char* NoBoundaryText =
  "no boundary of the organ was found; check that the seed sphere lies within the organ, or raise "
  "--search-distance.";

constexpr const char* NoVesselBoundaryText =
  "no boundary of the vessel was found; place the points inside it.";

/// Of the inside of a closed surface in millimeters.
double VolumeInMilliliters(vtkPolyData* surface);

} // namespace Command

#endif
