#include "FuzzInputs.h"

#include "ExampleDicom.h"
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

/// Of a label map's slices, two bytes for each voxel.
std::vector<std::string> WideSlices(const std::string& voxels)
{
  constexpr std::size_t inSlice = 12 * 10;
  std::vector<std::string> slices(Sizes[2]);
  for (std::size_t index = 0; index < voxels.size(); ++index)
  {
    slices[index / inSlice] += std::string{ voxels[index], '\0' };
  }
  return slices;
}

std::string HeightOf(int slice)
{
  return "0\\0\\" + std::to_string(Spacing[2] * slice);
}

ExampleDicom::Options DicomOptions(int slice)
{
  ExampleDicom::Options options;
  options.Instance = std::string(ExampleDicom::RootUID) + ".1." + std::to_string(slice + 1);
  options.Position = HeightOf(slice);
  options.Spacing = "1\\1";
  options.Rows = Sizes[1];
  options.Columns = Sizes[0];
  options.HighBit = 15;
  return options;
}

/// Copies of up to 128 bytes; two planes, the high bytes first.
std::string RunLengths(const std::string& wide)
{
  std::string header(64, '\0');
  std::string planes[2];
  for (const std::size_t plane : { 0U, 1U })
  {
    for (std::size_t at = 1 - plane; at < wide.size(); at += 2)
    {
      planes[plane] += wide[at];
    }
    planes[plane].insert(0, 1, static_cast<char>(planes[plane].size() - 1));
    planes[plane].append(planes[plane].size() % 2, '\x80');
  }
  header[0] = 2;
  header[4] = 64;
  header[8] = static_cast<char>(64 + planes[0].size());
  return header + planes[0] + planes[1];
}

std::map<std::string, std::string> DicomSlices(const std::string& voxels, ExampleDicom::Coding how,
  bool hasHeader, bool isPacked)
{
  std::map<std::string, std::string> files;
  int number = 0;
  for (const std::string& pixels : WideSlices(voxels))
  {
    ExampleDicom::Options options = DicomOptions(number);
    options.How = how;
    options.Pixels = pixels;
    if (isPacked)
    {
      options.Fragments = { "", RunLengths(pixels) };
    }
    const ExampleDicom::DataSet data = ExampleDicom::Slice(options);
    files["slice" + std::to_string(number++) + ".dcm"] = hasHeader
      ? ExampleDicom::FileOf(data, isPacked ? "1.2.840.10008.1.2.5" : "1.2.840.10008.1.2.1")
      : data.Bytes;
  }
  return files;
}

std::string EnhancedDicom(const std::string& voxels, bool isDelimited)
{
  ExampleDicom::Options options = DicomOptions(0);
  std::vector<ExampleDicom::Frame> frames;
  for (const std::string& pixels : WideSlices(voxels))
  {
    options.Pixels += pixels;
    frames.push_back({ HeightOf(static_cast<int>(frames.size())), "1", 1, "1", "0" });
  }
  return ExampleDicom::FileOf(ExampleDicom::Enhanced(options, frames, isDelimited));
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

  using ExampleDicom::Coding;
  const auto folderOf = [&](const std::string& name,
                          const std::map<std::string, std::string>& files, std::size_t header) {
    add({ name, "", files, false, false, false, header });
  };
  folderOf("DICOM", DicomSlices(voxels, Coding::Explicit, true, false), 900);
  folderOf("DICOM, implicit, no header", DicomSlices(voxels, Coding::Implicit, false, false), 500);
  folderOf("DICOM, run lengths", DicomSlices(voxels, Coding::Explicit, true, true), 900);
  folderOf("DICOM, enhanced", { { "e.dcm", EnhancedDicom(voxels, false) } }, 4000);
  folderOf("DICOM, enhanced, delimited", { { "e.dcm", EnhancedDicom(voxels, true) } }, 4000);
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
