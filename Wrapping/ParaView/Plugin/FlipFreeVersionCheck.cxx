#include "FlipFreeVersionCheck.h"

#include "vtkObject.h"
#include "vtkPVVersion.h"
#include "vtkSMProxyManager.h"

#include <string>

void FlipFree::CheckParaViewVersion()
{
  const std::string built = PARAVIEW_VERSION_FULL;
  const std::string running = std::to_string(vtkSMProxyManager::GetVersionMajor()) + "." +
    std::to_string(vtkSMProxyManager::GetVersionMinor()) + "." +
    std::to_string(vtkSMProxyManager::GetVersionPatch());
  if (running != built)
  {
    vtkGenericWarningMacro("The plugin FlipFree was built with ParaView "
      << built << ", and this is ParaView " << running
      << ": it may fail at any time. Build it with this ParaView's development files: "
         "Wrapping/ParaView/build-plugin.sh FOLDER -DParaView_DIR=...");
  }
}
