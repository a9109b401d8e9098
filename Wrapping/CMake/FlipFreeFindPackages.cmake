# Finds what the toolkit is built on. Each package is the field's standard one, from the distribution.

find_package(Threads REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)

# What the modules need, and for each further part what that adds: the modules alone can be built on a
# VTK without rendering, charts, or readers and writers of its own.
set(_flipfree_vtk_components
  CommonCore
  CommonDataModel
  CommonExecutionModel
  CommonMath
  FiltersCore
  FiltersGeneral)
if (FLIPFREE_USE_ITK)
  list(APPEND _flipfree_vtk_components CommonMisc IOCore IOImage)
endif ()
if (FLIPFREE_BUILD_COMMAND)
  list(APPEND _flipfree_vtk_components
    CommonTransforms
    ImagingCore
    IOCore
    IOImage
    IOXML
    RenderingCore
    RenderingFreeType
    RenderingOpenGL2)
endif ()
if (BUILD_TESTING OR FLIPFREE_BUILD_BENCHMARKS)
  list(APPEND _flipfree_vtk_components CommonSystem IOGeometry IOPLY IOXML)
endif ()
if (BUILD_TESTING)
  list(APPEND _flipfree_vtk_components
    FiltersVerdict
    ImagingCore
    InteractionStyle
    RenderingFreeType
    RenderingOpenGL2
    TestingCore
    TestingRendering)
endif ()
if (FLIPFREE_WRAP_PYTHON OR BUILD_TESTING)
  # The wrapping and the tests need the interpreter that imports the distribution's vtkmodules, which
  # need not be the first one found.
  if (NOT DEFINED Python3_EXECUTABLE AND EXISTS "/usr/bin/python3")
    set(Python3_EXECUTABLE "/usr/bin/python3" CACHE FILEPATH "Python that imports vtkmodules")
  endif ()
endif ()
if (FLIPFREE_WRAP_PYTHON)
  find_package(Python3 COMPONENTS Interpreter Development REQUIRED)
  list(APPEND _flipfree_vtk_components Python WrappingPythonCore)
elseif (BUILD_TESTING)
  find_package(Python3 COMPONENTS Interpreter REQUIRED)
endif ()
list(REMOVE_DUPLICATES _flipfree_vtk_components)
# ParaView brings its own VTK, and two do not go together.
if (NOT ParaView_FOUND)
  find_package(VTK 9.1 REQUIRED COMPONENTS ${_flipfree_vtk_components})
endif ()

if (FLIPFREE_USE_ITK)
  # By name: the full list of components wants development files that nothing pulls in.
  set(_flipfree_itk_components
    ITKCommon
    ITKAnisotropicSmoothing
    ITKGDCM
    ITKIOGDCM
    ITKIOImageBase
    ITKIOMeta
    ITKIONRRD
    ITKVTK)
  # The methods that FlipFree is compared with; of Boost, headers alone.
  if (BUILD_TESTING OR FLIPFREE_BUILD_BENCHMARKS)
    find_package(Boost 1.71 REQUIRED CONFIG)
    list(APPEND _flipfree_itk_components
      ITKDeformableMesh
      ITKImageFeature
      ITKLevelSets
      ITKRegionGrowing)
  endif ()
  # ITK reads the configurations of all its modules, and ITKVtkGlue's finds the VTK that ITK was built with, which need
  # not be the one at hand. So that one counts as read: two of its headers are all that is used of it.
  set(ITKVtkGlue_LOADED TRUE)
  find_package(ITK 5.2 REQUIRED COMPONENTS ${_flipfree_itk_components})

  # An ITK refuses compilers other than the one it was built with, although Clang keeps GCC's binary interface.
  # Clang reads a copy of the header that asks, without the refusal, ahead of all others.
  set(FLIPFREE_ITK_COMPILE_OPTIONS "")
  unset(FLIPFREE_ITK_COMPILER_DETECTION CACHE) # of this ITK, not of one before
  find_file(FLIPFREE_ITK_COMPILER_DETECTION itk_compiler_detection.h HINTS ${ITK_INCLUDE_DIRS} NO_DEFAULT_PATH)
  mark_as_advanced(FLIPFREE_ITK_COMPILER_DETECTION)
  if (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND FLIPFREE_ITK_COMPILER_DETECTION)
    file(READ "${FLIPFREE_ITK_COMPILER_DETECTION}" _flipfree_itk_text)
    string(REPLACE "error Unsupported compiler" "pragma GCC system_header" _flipfree_itk_text "${_flipfree_itk_text}")
    set(_flipfree_itk_copy "${PROJECT_BINARY_DIR}/itk-for-clang/itk_compiler_detection.h")
    file(CONFIGURE OUTPUT "${_flipfree_itk_copy}" CONTENT "${_flipfree_itk_text}" @ONLY)
    set(FLIPFREE_ITK_COMPILE_OPTIONS -include "${_flipfree_itk_copy}")
  endif ()

  # Some distributions leave the module ITKVtkGlue out.
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
