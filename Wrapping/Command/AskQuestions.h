/**
 * `--ask`: puts the questions of a result to whoever sits at the terminal.
 */
#ifndef FlipFreeCommandAskQuestions_h
#define FlipFreeCommandAskQuestions_h

#include "PointFile.h"

#include <vector>

class vtkTable;

namespace Command
{

/// The points that the answers give; none of a question that is skipped.
std::vector<CorrectionPoint> AskQuestions(vtkTable* questions);

} // namespace Command

#endif
