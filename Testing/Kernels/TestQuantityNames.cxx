// Messages in the words of each front end.

#include "Error.h"
#include "MessageText.h"
#include "QuantityNames.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{

using namespace FlipFree;

const QuantityNames Options{ { "Reach", "--reach" }, { "SeedCenter", "--seed" } };

TEST(QuantityNames, AreThoseOfTheFrontEnd)
{
  const std::string message =
    "the image{ on port 0} ends here; raise {Reach}, or move {SeedCenter}";
  EXPECT_EQ(WithNames(message), "the image on port 0 ends here; raise Reach, or move SeedCenter");
  EXPECT_EQ(WithNames(message, Options), "the image ends here; raise --reach, or move --seed");
}

TEST(QuantityNames, AreThoseOfPropertiesWhereTheFrontEndHasNone)
{
  EXPECT_EQ(WithNames("set {Levels} or {Reach}", Options), "set Levels or --reach");
}

// An organ may have the name of a property, an apostrophe, or braces.
TEST(QuantityNames, LeaveTheNamesThatUsersGive)
{
  for (const char* const name : { "Reach", "{Reach}", "the patient's' Reach", "}{", "{{", "" })
  {
    EXPECT_EQ(WithNames(Quoted(name) + ": raise {Reach}", Options),
      "'" + std::string(name) + "': raise --reach");
  }
}

TEST(QuantityNames, TakeBracesThatEncloseNothingAsTheyAre)
{
  for (const char* const text : { "{", "}", "a { b", "a } b", "{}", "" })
  {
    EXPECT_EQ(WithNames(text, Options), text);
  }
}

TEST(QuantityNames, MayBeSaidInWordsBeforeTheFrontEndKnowsThem)
{
  const std::string message =
    Quoted("{Reach}") + ": the image{ on port 0} ends here; raise {Reach}, or move {SeedCenter}";
  const std::string worded = WithWords(message, { { "SeedCenter", "its {seed}" } });
  EXPECT_EQ(WithNames(worded, Options),
    "'{Reach}': the image ends here; raise --reach, or move its {seed}");
  EXPECT_EQ(WithWords(message, {}), message);
}

TEST(QuantityNames, OfAnErrorAreThoseOfPropertiesUntilAFrontEndWordsIt)
{
  const Error error(ErrorCode::OutOfRange, "lower {Reach} of " + Quoted("{liver}"));
  EXPECT_STREQ(error.what(), "lower Reach of '{liver}'");
  EXPECT_EQ(WithNames(MessageOf(error), Options), "lower --reach of '{liver}'");
  EXPECT_EQ(WithNames(MessageOf(std::runtime_error("not {Reach}")), Options), "not {Reach}");
}

} // namespace
