// What `--stats` writes is described: docs/stats.md, and docs/trade.md for error estimates.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace meninas::test {
namespace {

using nlohmann::json;

void add_keys(const json& value, std::set<std::string>& keys) {
  if (value.is_object())
    for (const auto& [key, inner] : value.items())
      keys.insert(key);
  for (const auto& inner : value)
    if (inner.is_structured())
      add_keys(inner, keys);
}

TEST(StatsDocument, HasEveryKey) {
  const std::string docs = source_dir() + "/docs/";
  const std::string text = read_file(docs + "stats.md") + read_file(docs + "trade.md");
  TemporaryFolder folder;
  write_room(folder / "room.glb", tiny_room());
  const std::vector<std::vector<std::string>> runs{
      {"--quality", "draft"},
      {"--error", "0.5"},
      {"--mode", "reference", "--samples", "1"}};
  std::set<std::string> keys;
  for (const auto& more : runs) {
    std::vector<std::string> arguments{"render", "room.glb", "-o",    "a.exr",  "--stats",
                                       "a.json", "--size",   "16x16", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_program(folder.path(), arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    add_keys(json::parse(read_file(folder / "a.json")), keys);
  }
  EXPECT_GT(keys.size(), 60U);
  // As `key`, or in a path of keys, as `group.key`.
  const auto has = [&](const std::string& part) { return text.find(part) != std::string::npos; };
  for (const std::string& key : keys)
    EXPECT_TRUE(has('`' + key + '`') || has('`' + key + '.') || has('.' + key + '`')) << key;
}

} // namespace
} // namespace meninas::test
