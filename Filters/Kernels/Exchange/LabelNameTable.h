/**
 * What the labels of a label map are called, by a table: those of TableText.h, and those that
 * 3D Slicer, FreeSurfer and ITK-SNAP write, whose columns blanks separate. Columns of colors and
 * lines of comments (#) do not count.
 */
#ifndef FlipFreeLabelNameTable_h
#define FlipFreeLabelNameTable_h

#include <map>
#include <string>

namespace FlipFree
{

/// The names by their labels: a label and its name in each line, such as `5,liver`, or in the
/// columns that the first line says (label, index, value, LabelValue or ID; name). Throws
/// FileProblem, naming the file by `name`, and the line.
std::map<int, std::string> ReadLabelNameTable(const std::string& name, const std::string& text);

} // namespace FlipFree

#endif
