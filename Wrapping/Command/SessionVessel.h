/**
 * The vessels of a session as filters.
 */
#ifndef FlipFreeCommandSessionVessel_h
#define FlipFreeCommandSessionVessel_h

#include "SessionFile.h"

#include "vtkSmartPointer.h"

class vtkFlipFreeVesselSegmentation;

namespace Command
{

/// Throws a Failure, naming the parameter, where there is none of its name or value.
vtkSmartPointer<vtkFlipFreeVesselSegmentation> VesselFilterOf(const SessionOrgan& vessel);

} // namespace Command

#endif
