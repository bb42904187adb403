#include "tests/house/functions.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Function> read(std::vector<std::string> lines) {
  return functions_of({"mirror/a.cpp", std::move(lines)});
}

std::vector<std::string> names_of(const std::vector<Function>& functions) {
  std::vector<std::string> names;
  for (const Function& function : functions)
    names.push_back(function.name);
  return names;
}

TEST(Functions, AreShortAndTakeFewArguments) {
  EXPECT_THAT(function_breaches(read_source_tree(test::source_dir())), IsEmpty());
}

TEST(Functions, AreReadFromTheTree) {
  std::vector<std::string> names;
  for (const SourceFile& file : read_source_tree(test::source_dir()))
    if (file.path == "radiosity/pass_one.cpp" || file.path == "raytrace/two_pass.cpp")
      for (const Function& function : functions_of(file))
        names.push_back(function.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"on_elements", "solve_pass_one", "prepare_scene"}));
}

TEST(Functions, HaveNamesLinesAndParameters) {
  const auto functions = read({
      "#include <vector>",
      "namespace a {",
      "/// With { and ( in a comment.",
      "static std::map<int, int> f(const std::function<int(int, int)>& g, int b = h(1, 2),",
      "                            std::array<int, 3> c) {",
      "  const auto l = [&](int x, int y) { return x + y; };",
      "  return \"}\" + '}';",
      "}",
      "double none();",
      "} // namespace a",
  });
  ASSERT_THAT(names_of(functions), ElementsAre("f", "none"));
  EXPECT_EQ(functions[0].returned, "static std::map<int, int>");
  EXPECT_EQ(functions[0].line, 4U);
  EXPECT_EQ(functions[0].lines, 5U);
  EXPECT_EQ(functions[0].parameters, 3U);
  EXPECT_EQ(functions[1].parameters, 0U);
}

TEST(Functions, AreToldFromWhatLooksLikeThem) {
  EXPECT_THAT(names_of(read({
                  "using F = int(int);",
                  "constexpr std::array<int, 2> table{{f(1, 2), 3}};",
                  "enum class E { a, b };",
                  "const auto lambda = [](int a, int b) { return a + b; };",
                  "struct S {",
                  "  S(int a, int b) : a_{a}, b_(b) {}",
                  "  int operator()(int c) const { return c; }",
                  "  bool operator==(const S&) const = default;",
                  "  int a_ = 0, b_ = g(1);",
                  "};",
                  "struct alignas(64) A {",
                  "  void of_member(int a) { f(a); }",
                  "};",
                  "template <typename T> T twice(const T& t) { return 2 * t; }",
              })),
              ElementsAre("S", "", "", "of_member", "twice"));
}

TEST(Functions, ThatAreLongOrTakeManyArgumentsAreCaught) {
  std::vector<std::string> lines{"void f(int a, int b, int c, int d, int e, int g, int h) {"};
  lines.resize(60);
  lines.emplace_back("}");
  EXPECT_THAT(function_breaches({{"mirror/a.cpp", lines}}),
              ElementsAre(HasSubstr("mirror/a.cpp:1: f takes 61 lines"),
                          HasSubstr("mirror/a.cpp:1: f has 7 parameters")));
  EXPECT_THAT(function_breaches({{"tests/mirror/a.cpp", lines}}), IsEmpty());
}

} // namespace
} // namespace meninas
