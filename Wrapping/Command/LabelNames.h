/**
 * What the labels of a label map are called: by a table, or by the label map's own field data.
 */
#ifndef FlipFreeCommandLabelNames_h
#define FlipFreeCommandLabelNames_h

#include <string>

class vtkImageData;

namespace Command
{

/// Names the labels (field data SegmentLabels and SegmentNames) by a table in place of what the
/// label map's file says: a line for each label, with its number, a comma, a semicolon, a tab or
/// blanks, and its name. Lines that do not begin with a number, such as that of the columns' names,
/// empty ones and comments do not count. Throws Failure.
void NameLabels(const std::string& file, vtkImageData* labels);

/// A part of a file's name: what is no letter, digit, dot or hyphen becomes an underscore. Letters
/// beyond ASCII stay.
std::string FileNamePart(const std::string& name);

} // namespace Command

#endif
