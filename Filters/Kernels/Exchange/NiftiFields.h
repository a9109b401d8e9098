/**
 * The bytes of a NIfTI header as numbers.
 */
#ifndef FlipFreeNiftiFields_h
#define FlipFreeNiftiFields_h

#include "Exchange/ByteOrder.h"

#include <cstdint>
#include <string>

namespace FlipFree
{

/// Of any version and byte order.
class NiftiFields
{
public:
  enum class Version
  {
    None,
    First = 348, // by the number of bytes
    Second = 540
  };

  explicit NiftiFields(const std::string& start)
    : Bytes(start)
  {
    for (const Version version : { Version::First, Version::Second })
    {
      for (const bool isBigEndian : { false, true })
      {
        this->HasBigEndian = isBigEndian;
        if (start.size() >= 4 && this->At<std::int32_t>(0) == static_cast<int>(version))
        {
          this->OwnVersion = version;
          return;
        }
      }
    }
  }

  Version GetVersion() const { return this->OwnVersion; }
  bool IsWhole() const { return this->Bytes.size() >= static_cast<std::size_t>(this->OwnVersion); }
  bool IsFirst() const { return this->OwnVersion == Version::First; }
  bool IsAnalyze() const
  {
    return this->IsFirst() && !this->HasMagic("n+1") && !this->HasMagic("ni1");
  }
  /// The voxels are in a file of their own.
  bool IsPair() const { return !this->HasMagic(this->IsFirst() ? "n+1" : "n+2"); }
  bool IsBigEndian() const { return this->HasBigEndian; }

  double Dimension(int index) const
  {
    return this->IsFirst() ? this->At<std::int16_t>(40 + 2 * index)
                           : static_cast<double>(this->At<std::int64_t>(16 + 8 * index));
  }
  int DataType() const { return this->At<std::int16_t>(this->IsFirst() ? 70 : 12); }
  double PixelDimension(int index) const { return this->Real(76, 104, index); }
  double VoxelOffset() const
  {
    return this->IsFirst() ? this->At<float>(108)
                           : static_cast<double>(this->At<std::int64_t>(168));
  }
  double Slope() const { return this->Real(112, 176, 0); }
  double Intercept() const { return this->Real(112, 176, 1); }
  int Units() const
  {
    return this->IsFirst() ? static_cast<unsigned char>(this->Bytes[123])
                           : this->At<std::int32_t>(500);
  }
  int QuaternionCode() const { return this->Code(252, 344); }
  int AffineCode() const { return this->Code(254, 348); }
  /// quatern_b, _c, _d, qoffset_x, _y, _z.
  double Quaternion(int index) const { return this->Real(256, 352, index); }
  /// srow_x, _y, _z, four numbers each.
  double Affine(int index) const { return this->Real(280, 400, index); }

private:
  bool HasMagic(const char* magic) const
  {
    return this->Bytes.compare(this->IsFirst() ? 344 : 4, 3, magic) == 0;
  }
  double Real(int first, int second, int index) const
  {
    return this->IsFirst() ? this->At<float>(first + 4 * index)
                           : this->At<double>(second + 8 * index);
  }
  int Code(int first, int second) const
  {
    return this->IsFirst() ? this->At<std::int16_t>(first) : this->At<std::int32_t>(second);
  }

  template <typename T>
  T At(int offset) const
  {
    return NumberFrom<T>(this->Bytes.data() + offset, this->HasBigEndian);
  }

  const std::string& Bytes;
  bool HasBigEndian = false;
  Version OwnVersion = Version::None;
};

} // namespace FlipFree

#endif
