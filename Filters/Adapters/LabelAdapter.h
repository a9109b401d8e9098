/**
 * Private to the modules, never installed: one label of a label map as the mask that kernels
 * measure, and the voxels inside a surface as a label map.
 */
#ifndef FlipFreeLabelAdapter_h
#define FlipFreeLabelAdapter_h

#include "ExecutionAdapter.h"
#include "FiniteVoxels.h"
#include "Image/BitMask.h"
#include "ImageAdapter.h"
#include "Mesh/SurfaceVoxelization.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <mutex>
#include <new>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace FlipFree
{

/// The voxels with a label, or all that are not 0 for a negative one. Throws std::invalid_argument,
/// naming the image by `name`, when it has no voxels or no proper grid, no scalars of one
/// component, scalars of bits, or a voxel that is not a finite number.
inline BitMask MaskOf(vtkImageData* image, int label, const std::string& name)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (image->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument(name + " has no voxels; connect a label map");
  }
  if (!scalars || scalars->GetNumberOfComponents() != 1 ||
    scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw std::invalid_argument(
      name + " has no scalars of one component per voxel; make its label array the active scalars");
  }
  RequireProperGrid(image, name);
  return VisitVoxels(image, name,
    [&](const auto& view)
    {
      using Value = std::decay_t<decltype(*view.Data)>;
      RequireFiniteAs<Value>(view, WholeBox(view.Geometry), name, "a label map holds whole numbers",
        NeverStop);
      if (label < 0)
      {
        return VoxelsWhere(
          view, [](Value value) { return value != Value(0); }, SMPFor);
      }
      // Compared in their own type; a label that the type cannot represent does not occur.
      const auto sought = static_cast<Value>(label);
      return static_cast<double>(sought) == label
        ? VoxelsWhere(
            view, [sought](Value value) { return value == sought; }, SMPFor)
        : BitMask(view.Geometry);
    });
}

/// The lowest few of the values inserted, whatever their order.
class LowestValues
{
public:
  explicit LowestValues(std::size_t most)
    : Most(most)
  {
  }
  void Insert(double value)
  {
    if (this->Values.size() == this->Most && value > *this->Values.rbegin())
    {
      this->More = true;
      return;
    }
    this->Values.insert(value);
    if (this->Values.size() > this->Most)
    {
      this->Values.erase(std::prev(this->Values.end()));
      this->More = true;
    }
  }
  void Insert(const LowestValues& others)
  {
    for (const double value : others.Values)
    {
      this->Insert(value);
    }
    this->More = this->More || others.More;
  }

  const std::set<double>& Get() const { return this->Values; } ///< ascending
  bool AreThereMore() const { return this->More; }

private:
  std::set<double> Values;
  std::size_t Most;
  bool More = false;
};

/// The values of a label map's voxels. Valid labels are kept apart from other values, of which an
/// image that is no label map, a scan or a probability map, has many.
struct LabelValues
{
  LowestValues Labels{ 20 }; ///< whole numbers from 1 to the greatest int
  LowestValues Others{ 3 };  ///< neither such a number nor 0

  void Insert(double value)
  {
    const bool isLabel =
      value >= 1 && value <= std::numeric_limits<int>::max() && value == std::floor(value);
    (isLabel ? this->Labels : this->Others).Insert(value);
  }
  /// Whether there are two values or more besides 0.
  bool AreSeveral() const { return this->Labels.Get().size() + this->Others.Get().size() > 1; }
};

/// Of an image that has passed MaskOf().
inline LabelValues LabelsOf(vtkImageData* image)
{
  LabelValues labels;
  std::mutex mutex;
  VisitVoxels(image, "the label map",
    [&](const auto& view)
    {
      using Value = std::decay_t<decltype(*view.Data)>;
      SMPFor(0, image->GetNumberOfPoints(),
        [&](std::ptrdiff_t first, std::ptrdiff_t last)
        {
          LabelValues found;
          Value latest = 0; // neighbors mostly have the same
          for (std::ptrdiff_t voxel = first; voxel < last; ++voxel)
          {
            if (view.Data[voxel] != latest && view.Data[voxel] != Value(0))
            {
              latest = view.Data[voxel];
              found.Insert(static_cast<double>(latest));
            }
          }
          const std::lock_guard<std::mutex> lock(mutex);
          labels.Labels.Insert(found.Labels);
          labels.Others.Insert(found.Others);
        });
    });
  return labels;
}

/// "1, 2, 6", followed by "and more" if there are more, with enough digits to tell them apart.
inline std::string TextOf(const LowestValues& values)
{
  std::ostringstream text;
  text.precision(15);
  for (const double value : values.Get())
  {
    text << (value == *values.Get().begin() ? "" : ", ") << value;
  }
  text << (values.AreThereMore() ? " and more" : "");
  return text.str();
}

/// Makes `labelMap` a label map with the geometry of `image`: scalars `Labels`, unsigned char, the
/// label in the runs' voxels and 0 in all others.
inline void MakeLabelMap(const std::vector<VoxelRun>& runs, unsigned char label,
  vtkImageData* image, vtkImageData* labelMap)
{
  // The system provides large blocks cleared, page by page on first use; most of a volume is never
  // touched.
  const auto size = static_cast<std::size_t>(image->GetNumberOfPoints());
  auto* const voxels = static_cast<unsigned char*>(std::calloc(std::max<std::size_t>(size, 1), 1));
  if (!voxels)
  {
    throw std::bad_alloc();
  }
  vtkNew<vtkUnsignedCharArray> labels;
  labels->SetName("Labels");
  labels->SetArray(voxels, image->GetNumberOfPoints(), 0,
    vtkUnsignedCharArray::VTK_DATA_ARRAY_FREE);
  FillRuns(runs, label, GeometryOf(image), voxels);
  labelMap->CopyStructure(image);
  labelMap->GetPointData()->SetScalars(labels);
}

} // namespace FlipFree

#endif
