#include "Answers.h"

#include "Deformation/ConvergenceColumns.h"
#include "Deformation/Provenance.h"
#include "Mesh/SurfaceTopology.h"

namespace FlipFree
{
namespace
{

val ColumnsOf(const std::vector<IterationRecord>& records)
{
  val columns = val::object();
  for (const TableColumn<IterationRecord>& column : ConvergenceColumns())
  {
    std::vector<double> values;
    for (const IterationRecord& record : records)
    {
      values.push_back(column.Read(record));
    }
    columns.set(column.Name, ArrayOf(values));
  }
  return columns;
}

} // namespace

PolygonSurface SurfaceOf(const val& surface, const std::string& name)
{
  const auto coordinates = emscripten::convertJSArrayToNumberVector<double>(surface["points"]);
  PolygonSurface copy;
  copy.Points = Eigen::Map<const PointList>(coordinates.data(),
    static_cast<Eigen::Index>(coordinates.size() / 3), 3);
  copy.Faces.Connectivity = emscripten::convertJSArrayToNumberVector<int>(surface["corners"]);
  copy.Faces.Offsets = emscripten::convertJSArrayToNumberVector<int>(surface["offsets"]);
  RequireValidFaces(copy.Points, copy.Faces, name);
  return copy;
}

val SurfaceObject(const PointList& points, const FaceList& faces)
{
  val surface = val::object();
  surface.set("points", ArrayOf(points));
  surface.set("corners", ArrayOf(faces.Connectivity));
  surface.set("offsets", ArrayOf(faces.Offsets));
  return surface;
}

val ArrayOf(const std::vector<VoxelRun>& runs)
{
  std::vector<int> numbers;
  numbers.reserve(4 * runs.size());
  for (const VoxelRun& run : runs)
  {
    numbers.insert(numbers.end(), { run.J, run.K, run.Begin, run.End });
  }
  return ArrayOf(numbers);
}

GrayVolume GrayVolumeOf(const Volume& image)
{
  return image.VisitVoxels([](const auto& view) { return GrayVolumeOf(view); });
}

LabelVolume LabelVolumeOf(const Volume& labels, const std::string& name)
{
  return labels.VisitVoxels(
    [&name](const auto& view) { return LabelVolumeOf(view, name, Threading()); });
}

val AnswerOf(const OrganSurface& organ, const Origin& origin, const std::vector<VoxelRun>& voxels,
  const std::vector<std::string>& warnings)
{
  val answer = val::object();
  answer.set("stopReason", std::string(ToString(organ.Reason)));
  answer.set("aborted", organ.Reason == StopReason::Aborted);
  answer.set("selfIntersections", static_cast<double>(organ.SelfIntersections));
  answer.set("surface", SurfaceObject(organ.Points, organ.Mesh.Faces));
  answer.set("certified", origin.IsCertified);
  answer.set("provenance", origin.Provenance);
  answer.set("comments", val::array(CommentsOn(origin.Provenance)));
  answer.set("runs", ArrayOf(voxels));
  answer.set("iterations", ColumnsOf(organ.Iterations));
  answer.set("warnings", val::array(warnings));
  return answer;
}

} // namespace FlipFree
