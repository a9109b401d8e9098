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
  const ImageGeometry geometry = GeometryOf(image);
  BitMask mask;
  const auto select = [&](const auto* values)
  {
    using Value = std::decay_t<decltype(*values)>;
    const ImageView<Value> view{ values, geometry };
    RequireFiniteAs<Value>(view, WholeExtent(geometry), name, "a label map holds whole numbers",
      NeverStop);
    // Compared in their own type, many at once; a label that this type does not have is nowhere.
    const auto sought = static_cast<Value>(label);
    if (label < 0)
    {
      mask = VoxelsWhere(
        view, [](Value value) { return value != Value(0); }, SMPFor);
    }
    else if (static_cast<double>(sought) == label)
    {
      mask = VoxelsWhere(
        view, [sought](Value value) { return value == sought; }, SMPFor);
    }
    else
    {
      mask = BitMask(geometry);
    }
  };
  switch (scalars->GetDataType())
  {
    vtkTemplateMacro(select(static_cast<const VTK_TT*>(scalars->GetVoidPointer(0))));
    default:
      RefuseScalarType(scalars, name);
  }
  return mask;
}

/// The lowest few of the values inserted, however many there are: the same in whatever order, and
/// through whatever parts, they get here.
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

/// The values of a label map's voxels. Those that can be asked for are apart from others, of which
/// an image that is no label map, a scan or a map of probabilities, has many.
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
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  const auto collect = [&](const auto* values)
  {
    using Value = std::decay_t<decltype(*values)>;
    SMPFor(0, scalars->GetNumberOfTuples(),
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        LabelValues found;
        Value latest = 0; // neighbors mostly have the same
        for (std::ptrdiff_t voxel = first; voxel < last; ++voxel)
        {
          if (values[voxel] != latest && values[voxel] != Value(0))
          {
            latest = values[voxel];
            found.Insert(static_cast<double>(latest));
          }
        }
        const std::lock_guard<std::mutex> lock(mutex);
        labels.Labels.Insert(found.Labels);
        labels.Others.Insert(found.Others);
      });
  };
  switch (scalars->GetDataType())
  {
    vtkTemplateMacro(collect(static_cast<const VTK_TT*>(scalars->GetVoidPointer(0))));
    default:
      break; // MaskOf has refused it
  }
  return labels;
}

/// "1, 2, 6", with "and more" behind where there are. All digits that tell them apart.
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
  // The system hands out large memory cleared, and that of a page only once it is touched: most of
  // a volume never is.
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
