/**
 * Which parts of a surface have to be watched for it to stay embedded.
 *
 * An embedded surface that moves stays embedded as long as no vertex meets a triangle without it,
 * and no edge an edge without a common vertex: whatever goes wrong later begins with such a
 * contact. Call two triangles without a common vertex strangers. Nearly always a vertex and a
 * triangle, or two edges, belong to a pair of strangers, so that it is enough to watch these. The
 * exceptions, on meshes with very few vertices, are listed here.
 */
#ifndef FlipFreeStrangerPairs_h
#define FlipFreeStrangerPairs_h

#include "KernelTypes.h"

#include <array>
#include <vector>

namespace FlipFree
{

struct FeaturePairs
{
  struct VertexFace
  {
    std::array<int, 1> Vertex;
    std::array<int, 3> Face;
  };
  struct EdgeEdge
  {
    std::array<int, 2> One;
    std::array<int, 2> Two;
  };
  std::vector<VertexFace> VertexFaces;
  std::vector<EdgeEdge> EdgeEdges;
};

/// The pairs of features without common vertices that are in no pair of strangers.
FeaturePairs ListPairsWithoutStrangers(int numberOfPoints, const TriangleList& triangles);

} // namespace FlipFree

#endif
