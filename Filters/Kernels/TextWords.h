/**
 * Letters, words and numbers of texts, alike in every locale.
 */
#ifndef FlipFreeTextWords_h
#define FlipFreeTextWords_h

#include <string>
#include <vector>

namespace FlipFree
{

/// Letters from A to Z made small.
std::string InSmallLetters(std::string text);

/// The first letter made small: distanceTolerance.
std::string WithSmallFirst(const std::string& text);

/// Without white space at both ends.
std::string Trimmed(const std::string& text);

/// The words of a text, between white space.
std::vector<std::string> Words(const std::string& text);

/// A number that takes up the whole text; NaN and infinity are numbers. False if it is not one.
bool ToNumber(const std::string& text, double& number);

/// Whether it has no characters of control but tabs.
bool IsPrintable(const std::string& line);

bool IsUtf8(const std::string& text);

/// In UTF-8, without characters of control. What is not UTF-8 is read as Latin-1, or shown as `?`.
std::string TextForPeople(const std::string& original, bool isUtf8, bool isLatin1);

} // namespace FlipFree

#endif
