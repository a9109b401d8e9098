#include "Suggestion.h"

#include "TextWords.h"

#include <algorithm>
#include <numeric>

namespace FlipFree
{
namespace
{

/// Levenshtein's: how many letters to insert, remove or replace.
std::size_t EditDistance(const std::string& one, const std::string& other)
{
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{ 0 });
  for (const char letter : one)
  {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < other.size(); ++j)
    {
      const std::size_t replaced = diagonal + (letter == other[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({ replaced, row[j] + 1, row[j + 1] + 1 });
    }
  }
  return row.back();
}

} // namespace

std::string Suggestion(const std::string& word, const std::vector<std::string>& candidates)
{
  // A third of the letters: more would suggest unrelated words.
  std::size_t least = word.size() / 3 + 1;
  std::string nearest;
  for (const std::string& candidate : candidates)
  {
    const std::size_t distance = EditDistance(InSmallLetters(word), InSmallLetters(candidate));
    if (distance < least)
    {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest.empty() ? "" : " Did you mean '" + nearest + "'?";
}

} // namespace FlipFree
