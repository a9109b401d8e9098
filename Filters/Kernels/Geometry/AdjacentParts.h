/**
 * The pairs (b) and (c) of FaceHulls.h: parts of adjacent faces, and of one face.
 */
#ifndef FlipFreeAdjacentParts_h
#define FlipFreeAdjacentParts_h

#include "Geometry/FaceParts.h"

#include <functional>
#include <string>
#include <utility>

namespace FlipFree
{

/// Parts of two faces, or of one, without a common vertex.
struct HullPair
{
  Hull One;
  Hull Two;
  std::array<int, 2> Faces;
};

/// Takes a block of pairs.
using HullPairVisitor = std::function<void(const std::vector<HullPair>& pairs)>;

/// FaceHulls::VisitAdjacentPairs says what this does.
std::vector<std::pair<int, int>> VisitAdjacentParts(const FaceParts& parts, int numberOfPoints,
  bool covered, const HullPairVisitor& visit);

/// What is wrong with two faces that FaceHulls::FindOverlappingFaces() returns, for messages.
std::string NameOfOverlap(const std::pair<int, int>& faces);

} // namespace FlipFree

#endif
