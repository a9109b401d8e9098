/**
 * What may have been meant by a mistyped word.
 */
#ifndef FlipFreeSuggestion_h
#define FlipFreeSuggestion_h

#include <string>
#include <vector>

namespace FlipFree
{

/// ` Did you mean 'segment'?`, which follows a sentence; empty if no candidate is near,
/// whatever the letters' case.
std::string Suggestion(const std::string& word, const std::vector<std::string>& candidates);

} // namespace FlipFree

#endif
