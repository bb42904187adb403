// Fields of a CSV against RFC 4180.
#include "runs/report/csv_field.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

TEST(CsvField, IsTheTextWhereNothingEndsAField) {
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("Wall 3 (north)"), "Wall 3 (north)");
}

TEST(CsvField, IsInQuotesElsewhere) {
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a;b"), "\"a;b\"");
  EXPECT_EQ(csv_field("two\nlines\r"), "\"two\nlines\r\"");
  EXPECT_EQ(csv_field("the \"best\""), "\"the \"\"best\"\"\"");
}

} // namespace
} // namespace meninas::test
