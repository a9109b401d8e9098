# Finds what the toolkit is built on. Each package is the field's standard one, from the distribution.

find_package(Threads REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)

set(_flipfree_vtk_components
  ChartsCore
  CommonCore
  CommonDataModel
  CommonExecutionModel
  CommonMath
  CommonMisc
  CommonTransforms
  FiltersCore
  FiltersGeneral
  FiltersModeling
  FiltersSources
  FiltersVerdict
  ImagingCore
  IOCore
  IOGeometry
  IOImage
  IOLegacy
  IOPLY
  IOXML
  InteractionStyle
  RenderingAnnotation
  RenderingContext2D
  RenderingContextOpenGL2
  RenderingCore
  RenderingFreeType
  RenderingImage
  RenderingOpenGL2
  ViewsContext2D)
if (BUILD_TESTING)
  list(APPEND _flipfree_vtk_components TestingCore TestingRendering)
endif ()
if (FLIPFREE_WRAP_PYTHON)
  # VTK's wrapping must find the interpreter that imports the distribution's vtkmodules.
  if (NOT DEFINED Python3_EXECUTABLE AND EXISTS "/usr/bin/python3")
    set(Python3_EXECUTABLE "/usr/bin/python3" CACHE FILEPATH "Python that imports vtkmodules")
  endif ()
  find_package(Python3 COMPONENTS Interpreter Development REQUIRED)
  list(APPEND _flipfree_vtk_components Python WrappingPythonCore)
endif ()
find_package(VTK 9.1 REQUIRED COMPONENTS ${_flipfree_vtk_components})

if (FLIPFREE_USE_ITK)
  # By name: the full list of components wants development files that nothing pulls in.
  set(_flipfree_itk_components
    ITKCommon
    ITKAnisotropicSmoothing
    ITKGDCM
    ITKIOGDCM
    ITKIOImageBase
    ITKIOMeta
    ITKIONIFTI
    ITKIONRRD
    ITKVTK)
  find_package(ITK 5.2 REQUIRED COMPONENTS ${_flipfree_itk_components})

  # Distributions leave the module ITKVtkGlue out. Two of its headers are all that is used of it.
  find_path(FLIPFREE_ITKVTKGLUE_INCLUDE_DIR itkVTKImageToImageFilter.h
    HINTS ${ITK_INCLUDE_DIRS}
    NO_DEFAULT_PATH
    DOC "Folder with the headers of ITK's module ITKVtkGlue, where the ITK at hand has it")
  if (FLIPFREE_ITKVTKGLUE_INCLUDE_DIR)
    message(STATUS "ITK and VTK meet by ITKVtkGlue (${FLIPFREE_ITKVTKGLUE_INCLUDE_DIR})")
  else ()
    message(STATUS "ITK and VTK meet by our stand-ins for ITKVtkGlue")
  endif ()
endif ()
