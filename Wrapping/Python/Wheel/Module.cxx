// The extension flipfree._kernels: the kernels for Python, with numpy's arrays and without VTK. It
// is private to the package, whose layer in Python checks arguments and words messages.
#include "Bindings.h"
#include "ThreadPool.h"

#include "Error.h"
#include "Exchange/FileProblem.h"
#include "Image/SeedRegion.h"

namespace
{

// A ValueError whose text has quantities in braces; and a MemoryError that says what to do.
void BindError(nanobind::module_& module)
{
  const auto error =
    nanobind::steal(PyErr_NewException("flipfree._kernels.Error", PyExc_ValueError, nullptr));
  module.attr("Error") = error;
  nanobind::register_exception_translator(
    [](const std::exception_ptr& failure, void* type)
    {
      try
      {
        std::rethrow_exception(failure);
      }
      catch (const FlipFree::Error& thrown)
      {
        PyErr_SetString(static_cast<PyObject*>(type), thrown.GetText().c_str());
      }
      catch (const std::bad_alloc& thrown)
      {
        PyErr_SetString(PyExc_MemoryError, FlipFree::MessageOf(thrown).c_str());
      }
      catch (const std::length_error& thrown)
      {
        PyErr_SetString(PyExc_MemoryError, FlipFree::MessageOf(thrown).c_str());
      }
    },
    error.ptr());
}

} // namespace

NB_MODULE(_kernels, module)
{
  BindError(module);
  static const nanobind::exception<FlipFree::FileProblem> problem(module, "FileProblem");
  FlipFree::BindCommand(module);
  FlipFree::BindSegmentation(module);
  FlipFree::BindEvaluation(module);
  FlipFree::BindDicom(module);
  FlipFree::BindExchange(module);
  FlipFree::BindLabels(module);
  FlipFree::BindPhantoms(module);
  FlipFree::BindVessels(module);
  module.attr("SEED_RADII") =
    nanobind::make_tuple(FlipFree::MinimumSeedRadius, FlipFree::MaximumSeedRadius);
  module.def("threads", &FlipFree::NumberOfThreads);
  module.def("set_threads", &FlipFree::SetNumberOfThreads);
  module.def("forget_threads", &FlipFree::ForgetThreads);
}
