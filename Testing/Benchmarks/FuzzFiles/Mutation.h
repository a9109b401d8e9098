/**
 * Damages files at random: single bits and numbers, cut, moved and foreign pieces, and, in headers
 * that are text, words and lines.
 */
#ifndef FlipFreeMutation_h
#define FlipFreeMutation_h

#include <random>
#include <string>

/// A few damages at once. Half of them fall into the first `header` bytes; `other` is where foreign
/// pieces come from.
std::string Mutated(std::string bytes, std::size_t header, bool isText, const std::string& other,
  std::mt19937_64& random);

#endif
