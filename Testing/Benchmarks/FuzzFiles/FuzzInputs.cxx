#include "FuzzInputs.h"

#include "SurfaceFile.h"
#include "VolumeFile.h"

#include "vtkImageData.h"
#include "vtkMedicalImageWriter.h"
#include "vtkNew.h"
#include "vtkPLYWriter.h"
#include "vtkPhantomSource.h"
#include "vtkPolyData.h"
#include "vtkQuadSphereSource.h"
#include "vtkSTLWriter.h"
#include "vtkTriangleFilter.h"
#include "vtkXMLPolyDataWriter.h"

#include "vtk_zlib.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace
{

constexpr int Sizes[3] = { 12, 10, 8 };
constexpr int NumberOfVoxels = 960;
constexpr double Spacing[3] = { 1, 1, 1.5 };

vtkSmartPointer<vtkPhantomSource> Ball()
{
  auto source = vtkSmartPointer<vtkPhantomSource>::New();
  source->SetShape(vtkPhantomSource::SPHERE);
  source->SetDimensions(Sizes[0], Sizes[1], Sizes[2]);
  source->SetSpacing(Spacing[0], Spacing[1], Spacing[2]);
  source->Update();
  return source;
}

template <typename T>
void Put(std::string& bytes, std::size_t offset, std::initializer_list<T> values)
{
  for (const T value : values)
  {
    std::memcpy(&bytes[offset], &value, sizeof(T));
    offset += sizeof(T);
  }
}

void AppendNumber(std::string& bytes, std::uint32_t number, int count)
{
  for (int byte = 0; byte < count; ++byte)
  {
    bytes += static_cast<char>(number >> 8 * byte & 255);
  }
}

/// One element of a DICOM file, little-endian with explicit types.
void AppendElement(std::string& bytes, std::uint32_t tag, const std::string& type,
  std::string value)
{
  value += value.size() % 2 ? (type == "UI" ? std::string(1, '\0') : " ") : "";
  AppendNumber(bytes, tag >> 16, 2);
  AppendNumber(bytes, tag & 0xFFFF, 2);
  bytes += type;
  const bool isLong = type == "OB" || type == "OW" || type == "SQ";
  if (isLong)
  {
    AppendNumber(bytes, 0, 2);
  }
  AppendNumber(bytes, static_cast<std::uint32_t>(value.size()), isLong ? 4 : 2);
  bytes += value;
}

std::string Short(int number)
{
  std::string bytes;
  AppendNumber(bytes, static_cast<std::uint32_t>(number), 2);
  return bytes;
}

std::string DicomSlice(const std::string& voxels, int slice)
{
  const std::string uid = "1.2.826.0.1.3680043.2.1143.78";
  const std::string instance = uid + ".1." + std::to_string(slice + 1);
  const std::string kind = "1.2.840.10008.5.1.4.1.1.2"; // CT
  std::string group;
  AppendElement(group, 0x00020001, "OB", std::string("\0\1", 2));
  AppendElement(group, 0x00020002, "UI", kind);
  AppendElement(group, 0x00020003, "UI", instance);
  AppendElement(group, 0x00020010, "UI", "1.2.840.10008.1.2.1");
  std::string bytes(128, '\0');
  bytes += "DICM";
  std::string length;
  AppendNumber(length, static_cast<std::uint32_t>(group.size()), 4);
  AppendElement(bytes, 0x00020000, "UL", length);
  bytes += group;
  AppendElement(bytes, 0x00080016, "UI", kind);
  AppendElement(bytes, 0x00080018, "UI", instance);
  AppendElement(bytes, 0x00080060, "CS", "CT");
  AppendElement(bytes, 0x0020000D, "UI", uid);
  AppendElement(bytes, 0x0020000E, "UI", uid + ".1");
  AppendElement(bytes, 0x00200013, "IS", std::to_string(slice + 1));
  AppendElement(bytes, 0x00200032, "DS", "0\\0\\" + std::to_string(Spacing[2] * slice));
  AppendElement(bytes, 0x00200037, "DS", R"(1\0\0\0\1\0)");
  AppendElement(bytes, 0x00280002, "US", Short(1));
  AppendElement(bytes, 0x00280004, "CS", "MONOCHROME2");
  AppendElement(bytes, 0x00280010, "US", Short(Sizes[1]));
  AppendElement(bytes, 0x00280011, "US", Short(Sizes[0]));
  AppendElement(bytes, 0x00280030, "DS", "1\\1");
  AppendElement(bytes, 0x00280100, "US", Short(16));
  AppendElement(bytes, 0x00280101, "US", Short(16));
  AppendElement(bytes, 0x00280102, "US", Short(15));
  AppendElement(bytes, 0x00280103, "US", Short(1));
  AppendElement(bytes, 0x00281052, "DS", "0");
  AppendElement(bytes, 0x00281053, "DS", "1");
  AppendElement(bytes, 0x7FE00010, "OW", voxels);
  return bytes;
}

std::string NrrdHeader(const std::string& encoding, const std::string& more = "")
{
  return "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: 12 "
         "10 "
         "8\nspace directions: (1,0,0) (0,1,0) (0,0,1.5)\nkinds: domain domain domain\nendian: "
         "little\nencoding: " +
    encoding + "\nspace origin: (0,0,0)\n" + more + "\n";
}

std::string MetaImageHeader(bool packed, const std::string& file, std::size_t size)
{
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = "
         "False\nCompressedData = " +
    std::string(packed ? "True\nCompressedDataSize = " + std::to_string(size) : "False") +
    "\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nCenterOfRotation = 0 0 "
    "0\nAnatomicalOrientation = RAI\nElementSpacing = 1 1 1.5\nDimSize = 12 10 8\nElementType = "
    "MET_UCHAR\nElementDataFile = " +
    file + "\n";
}

std::string ZlibOf(const std::string& bytes)
{
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(&packed[0]), &size,
    reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  packed.resize(size);
  return packed;
}

std::string Text(const std::string& voxels)
{
  std::string text;
  for (const char voxel : voxels)
  {
    text += std::to_string(static_cast<int>(voxel)) + " ";
  }
  return text + "\n";
}

/// Of version 1, as the command writes it; the others differ by what gives the orientation.
std::string Nifti(std::string bytes, int qform, int sform)
{
  Put<std::int16_t>(bytes, 252,
    { static_cast<std::int16_t>(qform), static_cast<std::int16_t>(sform) });
  return bytes;
}

std::string Nifti2(const std::string& voxels)
{
  std::string bytes(544, '\0');
  Put<std::int32_t>(bytes, 0, { 540 });
  bytes.replace(4, 8, std::string("n+2\0\r\n\x1a\n", 8));
  Put<std::int16_t>(bytes, 12, { 2, 8 });
  Put<std::int64_t>(bytes, 16, { 3, Sizes[0], Sizes[1], Sizes[2], 1, 1, 1, 1 });
  Put<double>(bytes, 104, { 1, Spacing[0], Spacing[1], Spacing[2] });
  Put<std::int64_t>(bytes, 168, { 544 });
  return bytes + voxels;
}

void AddVolumes(const std::string& folder, std::vector<FuzzInput>& inputs)
{
  const std::string nifti = ReadWhole(folder + "/truth.nii");
  const std::string voxels = nifti.substr(352, NumberOfVoxels);
  const auto add = [&](const FuzzInput& input) { inputs.push_back(input); };
  const auto binary = [&](const std::string& name, const std::string& main,
                        const std::map<std::string, std::string>& files) {
    add({ name, main, files, false, false, false, 400 });
  };
  const auto text = [&](const std::string& name, const std::string& main,
                      const std::map<std::string, std::string>& files) {
    add({ name, main, files, false, true, false, 400 });
  };

  binary("NIfTI-1", "a.nii", { { "a.nii", nifti } });
  binary("NIfTI-1 by its qform", "a.nii", { { "a.nii", Nifti(nifti, 1, 0) } });
  binary("NIfTI-1 by its sform", "a.nii", { { "a.nii", Nifti(nifti, 0, 1) } });
  add(
    { "NIfTI-1, gzip", "a.nii.gz", { { "a.nii.gz", Deflated(nifti) } }, false, false, true, 400 });
  std::string pair = nifti.substr(0, 348);
  pair.replace(344, 3, "ni1");
  Put<float>(pair, 108, { 0 });
  binary("NIfTI-1, pair", "a.hdr", { { "a.hdr", pair }, { "a.img", voxels } });
  pair.replace(344, 4, std::string(4, '\0'));
  binary("ANALYZE 7.5", "a.hdr", { { "a.hdr", pair }, { "a.img", voxels } });
  binary("NIfTI-2", "a.nii", { { "a.nii", Nifti2(voxels) } });

  const std::string detached = "data file: a.raw\n";
  text("NRRD, raw", "a.nrrd", { { "a.nrrd", NrrdHeader("raw") + voxels } });
  text("NRRD, gzip", "a.nrrd", { { "a.nrrd", NrrdHeader("gzip") + Deflated(voxels) } });
  text("NRRD, text", "a.nrrd", { { "a.nrrd", NrrdHeader("ascii") + Text(voxels) } });
  text("NRRD, detached", "a.nhdr",
    { { "a.nhdr", NrrdHeader("raw", detached) }, { "a.raw", voxels } });
  text("NRRD, detached, gzip", "a.nhdr",
    { { "a.nhdr", NrrdHeader("gzip", detached) }, { "a.raw", Deflated(voxels) } });

  const std::string packed = ZlibOf(voxels);
  text("MetaImage", "a.mha", { { "a.mha", MetaImageHeader(false, "LOCAL", 0) + voxels } });
  text("MetaImage, packed", "a.mha",
    { { "a.mha", MetaImageHeader(true, "LOCAL", packed.size()) + packed } });
  text("MetaImage, detached", "a.mhd",
    { { "a.mhd", MetaImageHeader(false, "a.raw", 0) }, { "a.raw", voxels } });
  text("MetaImage, detached, packed", "a.mhd",
    { { "a.mhd", MetaImageHeader(true, "a.zraw", packed.size()) }, { "a.zraw", packed } });

  FuzzInput series{ "DICOM", "", {}, false, false, false, 900 };
  constexpr std::size_t inSlice = 12 * 10;
  for (int slice = 0; slice < Sizes[2]; ++slice)
  {
    std::string wide;
    for (const char voxel : voxels.substr(static_cast<std::size_t>(slice) * inSlice, inSlice))
    {
      wide += voxel;
      wide += '\0';
    }
    series.Files["slice" + std::to_string(slice) + ".dcm"] = DicomSlice(wide, slice);
  }
  add(series);
}

template <typename Writer>
void Write(const std::string& name, vtkPolyData* surface, void (*prepare)(Writer*))
{
  vtkNew<Writer> writer;
  writer->SetFileName(name.c_str());
  writer->SetInputData(surface);
  prepare(writer);
  writer->Write();
}

void AddSurfaces(const std::string& folder, std::vector<FuzzInput>& inputs)
{
  for (const std::string name : { "appended.vtp", "text.vtp", "packed.vtp", "binary.stl",
         "text.stl", "binary.ply", "text.ply", "text.obj" })
  {
    const std::string ending = name.substr(name.find('.'));
    std::string format = name.substr(name.size() - 3);
    for (char& letter : format)
    {
      letter = static_cast<char>(letter - 'a' + 'A');
    }
    const bool isXml = ending == ".vtp";
    inputs.push_back({ format + ", " + name.substr(0, name.find('.')), "a" + ending,
      { { "a" + ending, ReadWhole((std::filesystem::path(folder) / name).string()) } }, true,
      name != "binary.stl", false, isXml ? std::size_t(1500) : std::size_t(200) });
  }
}

} // namespace

