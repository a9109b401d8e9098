/**
 * Private to the modules, never installed: the properties of a filter, from one list.
 *
 * A property is a field of the settings that the filter's kernel takes, so that its default stands
 * there and nothing is copied. The filter's header declares and documents SetName() and GetName();
 * its source names the list (SegmentationParameters.h), and adds what is the filter's own:
 *
 *     #define FLIPFREE_STAGE vtkCorrespondenceSearch
 *     #define PROPERTIES(P)                       \
 *       P(Threshold, double, Threshold, 0, 1, "") \
 *       FLIPFREE_TARGET_PARAMETERS(P, Settings->)
 *     PROPERTIES(FLIPFREE_DEFINE_PROPERTY)
 *
 * which defines the two functions of each. The same list prints all of them, and rejects NaN. The
 * source ends with #undef of both, since several sources are compiled as one.
 */
#ifndef FlipFreeStageProperties_h
#define FlipFreeStageProperties_h

#include "Image/SeedRegion.h"
#include "PropertyCheck.h"

#include "vtkObject.h"

#include <type_traits>

namespace FlipFree
{

/// What a property takes: of an enumeration the number.
template <typename T>
using PropertyType = std::conditional_t<std::is_enum_v<T>, int, T>;

/// As vtkSetClampMacro: NaN passes.
template <typename T>
void SetClamped(vtkObject* stage, PropertyType<T> value, PropertyType<T> minimum,
  PropertyType<T> maximum, T& field)
{
  const T clamped = static_cast<T>(value < minimum ? minimum : (value > maximum ? maximum : value));
  if (field != clamped)
  {
    field = clamped;
    stage->Modified();
  }
}

/// In the range that the kernels give radii of seeds.
inline void SetSeedRadius(vtkObject* filter, double value, double& field)
{
  SetClamped(filter, value, MinimumSeedRadius, MaximumSeedRadius, field);
}

} // namespace FlipFree

#define FLIPFREE_DEFINE_PROPERTY(Name, type, field, minimum, maximum, ...)                         \
  void FLIPFREE_STAGE::Set##Name(FlipFree::PropertyType<type> value)                               \
  {                                                                                                \
    FlipFree::SetClamped<type>(this, value, minimum, maximum, this->field);                        \
  }                                                                                                \
  FlipFree::PropertyType<type> FLIPFREE_STAGE::Get##Name() const                                   \
  {                                                                                                \
    return static_cast<FlipFree::PropertyType<type>>(this->field);                                 \
  }

/// In PrintSelf(os, indent).
#define FLIPFREE_PRINT_PROPERTY(Name, type, field, ...)                                            \
  os << indent << #Name << ": " << static_cast<FlipFree::PropertyType<type>>(this->field) << "\n";

/// In the list that FlipFree::RequireNumbers() takes.
#define FLIPFREE_NAME_PROPERTY(Name, type, field, ...) { #Name, static_cast<double>(this->field) },

#endif
