/**
 * What may have been meant by a mistyped word.
 */
#ifndef FlipFreeCommandSuggestion_h
#define FlipFreeCommandSuggestion_h

#include <string>
#include <vector>

namespace Command
{

/// ` Did you mean 'segment'?`, which follows a sentence; empty if no candidate is near.
std::string Suggestion(const std::string& word, const std::vector<std::string>& candidates);

} // namespace Command

#endif