std::vector<FuzzInput> MakeFuzzInputs(const std::string& folder)
{
  std::vector<FuzzInput> inputs;
  AddVolumes(folder, inputs);
  AddSurfaces(folder, inputs);
  return inputs;
}

void WriteFuzzBases(const std::string& folder)
{
  auto source = Ball();
  Command::WriteVolume(folder + "/ball.nii", source->GetOutput());
  vtkNew<vtkMedicalImageWriter> volume;
  volume->SetInputData(source->GetLabelMap());
  volume->SetFileName((folder + "/truth.nii").c_str());
  volume->SetUseCompression(false);
  volume->Write();

  double seed[4];
  source->GetSeed(vtkPhantomSource::OBJECT, seed);
  vtkNew<vtkQuadSphereSource> sphere;
  sphere->SetCenter(seed);
  sphere->SetRadius(seed[3]);
  sphere->SetResolution(4);
  sphere->Update();
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(sphere->GetOutputPort());
  triangles->Update();

  Command::WriteSurface(folder + "/appended.vtp", sphere->GetOutput());
  Write<vtkXMLPolyDataWriter>(folder + "/text.vtp", sphere->GetOutput(),
    [](vtkXMLPolyDataWriter* writer) { writer->SetDataModeToAscii(); });
  Write<vtkXMLPolyDataWriter>(folder + "/packed.vtp", sphere->GetOutput(),
    [](vtkXMLPolyDataWriter* writer)
    {
      writer->SetDataModeToBinary();
      writer->SetCompressorTypeToZLib();
    });
  Command::WriteSurface(folder + "/binary.stl", sphere->GetOutput());
  Write<vtkSTLWriter>(folder + "/text.stl", triangles->GetOutput(),
    [](vtkSTLWriter* writer) { writer->SetFileTypeToASCII(); });
  Command::WriteSurface(folder + "/binary.ply", sphere->GetOutput());
  Write<vtkPLYWriter>(folder + "/text.ply", sphere->GetOutput(),
    [](vtkPLYWriter* writer) { writer->SetFileTypeToASCII(); });
  Command::WriteSurface(folder + "/text.obj", sphere->GetOutput());
}

std::string Inflated(const std::string& bytes)
{
  z_stream stream = {};
  std::string plain;
  inflateInit2(&stream, MAX_WBITS + 32);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  int state = Z_OK;
  while (state == Z_OK)
  {
    char part[4096];
    stream.next_out = reinterpret_cast<Bytef*>(part);
    stream.avail_out = sizeof(part);
    state = inflate(&stream, Z_NO_FLUSH);
    plain.append(part, sizeof(part) - stream.avail_out);
  }
  inflateEnd(&stream);
  return plain.empty() ? bytes : plain;
}

std::string Deflated(const std::string& bytes)
{
  z_stream stream = {};
  constexpr int gzip = MAX_WBITS + 16;
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, gzip, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(&packed[0]);
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::string ReadWhole(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

void WriteWhole(const std::string& name, const std::string& bytes)
{
  std::ofstream file(name, std::ios::binary);
  file << bytes;
  if (!file.flush())
  {
    throw std::runtime_error("'" + name + "' cannot be written.");
  }
}
