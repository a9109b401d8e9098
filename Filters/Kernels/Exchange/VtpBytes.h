/**
 * Surfaces and poly lines as the bytes of VTP files, VTK's XML format: positions in double
 * precision, and arrays by name. VtpHeader.h judges such files before VTK reads them.
 */
#ifndef FlipFreeVtpBytes_h
#define FlipFreeVtpBytes_h

#include "KernelTypes.h"

#include <string>
#include <vector>

namespace FlipFree
{

/// Numbers as a file stores them.
struct VtpArray
{
  std::string Name;
  const char* Type = "Float64"; ///< or Float32, Int32, UInt8; String: a text that ends with a 0
  int Components = 1;
  std::string Bytes; ///< little-endian
};

VtpArray VtpNumbers(const std::string& name, const double* values, std::size_t count,
  int components = 1);
VtpArray VtpNumbers(const std::string& name, const float* values, std::size_t count);
VtpArray VtpNumbers(const std::string& name, const int* values, std::size_t count);
VtpArray VtpNumbers(const std::string& name, const unsigned char* values, std::size_t count);
VtpArray VtpText(const std::string& name, const std::string& text);

struct VtpContent
{
  std::vector<VtpArray> Fields; ///< of the whole, one value each
  std::vector<VtpArray> PointData;
  std::vector<VtpArray> CellData;
  bool AreLines = false; ///< rather than polygons
};

std::string VtpBytes(const Eigen::Ref<const PointList>& points, const FaceList& cells,
  const VtpContent& content);

} // namespace FlipFree

#endif
