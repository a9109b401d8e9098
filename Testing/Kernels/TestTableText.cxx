// Tables as spreadsheet programs write them, and the points in them.
#include "Exchange/FileProblem.h"
#include "Exchange/PointTable.h"
#include "Exchange/TableText.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace FlipFree;

namespace
{

using Cells = std::vector<std::vector<std::string>>;

Cells CellsIn(const std::string& text)
{
  Cells cells;
  for (const TableLine& line : ReadTableText("a.csv", text).Lines)
  {
    cells.push_back(line.Cells);
  }
  return cells;
}

template <typename Read>
std::string RefusalBy(const Read& read)
{
  try
  {
    read();
  }
  catch (const FileProblem& problem)
  {
    return problem.what();
  }
  return {};
}

std::string PointRefusal(const std::string& text)
{
  return RefusalBy([&text] { ReadConstraintTable("a.csv", text); });
}

std::string TextOfPoints(const std::string& table)
{
  std::ostringstream text;
  for (const PointConstraint& point : ReadConstraintTable("a.csv", table))
  {
    text << NameOf(point.Kind);
    for (const double number : { point.Point[0], point.Point[1], point.Point[2], point.Radius })
    {
      text << " " << number;
    }
    text << "; ";
  }
  return text.str();
}

} // namespace

TEST(TableText, SeparatorsThatProgramsWrite)
{
  const Cells expected{ { "a", "b" }, { "1.5", "x y" } };
  for (const char* text : { "a,b\n1.5,x y\n", "a;b\n1.5;x y", "a\tb\r\n1.5\tx y\r\n",
         "sep=|\na|b\n1.5|x y\n", "\"SEP=;\"\r\na;b\n1.5;x y\n", "a ,\tb\n1.5 ,\tx y\n",
         "\n , \n\"a\" , \"b\"\n\n1.5,x y\n,,\n" })
  {
    EXPECT_EQ(CellsIn(text).front(), expected.front()) << text;
    EXPECT_EQ(CellsIn(text).back(), expected.back()) << text;
    EXPECT_EQ(CellsIn(text).size(), 2U) << text;
  }
  EXPECT_EQ(ReadTableText("a.csv", "1,5;2,5\n").Separator, ';'); // decimal commas
  EXPECT_EQ(ReadTableText("a.csv", "a,b;\n").Separator, ',');
  EXPECT_EQ(CellsIn("sep=;\ra;b\rc;d\r"), (Cells{ { "a", "b" }, { "c", "d" } }));
  EXPECT_TRUE(CellsIn("").empty());
  EXPECT_TRUE(CellsIn("sep=;").empty());
}

TEST(TableText, QuotesHoldSeparatorsLinesAndQuotes)
{
  const TableText table = ReadTableText("a.csv", "a,b\n\"1,\n2\",\"say \"\"x\"\"\"\nc,d\"e\n");
  ASSERT_EQ(table.Lines.size(), 3U);
  EXPECT_EQ(table.Lines[1].Cells, (std::vector<std::string>{ "1,\n2", "say \"x\"" }));
  EXPECT_EQ(table.Lines[2].Cells, (std::vector<std::string>{ "c", "d\"e" }));
  EXPECT_EQ(table.Lines[2].Number, 4);
  EXPECT_NE(RefusalBy([] { ReadTableText("a.csv", "a\n\"b,c\n"); }).find("'a.csv', line 2: "),
    std::string::npos);
}

TEST(TableText, DecimalCommas)
{
  using List = std::vector<std::string>;
  EXPECT_EQ(WithDecimalPoints("a.csv", List{ "1,5", "-,5e1", "1,5 2; 3 4,5", "a,b", "7" }),
    (List{ "1.5", "-.5e1", "1.5 2; 3 4.5", "a,b", "7" }));
  EXPECT_EQ(WithDecimalPoints("a.csv", List{ "1.5", "x,5" }), (List{ "1.5", "x,5" }));
  const std::string both = RefusalBy([] { WithDecimalPoints("a.csv", { "1,234", "2", "3.5" }); });
  EXPECT_NE(both.find("decimal point (3.5), and others a comma (1,234)"), std::string::npos)
    << both;
}

