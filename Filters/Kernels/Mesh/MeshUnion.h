/**
 * Several surfaces as one: their vertices and faces one after the other. If the union is embedded,
 * each of them is, and no two of them meet.
 */
#ifndef FlipFreeMeshUnion_h
#define FlipFreeMeshUnion_h

#include "Mesh/ContourMesh.h"

#include <vector>

namespace FlipFree
{

/// Appends a mesh: its vertices get the numbers after those of `mesh`, its faces come last.
void AppendMesh(const ContourMesh& part, ContourMesh& mesh);

/// Appends rows.
void AppendPoints(const PointList& part, PointList& points);

} // namespace FlipFree

#endif
