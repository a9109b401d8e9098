/**
 * The elements of DICOM files: which of them matter to volumes, and their values as text (DICOM
 * PS3.5 and PS3.6).
 */
#ifndef FlipFreeDicomElements_h
#define FlipFreeDicomElements_h

#include "Exchange/ByteOrder.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace FlipFree
{

/// The value representation of an element that matters, where the file does not say it; else a null
/// pointer.
const char* TypeOfWantedElement(std::uint32_t tag);

/// Whether the elements of a functional group matter; other groups may hold the same tags in
/// another sense.
bool IsFunctionalGroup(std::uint32_t tag);

/// Value representations by how their elements tell their length: in two bytes, or in four.
bool IsShortDicomType(const std::string& type);
bool IsLongDicomType(const std::string& type);

/// At a place within the bytes.
template <typename T>
T DicomNumberAt(const std::string& bytes, std::size_t offset, bool isBigEndian)
{
  return NumberFrom<T>(bytes.data() + offset, isBigEndian);
}

/// A value of this representation; numbers are separated by backslashes, as texts are.
std::string DicomValueText(const std::string& bytes, const std::string& type, bool isBigEndian);

} // namespace FlipFree

#endif
