/**
 * Polygons that are checked as a file gives them, and the numbers of which it makes them.
 */
#ifndef FlipFreeCheckedPolygons_h
#define FlipFreeCheckedPolygons_h

#include <cstdint>
#include <string>
#include <vector>

namespace FlipFree
{

/// Throws a FileProblem of what is wrong in a file, a part of the message that ReadPolygonFile()
/// makes of it, which knows the file's name. All functions here throw it.
[[noreturn]] void RefusePolygons(const std::string& fault);

class CheckedPolygons
{
public:
  std::int64_t NumberOfPoints() const { return static_cast<std::int64_t>(this->Points.size() / 3); }

  void AddPoint(const double* point);

  /// After all points.
  void AddFace(const std::vector<std::int64_t>& vertices);

  /// From RAS to LPS.
  void SwapRasLps();

  const std::vector<double>& GetPoints() const { return this->Points; } ///< x, y, z of each
  const std::vector<int>& GetCorners() const { return this->Corners; }  ///< of all faces

  /// Where the corners of each face begin, and where the last ones end.
  const std::vector<int>& GetOffsets() const { return this->Offsets; }

private:
  std::vector<double> Points;
  std::vector<int> Corners;
  std::vector<int> Offsets{ 0 };
};

/// A number that takes up the whole word.
double NumberIn(const std::string& word);

std::int64_t IndexIn(double number);

/// Whether a comment says what 3D Slicer writes: that positions are RAS, where all others are LPS.
bool SaysRas(const std::string& comment);

} // namespace FlipFree

#endif
