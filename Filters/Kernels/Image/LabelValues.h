/**
 * The labels of a label map: the voxels of one of them, and which there are.
 */
#ifndef FlipFreeLabelValues_h
#define FlipFreeLabelValues_h

#include "Image/BitMask.h"
#include "Image/FiniteVoxels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>

namespace FlipFree
{

/// The voxels with a label, or all nonzero voxels for a negative one. Throws Error, naming the
/// image by `name`, when a voxel is not a finite number.
template <typename T>
BitMask MaskOfLabel(const ImageView<T>& image, int label, const std::string& name,
  const Threading& threading)
{
  RequireFiniteAs<T>(image, WholeBox(image.Geometry), name, "a label map holds whole numbers",
    threading, NeverStop);
  if (label < 0)
  {
    return VoxelsWhere(
      image, [](T value) { return value != T(0); }, threading.For);
  }
  // Compared in their own type; a label that the type cannot represent does not occur.
  const auto sought = static_cast<T>(label);
  return static_cast<double>(sought) == label
    ? VoxelsWhere(
        image, [sought](T value) { return value == sought; }, threading.For)
    : BitMask(image.Geometry);
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
/// image that is not a label map, a scan or a probability map, has many.
struct LabelValues
{
  /// Organs of one label map. Of six scans, those in MR have 421 to 1802 values, and the CT 2598.
  static constexpr std::size_t MostOrgans = 255;
  /// The largest atlases, of which one label is chosen, have as many.
  static constexpr std::size_t Most = 1000;

  LowestValues Labels{ 20 };      ///< whole numbers from 1 to the greatest int
  LowestValues Others{ 3 };       ///< neither such a number nor 0
  LowestValues Different{ Most }; ///< all but 0

  void Insert(double value)
  {
    const bool isLabel =
      value >= 1 && value <= std::numeric_limits<int>::max() && value == std::floor(value);
    (isLabel ? this->Labels : this->Others).Insert(value);
    this->Different.Insert(value);
  }
  void Insert(const LabelValues& others)
  {
    this->Labels.Insert(others.Labels);
    this->Others.Insert(others.Others);
    this->Different.Insert(others.Different);
  }
  /// Whether there are two values or more besides 0.
  bool AreSeveral() const { return this->Labels.Get().size() + this->Others.Get().size() > 1; }
  /// Whether they are those of a scan or of probabilities. A single value marks a mask, whatever
  /// it is.
  bool AreNoLabels() const { return this->AreSeveral() && !this->Others.Get().empty(); }
  /// Whether no label map has them of which `label` is chosen, or all that are not 0 if it is
  /// negative: there are too many, or fractions. A few negative numbers may be marks beside the
  /// labels.
  bool AreGrayValues(int label) const
  {
    const std::set<double>& others = this->Others.Get();
    return this->Different.AreThereMore() || this->Others.AreThereMore() ||
      (label < 0 && this->Different.Get().size() > MostOrgans) ||
      (this->AreSeveral() &&
        std::any_of(others.begin(), others.end(),
          [](double value) { return value != std::floor(value); }));
  }
};

/// Of an image whose voxels are finite.
template <typename T>
LabelValues LabelsIn(const ImageView<T>& image, const ParallelFor& parallelFor)
{
  LabelValues labels;
  std::mutex mutex;
  parallelFor(0, static_cast<std::ptrdiff_t>(image.Geometry.NumberOfVoxels()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      LabelValues found;
      T latest = 0; // neighbors mostly have the same
      for (std::ptrdiff_t voxel = first; voxel < last; ++voxel)
      {
        if (image.Data[voxel] != latest && image.Data[voxel] != T(0))
        {
          latest = image.Data[voxel];
          found.Insert(static_cast<double>(latest));
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      labels.Insert(found);
    });
  return labels;
}

/// A label map with voxels of any type, which somebody else owns.
struct LabelVolume
{
  std::string Name; ///< in messages
  ImageGeometry Geometry;
  std::function<BitMask(int label)> MaskOf; ///< MaskOfLabel()
  std::function<LabelValues()> Values;      ///< LabelsIn(), if all voxels are finite
};

template <typename T>
LabelVolume LabelVolumeOf(const ImageView<T>& labels, const std::string& name,
  const Threading& threading)
{
  return { name, labels.Geometry,
    [labels, name, threading](int label) { return MaskOfLabel(labels, label, name, threading); },
    [labels, threading] { return LabelsIn(labels, threading.For); } };
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

/// A message for a label map whose values are those of a scan or of probabilities, with its remedy:
/// what is taken nevertheless, of the label or, for a label below 1, of all nonzero voxels. `what`
/// is done with these voxels. Empty for any other label map.
inline std::string WarningOfNoLabels(const LabelValues& values, int label, const std::string& name,
  const std::string& what)
{
  return values.AreNoLabels()
    ? "Of the values of " + name + ", " + TextOf(values.Others) + " are not valid labels; " +
      (label < 1 ? "every nonzero voxel" : "only a voxel of exactly " + std::to_string(label)) +
      " " + what + "; give a label map, of whole numbers from 0 up."
    : std::string();
}

} // namespace FlipFree

#endif
