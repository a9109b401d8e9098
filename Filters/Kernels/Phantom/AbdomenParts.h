/**
 * The parts of the abdomen phantom, in millimeters around the center of the body: x to the
 * patient's left, y to the back, z to the head. Parts that are added later hide earlier ones.
 */
#ifndef FlipFreeAbdomenParts_h
#define FlipFreeAbdomenParts_h

#include "Phantom/AbdomenPhantom.h"

namespace FlipFree
{

using TissueLayers = std::vector<TissueLayer>;

/// The spaces within the body wall that bound the organs.
struct AbdomenSpaces
{
  ImplicitShape Cavity;         ///< of chest and abdomen together
  ImplicitShape BelowDiaphragm; ///< up to the domes, the muscle itself included
  ImplicitShape Abdomen;        ///< of the cavity, what lies below the muscle
};

AbdomenSpaces MakeAbdomenSpaces();

/// Couch, skin, fat, muscles of the wall and the back.
void AddBodyWall(TissueLayers& layers, const AbdomenSpaces& spaces);

/// Lungs, heart and diaphragm; leaves the abdomen filled with fat.
void AddChest(TissueLayers& layers, const AbdomenSpaces& spaces);

/// Spine and ribs.
void AddSkeleton(TissueLayers& layers);

/// Spleen, bowel, pancreas, stomach: the organs that the liver indents.
void AddDigestiveTract(TissueLayers& layers, const AbdomenSpaces& spaces);

/// Portal and splenic vein, the liver with the vessels in it, lesions, gallbladder.
void AddLiver(TissueLayers& layers, const AbdomenSpaces& spaces, const AbdomenOptions& options);

/// Kidneys, aorta, vena cava.
void AddRetroperitoneum(TissueLayers& layers);

inline void AddLayer(TissueLayers& layers, ImplicitShape shape, double intensity,
  double unevenness = 0)
{
  layers.push_back({ std::move(shape), { intensity, unevenness, 0 } });
}

inline void AddOrgan(TissueLayers& layers, AbdomenLabel label, ImplicitShape shape,
  double intensity, double unevenness = 0)
{
  layers.push_back(
    { std::move(shape), { intensity, unevenness, static_cast<std::uint8_t>(label) } });
}

} // namespace FlipFree

#endif
