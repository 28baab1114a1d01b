// SPDX-License-Identifier: BSD-3-Clause
#include "NearestNames.h"

#include <gtest/gtest.h>

namespace
{
using Names = std::vector<std::string>;

const Names Fruits = { "Apple", "Pear", "Banana", "Cherry" };
}

// Promise: a letter that is wrong, missing, too many or swapped with the next one is forgiven, and so
// are upper and lower case.
TEST(NearestNames, ForgivesMistakes)
{
  for (const char* mistyped :
    { "Banane", "Bnana", "Bananna", "Baanna", "BANANA", "banana", "nabana" })
  {
    EXPECT_EQ(NearestNames(mistyped, Fruits), Names{ "Banana" }) << mistyped;
  }
  EXPECT_EQ(NearestNames("Aplpe", Fruits), Names{ "Apple" });
}

// Promise: names of which more than a third would be wrong are not offered, however short or long what
// was typed is.
TEST(NearestNames, OffersNothingThatIsFar)
{
  EXPECT_EQ(NearestNames("Ananas!", Fruits), Names{});
  EXPECT_EQ(NearestNames("Paer!", Fruits), Names{});
  EXPECT_EQ(NearestNames("", Fruits), Names{});
  EXPECT_EQ(NearestNames(std::string(10000000, 'a'), Fruits), Names{});
  EXPECT_EQ(NearestNames("Apple", {}), Names{});
}

// Promise: the nearest comes first, equally near ones in the order they were given in, and there are no
// more than three.
TEST(NearestNames, TakesTheThreeNearest)
{
  EXPECT_EQ(NearestNames("abcdef", { "abcdxy", "abcdez", "abcdxx", "abcdef", "abcdeg" }),
    (Names{ "abcdef", "abcdez", "abcdeg" }));
}
