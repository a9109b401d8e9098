/**
 * Carves out of an organ in CT the fat in its hollows that open to the outside: the renal sinus,
 * the liver's fissures. The fat lies between the organ's lips, in layers as thin as the blur of the
 * image, so that its gray values are mixed with the organ's, and what closes an organ's holes
 * closes the hollow. In MR, gray values do not tell fat, and nothing is carved.
 */
#ifndef FlipFreeHollowCarving_h
#define FlipFreeHollowCarving_h

#include "Image/BitMask.h"
#include "Image/ImagePart.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

/// Removes from the mask, which is on the grid of the part, what is darker than the organ is there
/// by a third of the way to fat (and by 2.5 robust standard deviations), lies between parts of the
/// organ at most 20 mm apart and within 8 mm of fat in the same hollow, and is connected, by faces,
/// with the outside. Cysts within the organ stay, and so does what is darker at its outer border;
/// holes are filled. A mask without voxels deeper than 2 mm stays as it is. Returns false if the
/// monitor, asked before each pass over the mask, stopped it; the mask is then useless.
bool CarveHollows(const ImagePart& image, Modality modality, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& mask);

} // namespace FlipFree

#endif
