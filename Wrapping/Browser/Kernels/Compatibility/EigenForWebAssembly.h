/**
 * Included before everything else. Eigen takes clang for the GCC 4.2 that it claims to be, and
 * works around faults of that one by assembler of the PC; for WebAssembly, there is none.
 */
#ifndef EigenForWebAssembly_h
#define EigenForWebAssembly_h

#include <Eigen/src/Core/util/Macros.h>

#undef EIGEN_COMP_GNUC
#define EIGEN_COMP_GNUC 0

#endif
