// The extension flipfree._kernels: the kernels for Python, with numpy's arrays and without VTK. It
// is private to the package, whose layer in Python checks arguments and words messages.
#include "Bindings.h"
#include "ThreadPool.h"

#include "Image/SeedRegion.h"

NB_MODULE(_kernels, module)
{
  FlipFree::BindSegmentation(module);
  FlipFree::BindEvaluation(module);
  FlipFree::BindPhantoms(module);
  FlipFree::BindVessels(module);
  module.attr("SEED_RADII") =
    nanobind::make_tuple(FlipFree::MinimumSeedRadius, FlipFree::MaximumSeedRadius);
  module.def("threads", &FlipFree::NumberOfThreads);
  module.def("set_threads", &FlipFree::SetNumberOfThreads);
  module.def("forget_threads", &FlipFree::ForgetThreads);
}
