/**
 * What the labels of a label map are called by a table.
 */
#ifndef FlipFreeCommandLabelNames_h
#define FlipFreeCommandLabelNames_h

#include <string>

class vtkImageData;

namespace Command
{

/// Names the labels (field data SegmentLabels and SegmentNames) by a table in place of what the
/// label map's file says. Throws Failure.
void NameLabels(const std::string& file, vtkImageData* labels);

} // namespace Command

#endif
