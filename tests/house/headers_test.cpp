#include "tests/house/headers.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* long_enough =
    "// Light that arrives at a point from all emitters that it sees, added up in order.";

std::vector<std::string> breaches_of(const std::string& path, std::vector<std::string> lines) {
  return header_breaches({{path, std::move(lines)}});
}

TEST(Headers, SayWhatTheyCompute) {
  EXPECT_THAT(header_breaches(read_source_tree(test::source_dir())), IsEmpty());
}

TEST(Headers, WithFewWordsAreCaught) {
  EXPECT_THAT(breaches_of("mirror/a.h", {"// Light at a point.", "struct A {};"}),
              ElementsAre(HasSubstr("mirror/a.h:1: 3 words")));
  EXPECT_THAT(breaches_of("runs/a.h", {"// Light at a point."}), IsEmpty());
}

TEST(Headers, OfQuantitiesHaveAnEquationOrASourceAndAUnit) {
  const std::string quantity = "std::vector<Rgb> light_at(int x);";
  EXPECT_THAT(breaches_of("radiosity/a.h", {long_enough, quantity}),
              ElementsAre(HasSubstr("radiosity/a.h:2: light_at returns a quantity")));
  for (const char* statement : {"//   H = sum_j F_j B_j", "// Lambert 1760"}) {
    EXPECT_THAT(breaches_of("radiosity/a.h", {long_enough, statement, "/// W/m^2", quantity}), IsEmpty())
        << statement;
    EXPECT_THAT(breaches_of("radiosity/a.h", {long_enough, statement, quantity}),
                ElementsAre(HasSubstr("no comment has a unit")));
  }
  for (const char* none : {"/// W/m^2", "/// W/m^2, of 2048", "/// W/m^2 -> W"})
    EXPECT_THAT(breaches_of("radiosity/a.h", {long_enough, none, quantity}),
                ElementsAre(HasSubstr("no comment has an equation or a source")))
        << none;
  EXPECT_THAT(breaches_of("radiosity/a.h", {long_enough, "bool is_lit(double x);"}), IsEmpty());
}

} // namespace
} // namespace meninas
