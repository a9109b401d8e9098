/**
 * Private to the module, never installed: images from VTK to ITK and back, without a copy of the
 * voxels and with origin, spacing and direction matrix.
 *
 * Both ways go by ITK's bridge classes itk::VTKImageToImageFilter and itk::ImageToVTKImageFilter
 * where the ITK at hand has its module ITKVtkGlue. Where it has not, two stand-ins join the same
 * exporters and importers (itk::VTKImageImport and VTKImageExport of the module ITKVTK,
 * vtkImageExport and vtkImageImport) by the same callbacks.
 */
#ifndef FlipFreeItkVtkBridge_h
#define FlipFreeItkVtkBridge_h

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkImageExport.h"
#include "vtkImageImport.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include "itkImage.h"

#ifdef FLIPFREE_HAVE_ITKVTKGLUE
#include "itkImageToVTKImageFilter.h"
#include "itkVTKImageToImageFilter.h"
#else
#include "itkVTKImageExport.h"
#include "itkVTKImageImport.h"
#endif

#include <cstring>

namespace FlipFree
{

#ifdef FLIPFREE_HAVE_ITKVTKGLUE

template <typename TImage>
using VtkToItkFilter = itk::VTKImageToImageFilter<TImage>;
template <typename TImage>
using ItkToVtkFilter = itk::ImageToVTKImageFilter<TImage>;

#else

/// Hands each callback of the exporter to the importer; VTK and ITK name them alike.
template <typename TExporter, typename TImporter>
void Connect(TExporter* exporter, TImporter* importer)
{
  importer->SetUpdateInformationCallback(exporter->GetUpdateInformationCallback());
  importer->SetPipelineModifiedCallback(exporter->GetPipelineModifiedCallback());
  importer->SetWholeExtentCallback(exporter->GetWholeExtentCallback());
  importer->SetSpacingCallback(exporter->GetSpacingCallback());
  importer->SetOriginCallback(exporter->GetOriginCallback());
  importer->SetDirectionCallback(exporter->GetDirectionCallback());
  importer->SetScalarTypeCallback(exporter->GetScalarTypeCallback());
  importer->SetNumberOfComponentsCallback(exporter->GetNumberOfComponentsCallback());
  importer->SetPropagateUpdateExtentCallback(exporter->GetPropagateUpdateExtentCallback());
  importer->SetUpdateDataCallback(exporter->GetUpdateDataCallback());
  importer->SetDataExtentCallback(exporter->GetDataExtentCallback());
  importer->SetBufferPointerCallback(exporter->GetBufferPointerCallback());
  importer->SetCallbackUserData(exporter->GetCallbackUserData());
}

/// Stands in for itk::VTKImageToImageFilter.
template <typename TImage>
class VtkToItkFilter : public itk::VTKImageImport<TImage>
{
public:
  using Self = VtkToItkFilter;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  using itk::VTKImageImport<TImage>::SetInput;
  void SetInput(vtkImageData* image) { this->Exporter->SetInputData(image); }

protected:
  VtkToItkFilter() { Connect(this->Exporter.Get(), this); }

private:
  vtkNew<vtkImageExport> Exporter;
};

/// Stands in for itk::ImageToVTKImageFilter.
template <typename TImage>
class ItkToVtkFilter : public itk::ProcessObject
{
public:
  using Self = ItkToVtkFilter;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  using itk::ProcessObject::SetInput;
  void SetInput(const TImage* image) { this->Exporter->SetInput(image); }
  vtkImageData* GetOutput() { return this->Importer->GetOutput(); }
  void Update() override { this->Importer->Update(); }

protected:
  ItkToVtkFilter() { Connect(this->Exporter.GetPointer(), this->Importer.Get()); }

private:
  typename itk::VTKImageExport<TImage>::Pointer Exporter = itk::VTKImageExport<TImage>::New();
  vtkNew<vtkImageImport> Importer;
};

#endif

/// The image as ITK sees it. The voxels are shared and stay VTK's: they must outlive the result.
/// The scalars must be of type TPixel, with one component.
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer ShareWithItk(vtkImageData* image)
{
  auto filter = VtkToItkFilter<itk::Image<TPixel, 3>>::New();
  filter->SetInput(image);
  filter->Update();
  typename itk::Image<TPixel, 3>::Pointer result = filter->GetOutput();
  result->DisconnectPipeline();
  return result;
}

/// The image as VTK sees it. VTK takes over the voxels where the ITK image owns them, and copies
/// them where somebody else does.
template <typename TPixel>
vtkSmartPointer<vtkImageData> MoveToVtk(itk::Image<TPixel, 3>* image)
{
  auto filter = ItkToVtkFilter<itk::Image<TPixel, 3>>::New();
  filter->SetInput(image);
  filter->Update();
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->CopyStructure(filter->GetOutput());

  auto* container = image->GetPixelContainer();
  const auto count = static_cast<vtkIdType>(container->Size());
  vtkDataArray* imported = filter->GetOutput()->GetPointData()->GetScalars();
  auto scalars = vtk::TakeSmartPointer(imported->NewInstance());
  scalars->SetName("ImageScalars");
  if (container->GetContainerManageMemory())
  {
    // ITK allocates by new[].
    scalars->SetVoidArray(container->GetBufferPointer(), count, 0,
      vtkAbstractArray::VTK_DATA_ARRAY_DELETE);
    container->ContainerManageMemoryOff();
  }
  else
  {
    scalars->DeepCopy(imported);
  }
  result->GetPointData()->SetScalars(scalars);
  return result;
}

} // namespace FlipFree

#endif
