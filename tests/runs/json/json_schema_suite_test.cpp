// The official test suite of JSON Schema (json-schema-org/JSON-Schema-Test-Suite, Debian's json-schema-test-suite),
// for the keywords of our schemas. Debian 12 has it up to draft 7, whose meaning of these keywords draft 2020-12 keeps;
// where it does not, the group is named below.
#include "runs/json/json_schema.h"
#include "scenes/errors.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>

namespace meninas {
namespace {

const std::filesystem::path suite = "/usr/share/json-schema-test-suite/tests/draft7";

/// Draft 7 overlooks what stands beside $ref, and 2020-12 does not.
const std::set<std::string> of_draft_7{"ref overrides any sibling keywords"};

/// Nothing where the schema has a keyword that ours do not have.
std::optional<bool> is_valid(const Json& data, const Json& schema) {
  static const std::filesystem::path file = "suite";
  try {
    check_schema({data, file, ""}, schema);
    return true;
  } catch (const InputError&) {
    return false;
  } catch (const std::logic_error&) {
    return std::nullopt;
  }
}

struct Count {
  int tried = 0, left_out = 0;
};

Count try_group(const std::string& keyword, const Json& group) {
  Count count;
  const auto about = group.at("description").get<std::string>();
  for (const Json& test : group.at("tests")) {
    const auto valid = of_draft_7.contains(about) ? std::nullopt
                                                  : is_valid(test.at("data"), group.at("schema"));
    ++(valid ? count.tried : count.left_out);
    if (valid) {
      EXPECT_EQ(*valid, test.at("valid").get<bool>())
          << keyword << ", " << about << ": " << test.at("description");
    }
  }
  return count;
}

TEST(JsonSchemaSuite, KeywordsOfOurSchemasMeanWhatTheStandardSays) {
  if (!std::filesystem::exists(suite))
    GTEST_SKIP() << "no json-schema-test-suite here: its tests are not tried";
  Count all;
  for (const std::string keyword :
       {"ref", "type", "enum", "anyOf", "required", "properties", "additionalProperties", "items",
        "minItems", "maxItems", "minLength", "minimum", "maximum", "exclusiveMinimum",
        "exclusiveMaximum", "default", "boolean_schema"}) {
    Count here;
    for (const Json& group : Json::parse(std::ifstream(suite / (keyword + ".json")))) {
      const Count one = try_group(keyword, group);
      here.tried += one.tried;
      here.left_out += one.left_out;
    }
    EXPECT_GT(here.tried, 0) << keyword;
    all.tried += here.tried;
    all.left_out += here.left_out;
  }
  RecordProperty("tried", all.tried);
  RecordProperty("left_out", all.left_out);
  EXPECT_GT(all.tried, 150) << all.left_out << " are left out";
}

} // namespace
} // namespace meninas
