// Names of labels, in tables of several programs.
#include "Exchange/FileNames.h"
#include "Exchange/FileProblem.h"
#include "Exchange/LabelNameTable.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

using Names = std::map<int, std::string>;

Names NamesIn(const std::string& text)
{
  return ReadLabelNameTable("a.csv", text);
}

std::string NameRefusal(const std::string& text)
{
  try
  {
    NamesIn(text);
  }
  catch (const FileProblem& problem)
  {
    return problem.what();
  }
  return {};
}

TEST(LabelNameTable, SeparatedByAnything)
{
  const Names expected{ { 1, "liver" }, { 3, "left kidney" } };
  EXPECT_EQ(NamesIn("1,liver\n3,left kidney\n"), expected);
  EXPECT_EQ(NamesIn("label,name\r\n1,liver\r\n\r\n3,\"left kidney\"\r\n"), expected);
  EXPECT_EQ(NamesIn("1;liver\n3;left kidney"), expected);
  EXPECT_EQ(NamesIn("sep=;\n1;liver\n3;left kidney"), expected);
  EXPECT_EQ(NamesIn("1\tliver\n3\tleft kidney\n"), expected);
  EXPECT_EQ(NamesIn("1 liver\n3   \"left kidney\"\n"), expected);
  EXPECT_EQ(NamesIn("1,liver\n3;left kidney\n"), expected);
  EXPECT_EQ(NamesIn("# of ours\n1;liver\n3;left kidney\n"), expected);
  EXPECT_EQ(NamesIn("# of ours\r1;liver\r3;left kidney\r"), expected);
  EXPECT_EQ(NamesIn("1,\"liver, \"\"right\"\"\"\n"), (Names{ { 1, "liver, \"right\"" } }));
  EXPECT_EQ(NamesIn("1,liver\n1,liver\n"), (Names{ { 1, "liver" } }));
}

TEST(LabelNameTable, OtherPrograms)
{
  const Names expected{ { 1, "liver" }, { 3, "left kidney" } };
  // BIDS, 3D Slicer's terminologies, a table with names first.
  EXPECT_EQ(NamesIn("index\tname\tcolor\n1\tliver\t#ff0000\n3\tleft kidney\t#00ff00\n"), expected);
  EXPECT_EQ(NamesIn("LabelValue,Name,Color_R\n1,liver,221\n3,left kidney,185\n"), expected);
  EXPECT_EQ(NamesIn("Name,Color,ID\nliver,red,1\nleft kidney,blue,3\n"), expected);
  // Colors of 3D Slicer and FreeSurfer; of ITK-SNAP, with names in quotes at the end.
  EXPECT_EQ(NamesIn("# Color table file a.ctbl\n# 2 values\n1 liver 221 130 101 255\n"
                    "3 left kidney 185 102 83 255\n"),
    expected);
  EXPECT_EQ(NamesIn("#No. Label Name: R G B A\n\n1  liver   221 130 101 0\n"
                    "3  left kidney  185 102 83\n"),
    expected);
  EXPECT_EQ(NamesIn("# IDX -R- -G- -B- -A-- VIS MSH LABEL\n"
                    "    1  255    0    0        1  1  1    \"liver\"\n"
                    "    3    0  255    0        1  1  1    \"left kidney\"\n"),
    expected);
  EXPECT_EQ(NamesIn("1,liver,221,130,101\n"), (Names{ { 1, "liver" } }));
  EXPECT_EQ(NamesIn("5 vertebra T 12\n"), (Names{ { 5, "vertebra T 12" } }));
}

TEST(LabelNameTable, Refusals)
{
  EXPECT_EQ(NameRefusal("nothing\n"), "'a.csv' names no labels. Give lines such as '5,liver'.");
  EXPECT_EQ(NameRefusal("\n# 1 liver\n"), NameRefusal(""));
  for (const std::string line : { "-1,liver", "1.5,liver", "3000000000,liver", "5", "5,", "liver,5",
         "nan,liver", "5,liver,left" })
  {
    EXPECT_EQ(NameRefusal("label,name\n" + line + "\n").empty(), line == "5,liver,left") << line;
    EXPECT_NE(NameRefusal("1,spleen\n" + line + "\n").find("'a.csv', line 2: '"), std::string::npos)
      << line;
  }
  const std::string twice = NameRefusal("1,spleen\n2,liver\n1,aorta\n");
  EXPECT_NE(twice.find("line 3: '1,aorta' names label 1, which is 'spleen'"), std::string::npos)
    << twice;
}

TEST(LabelNameTable, NamesAsPartsOfFileNames)
{
  EXPECT_EQ(FileNamePart("left kidney"), "left_kidney");
  EXPECT_EQ(FileNamePart("../a\\b\n\"c\".d-e_f"), ".._a_b__c_.d-e_f");
  EXPECT_EQ(FileNamePart("Nebenniere \xE2\x80\x93 groß"), "Nebenniere_\xE2\x80\x93_groß");
}

} // namespace