TEST(TableText, IsReadAsItWasWritten)
{
  const std::string text = TextOfTable({ "name", "a \"b\"", "number" },
    { { std::string("one, two"), std::int64_t{ -7 }, 0.1 },
      { std::string("lines\nof two"), std::int64_t{ 9007199254740993 }, 1e-5 } });
  EXPECT_EQ(text,
    "name,\"a \"\"b\"\"\",number\n\"one, two\",-7,0.1\n\"lines\nof two\",9007199254740993,1e-05\n");
  const TableText table = ReadTableText("a.csv", text);
  ASSERT_EQ(table.Lines.size(), 3U);
  EXPECT_EQ(table.Lines[0].Cells[1], "a \"b\"");
  EXPECT_EQ(table.Lines[1].Cells, (std::vector<std::string>{ "one, two", "-7", "0.1" }));
  EXPECT_EQ(table.Lines[2].Cells[0], "lines\nof two");
}

TEST(PointTable, ColumnsInAnyOrderAndForm)
{
  const std::string expected = "inside 1.5 2 3 0; seed 4 5 6 7.25; ";
  for (const char* text :
    { "inside,1.5,2,3\nseed,4,5,6,7.25\n", "kind,x,y,z,radius\ninside,1.5,2,3,\nseed,4,5,6,7.25\n",
      "Radius,Z,Y,X,Kind\n,3,2,1.5,INSIDE\n7.25,6,5,4,seed\n",
      "kind;x;y;z;radius\ninside;1,5;2;3;\nseed;4;5;6;7,25\n", "inside;1,5;2;3\nseed;4;5;6;7,25\n",
      "sep=;\nkind;x;y;z;radius\ninside;1.5;2;3;\nseed;4;5;6;7.25\n",
      "kind\tx\ty\tz\tradius\ninside\t1.5\t2\t3\nseed\t4\t5\t6\t7.25\n" })
  {
    EXPECT_EQ(TextOfPoints(text), expected) << text;
  }
  EXPECT_EQ(TextOfPoints("kind,x,y,z\n"), "");
  const std::vector<Eigen::Vector3d> places = ReadPlaceTable("a.csv", "1,5;2,5;3,5\n");
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0], Eigen::Vector3d(1.5, 2.5, 3.5));
  EXPECT_EQ(ReadPlaceTable("a.csv", "z,y,x\n3,2,1\n").at(0), Eigen::Vector3d(1, 2, 3));
}

TEST(PointTable, AWrongHeaderOrLineIsSaid)
{
  const std::string header =
    "'a.csv', line 1: the header must be kind, x, y, z and, for seeds, radius, in any order.";
  for (const char* text : { "x,y,z\n1,2,3\n", "kind,x,y\n", "kind,x,y,z,name\n", "kind,x,x,y,z\n",
         "type,x,y,z\ninside,1,2,3\n", "label;l;p;s\n" })
  {
    EXPECT_EQ(PointRefusal(text), header) << text;
  }
  const std::string places =
    RefusalBy([] { ReadPlaceTable("a.csv", "kind,x,y,z\ninside,1,2,3\n"); });
  EXPECT_EQ(places, "'a.csv', line 1: the header must be x, y, z, in any order.");
  // What takes places alone is named for these only, as they may be in the wrong place.
  for (const char* text : { "x,y,z\n1,2,3\n", "Z,y,x\n", "1,2,3\n", "1,5;2;3\n", "inside,1,2\n" })
  {
    const std::string refusal = RefusalBy([text] { ReadConstraintTable("a.csv", text, "B"); });
    const bool isNamed =
      refusal.find("; a table of x, y and z alone is for B.") != std::string::npos;
    EXPECT_EQ(isNamed, text[0] != 'i') << refusal;
  }
  const std::pair<const char*, const char*> lines[] = {
    { "inside,1,2\n", "line 1: 3 cells; needed" },
    { "inside,here,there,3\n", "line 1: 'here' is not" },
    { "inside,a,b,c\n", "line 1: 'a' is not" },
    { "kind,x,y,z\ninside,1,2,3,4\n", "line 2: 5 cells" },
    { "kind,,x,y,z\ninside,5,1,2,3\n", "line 2: 5 cells" }, { "seed,1,2,3\n", "has no radius" },
    { "above,1,2,3\n", "the kind is 'above'" },
    { "kind,x,y,z\ninside,1,,3\n", "line 2: the column y is empty" },
    { "inside,1,2,,4\n", "line 1: the column z is empty" },
    { "z,y,x,kind\n,1,2,inside\n", "line 2: the column z is empty" },
    { ",1,2,3\n", "line 1: the column kind is empty" },
    { "inside,1,0x10,3\n", "'0x10' is not a number" }, { "inside,1,2,1e999\n", "is not a number" }
  };
  for (const auto& [text, words] : lines)
  {
    EXPECT_NE(PointRefusal(text).find(words), std::string::npos) << PointRefusal(text);
  }
}
