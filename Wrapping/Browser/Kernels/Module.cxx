#include "Bindings.h"

#include <emscripten/bind.h>

EMSCRIPTEN_BINDINGS(flipfree)
{
  FlipFree::BindVolumes();
  FlipFree::BindSegmentation();
  FlipFree::BindVessels();
  FlipFree::BindEvaluation();
  FlipFree::BindExchange();
  FlipFree::BindDicom();
  FlipFree::BindLabelSurfaces();
  FlipFree::BindPhantoms();
}
