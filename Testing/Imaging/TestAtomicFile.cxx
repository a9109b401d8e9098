// FlipFree::AtomicFile: the whole file or none, in place of the former one.
#include "AtomicFile.h"

#include "ExampleImages.h"

#include <functional>

namespace
{

namespace fs = std::filesystem;
using ExampleImages::Folder;
using ExampleImages::ReadBytes;
using ExampleImages::WriteBytes;
using FlipFree::AtomicFile;

void Replace(const std::string& name)
{
  AtomicFile file(name);
  WriteBytes(file.TemporaryName(), "new");
  file.Flush();
  file.Publish();
}

TEST(TestAtomicFile, TheFormerFileStaysUntilThenAndGivesItsPermissions)
{
  Folder folder;
  const auto mode = fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read;
  WriteBytes(folder / "file", "former");
  fs::permissions(folder / "file", mode);
  {
    AtomicFile file(folder / "file");
    WriteBytes(file.TemporaryName(), "new");
    file.Flush();
    EXPECT_EQ(ReadBytes(folder / "file"), "former");
  } // not published: an error, or an interrupt
  EXPECT_EQ(ReadBytes(folder / "file"), "former");
  EXPECT_EQ(folder.NumberOfFiles(), 1);
  Replace(folder / "file");
  EXPECT_EQ(ReadBytes(folder / "file"), "new");
  EXPECT_EQ(fs::status(folder / "file").permissions(), mode);
  EXPECT_EQ(folder.NumberOfFiles(), 1);
}

TEST(TestAtomicFile, SymbolicLinksAreFollowed)
{
  Folder folder;
  fs::create_directory(folder / "there");
  WriteBytes(folder / "there/file", "former");
  fs::create_symlink("there/file", folder / "link");
  fs::create_symlink("link", folder / "linkToLink");
  fs::create_symlink(folder / "there/none", folder / "dangling");
  Replace(folder / "linkToLink");
  Replace(folder / "dangling");
  EXPECT_EQ(ReadBytes(folder / "there/file"), "new");
  EXPECT_EQ(ReadBytes(folder / "there/none"), "new");
  for (const char* link : { "link", "linkToLink", "dangling" })
  {
    EXPECT_TRUE(fs::is_symlink(folder / link)) << link;
  }
}

TEST(TestAtomicFile, CompanionsAreMovedToo)
{
  Folder folder;
  AtomicFile file(folder / "volume.mhd");
  WriteBytes(file.TemporaryName(), "header");
  WriteBytes(fs::path(file.TemporaryName()).replace_filename("volume.raw").string(), "voxels");
  file.Flush();
  file.Publish();
  EXPECT_EQ(ReadBytes(folder / "volume.mhd"), "header");
  EXPECT_EQ(ReadBytes(folder / "volume.raw"), "voxels");
  EXPECT_EQ(folder.NumberOfFiles(), 2);
}

TEST(TestAtomicFile, WhatCannotBecomeAFileIsRefusedByName)
{
  Folder folder;
  const auto refuse =
    [&folder](const std::string& name, const std::string& why, const std::function<void()>& act)
  {
    try
    {
      act();
      ADD_FAILURE() << name << " was not refused";
    }
    catch (const FlipFree::FileError& error)
    {
      EXPECT_EQ(std::string(error.what()).find("'" + name + "' cannot be written: "), 0U);
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
    EXPECT_EQ(folder.NumberOfFiles(), 0) << name;
  };
  const auto open = [](const std::string& name) { return [name]() { AtomicFile file(name); }; };
  refuse(folder.Name(), "it is a folder", open(folder.Name()));
  refuse(folder / "none/file", "there is no folder", open(folder / "none/file"));
  refuse("/dev/null/file", "'/dev/null' is not a folder", open("/dev/null/file"));
  refuse("/dev/null", "not a regular file", open("/dev/null"));
  refuse("/proc/file", "does not take files", open("/proc/file"));
  refuse(folder / "unwritten", "No such file",
    [&]() { AtomicFile(folder / "unwritten").Publish(); });
}

} // namespace
