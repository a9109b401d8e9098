// Headers of image files, the voxels that they describe, and files of surfaces.
#include "Answers.h"
#include "Volume.h"
#include "VoxelArrays.h"

#include "Deformation/Provenance.h"
#include "Exchange/NiftiHeader.h"
#include "Exchange/SegmentationLayers.h"
#include "Exchange/SurfaceBytes.h"
#include "Exchange/VolumeFileHeader.h"
#include "Exchange/VoxelDecoding.h"
#include "Exchange/VtpBytes.h"
#include "Mesh/ContourMesh.h"
#include "MessageText.h"

#include <emscripten/bind.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace FlipFree
{
namespace
{

/// A header whose files the package has found.
class VolumeFile
{
public:
  explicit VolumeFile(VolumeFileHeader header)
    : Header(std::move(header))
  {
  }

  void TakePackedFile() { TakePacked(this->Header.Storage); }

  val CheckFiles(const val& names, const val& sizes)
  {
    return Guarded(
      [&]
      {
        this->Header.Storage.Files = emscripten::vecFromJSArray<std::string>(names);
        RequireFiles(this->Header, emscripten::vecFromJSArray<double>(sizes));
        return this->Fields();
      });
  }

  /// { voxels } of as many voxels as the bytes hold, in their own typed array.
  val Decode(const std::string& stored)
  {
    return this->Decoded(stored.size() / SizeOf(this->Header.Storage.Type),
      [&](std::size_t count, void* values)
      { DecodeVoxels(this->Header, stored.data(), count, values); });
  }

  val DecodeText(const std::string& stored)
  {
    return this->Decoded(this->Header.NumberOfStoredVoxels(),
      [&](std::size_t, void* values) { DecodeDigits(this->Header, stored, values); });
  }

  /// { label, name, color } of each label that the file names.
  val Segments() const
  {
    val segments = val::array();
    for (const Segment& segment : SegmentsOf(this->Header))
    {
      val one = val::object();
      one.set("label", segment.Label);
      one.set("name", segment.Name);
      one.set("color", segment.Color);
      segments.call<void>("push", one);
    }
    return segments;
  }

  val Fields() const
  {
    const VolumeFileHeader& header = this->Header;
    val fields = val::object();
    SetGrid(fields, header.Geometry);
    fields.set("type", std::string(NameOf(header.ValueType())));
    fields.set("voxelBytes", static_cast<double>(SizeOf(header.Storage.Type)));
    fields.set("files", val::array(header.Storage.Files));
    fields.set("mayBePacked", header.Storage.MayBePacked);
    fields.set("form", std::string(NameOf(header.Storage.Form)));
    fields.set("offset", static_cast<double>(header.Storage.Offset));
    fields.set("lines", static_cast<double>(header.Storage.Lines));
    fields.set("skipped", static_cast<double>(header.Storage.Skipped));
    fields.set("isAtEnd", header.Storage.IsAtEnd);
    fields.set("layers", header.Layers.Count);
    fields.set("segments", this->Segments());
    fields.set("warnings", val::array(header.Warnings));
    return fields;
  }

private:
  template <typename Fill>
  val Decoded(std::size_t count, const Fill& fill)
  {
    return Guarded(
      [&]
      {
        val answer = val::object();
        answer.set("voxels",
          FilledArray(this->Header.ValueType(), count, [&](void* values) { fill(count, values); }));
        return answer;
      });
  }

  VolumeFileHeader Header;
};

// { file: VolumeFile, ... its fields } of the first bytes of a file.
val ReadHeader(const std::string& name, const std::string& start)
{
  return Guarded(
    [&]
    {
      const auto file = std::make_shared<VolumeFile>(ReadVolumeFileHeader(name, start));
      val answer = file->Fields();
      answer.set("file", file);
      return answer;
    });
}

val HeaderFiles(const std::string& name)
{
  return val::array(HeaderFilesOf(name));
}

// { bytes }.
val AnswerOfBytes(const std::string& bytes)
{
  val answer = val::object();
  answer.set("bytes", ArrayOf(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  return answer;
}

// What stands before voxels of one byte each.
val NiftiBytes(const std::string& name, const val& image)
{
  return Guarded(
    [&] { return AnswerOfBytes(NiftiHeaderOf(name, GeometryOf(image), VoxelType::UInt8)); });
}

VtpContent ContentOf(const val& result, const std::string& provenance)
{
  VtpContent content;
  const double certified = result["certified"].as<bool>() ? 1 : 0;
  content.Fields = { VtpNumbers("Certified", &certified, 1) };
  if (!provenance.empty())
  {
    content.Fields.push_back(VtpText("Provenance", provenance));
  }
  if (!result["label"].isUndefined()) // of a label map
  {
    const double label = result["label"].as<double>();
    content.Fields.push_back(VtpNumbers("Label", &label, 1));
  }
  if (!result["vertexConfidence"].isUndefined()) // of an organ
  {
    const double confidence = result["confidence"].as<double>();
    const auto values = emscripten::convertJSArrayToNumberVector<float>(result["vertexConfidence"]);
    content.Fields.push_back(VtpNumbers("Confidence", &confidence, 1));
    content.PointData.push_back(VtpNumbers("Confidence", values.data(), values.size()));
  }
  return content;
}

// Of { surface, certified, comments }; of an organ also { confidence, vertexConfidence }, of a
// label map's surface { label } and no comments.
val SurfaceFile(const val& result, const std::string& format, const std::string& provenance)
{
  return Guarded(
    [&]
    {
      const PolygonSurface surface = SurfaceOf(result["surface"], "the surface");
      if (format == "vtp")
      {
        return AnswerOfBytes(
          VtpBytes(surface.Points, surface.Faces, ContentOf(result, provenance)));
      }
      const auto comments = result["comments"].isUndefined()
        ? CommentsOn(provenance)
        : emscripten::vecFromJSArray<std::string>(result["comments"]);
      if (format == "obj")
      {
        return AnswerOfBytes(ObjBytes(surface.Points, surface.Faces, comments));
      }
      if (format != "stl" && format != "ply")
      {
        throw std::invalid_argument(
          "no surface is written as " + Quoted(format) + "; use vtp, stl, ply or obj");
      }
      const auto bytes = format == "stl" ? &StlBytes : &PlyBytes;
      return AnswerOfBytes(bytes(surface.Points, Triangulate(surface.Faces), comments));
    });
}

std::string WhyIncomplete(const std::string& name, bool isBroken)
{
  return IncompleteVoxels(name,
    isBroken ? Incompleteness::BrokenStream : Incompleteness::TooFewVoxels)
    .what();
}

} // namespace

void BindExchange()
{
  emscripten::class_<VolumeFile>("VolumeFile")
    .smart_ptr<std::shared_ptr<VolumeFile>>("VolumeFile")
    .function("takePacked", &VolumeFile::TakePackedFile)
    .function("checkFiles", &VolumeFile::CheckFiles)
    .function("decode", &VolumeFile::Decode)
    .function("decodeText", &VolumeFile::DecodeText);
  emscripten::constant("headerBytes", static_cast<double>(BytesOfHeader));
  emscripten::constant("missingFile", MissingFile);
  emscripten::function("headerFiles", &HeaderFiles);
  emscripten::function("readHeader", &ReadHeader);
  emscripten::function("niftiHeader", &NiftiBytes);
  emscripten::function("surfaceBytes", &SurfaceFile);
  emscripten::function("whyIncomplete", &WhyIncomplete);
}

} // namespace FlipFree
