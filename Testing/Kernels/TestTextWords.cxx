// Letters of texts, alike in every locale.
#include "Exchange/FileNames.h"
#include "TextWords.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

TEST(TextWords, SmallLettersAreThoseOfAscii)
{
  EXPECT_EQ(InSmallLetters("AZaz09[@`{"), "azaz09[@`{");
  EXPECT_EQ(InSmallLetters("\xC3\x84\xC4\xB0"), "\xC3\x84\xC4\xB0");
  EXPECT_EQ(WithSmallFirst("EdgeSNAP"), "edgeSNAP");
  EXPECT_EQ(WithSmallFirst(""), "");
  EXPECT_EQ(ExtensionOf("a.b/C.NII.Gz"), ".gz");
  EXPECT_EQ(ExtensionOf("a.b/c"), "");
  EXPECT_TRUE(IsDicomDirectory("disk/DicomDir"));
  EXPECT_FALSE(IsDicomDirectory("disk/dicomdir2"));
  EXPECT_FALSE(IsDicomDirectory("disk/dicom"));
}

TEST(TextWords, Utf8)
{
  for (const char* const text : { "", "abc", "\xC3\xA4", "\xE2\x82\xAC", "\xF0\x9F\x98\x80" })
  {
    EXPECT_TRUE(IsUtf8(text)) << text;
  }
  for (const char* const text : { "\xE4", "a\xC3", "\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80" })
  {
    EXPECT_FALSE(IsUtf8(text)) << text;
  }
}

} // namespace
