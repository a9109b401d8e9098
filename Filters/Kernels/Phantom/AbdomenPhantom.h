/**
 * A schematic upper abdomen as in a contrast-enhanced CT in the portal phase, in HU: body wall with
 * fat, muscle, ribs and spine; lungs, heart and diaphragm; liver with its vessels, spleen, kidneys,
 * stomach, pancreas, bowel and the great vessels. It reproduces what makes real organs difficult:
 * adjacent organs with little or no contrast, a left lobe behind a neck, a concave visceral side,
 * bright ribs nearby, uneven tissue.
 */
#ifndef FlipFreeAbdomenPhantom_h
#define FlipFreeAbdomenPhantom_h

#include "Phantom/Phantom.h"

namespace FlipFree
{

/// The labels of the volumes that the method is measured on (those of the BTCV abdomen challenge).
/// Vessels and lesions inside the liver belong to it; renal sinus and whatever is not listed is 0.
enum class AbdomenLabel : std::uint8_t
{
  Spleen = 1,
  RightKidney = 2,
  LeftKidney = 3,
  Gallbladder = 4,
  Esophagus = 5,
  Liver = 6,
  Stomach = 7,
  Aorta = 8,
  VenaCava = 9,
  PortalVein = 10, ///< and splenic vein, outside the liver
  Pancreas = 11
};

/// In words, such as "right kidney".
const char* NameOf(AbdomenLabel organ);

struct AbdomenOptions
{
  int Lesions = 0;        ///< dark round lesions in the liver
  std::uint64_t Seed = 0; ///< of the lesions' places and sizes
};

/// The anatomy is drawn for a grid of 330 x 255 x 270 mm (left, back, head) and scaled, all axes
/// alike, so that the body's cross-section fits. A grid that is longer or shorter along the third
/// axis shows more or less of it; organs have a seed only if it lies in the grid.
Phantom MakeAbdomenPhantom(const Eigen::Vector3d& extent, const AbdomenOptions& options = {});

} // namespace FlipFree

#endif
