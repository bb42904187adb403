// `regress`: cases with references pass, fail with evidence, are made anew;
// files of cases that say nothing sensible are refused.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meninas::test {
namespace {

using json = nlohmann::ordered_json; // keeps the order in which settings are given
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

json tiny_case() {
  return {{"name", "room"},
          {"scene", "room.glb"},
          {"settings", {{"element-size", 0.2}, {"rays", 16}, {"size", "24x16"}, {"samples", 1}}},
          {"reference", "images/room.exr"},
          {"limits", {{"relmse", 1e-6}, {"max_abs", 0.01}}},
          {"relmse-epsilon", 1e-4}}; // the room is dim
}

class Regress : public testing::Test {
protected:
  Regress() { write_room(folder_ / "room.glb", tiny_room()); }

  void write(const json& cases) {
    std::ofstream(folder_ / "cases.json") << json{{"cases", cases}}.dump(1);
  }
  Outcome run(std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.begin(), {"regress", "cases.json", "--quiet"});
    return run_program(folder_.path(), arguments);
  }
  void brighten_lamp(double factor) {
    TinyRoom room = tiny_room();
    for (auto& material : room.root["materials"]) {
      if (material.contains("emissiveFactor")) {
        for (auto& channel : material["emissiveFactor"]) {
          channel = channel.get<double>() * factor;
        }
      }
    }
    write_room(folder_ / "room.glb", room);
  }
  /// A file of cases is refused with this error.
  void expect_refused(const json& regress_case, const std::string& line) {
    write(json::array({regress_case}));
    const Outcome outcome = run();
    EXPECT_EQ(outcome.err, "meninas: cases.json: " + line + '\n');
    EXPECT_EQ(outcome.code, 3) << line;
    EXPECT_THAT(outcome.out, IsEmpty());
  }

  TemporaryFolder folder_;
};

TEST_F(Regress, ReferencesAreMadeAndThenMet) {
  write(json::array({tiny_case()}));
  const Outcome missing = run();
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.out, testing::MatchesRegex("BROKEN   room: images/room.exr: no such "
                                                 "reference: 'meninas regress --update' makes it "
                                                 "\\([0-9.]+ s\\)\n"));
  EXPECT_EQ(missing.err, "meninas: cases.json: 1 of 1 cases failed: room\n");

  const Outcome updated = run({"--update"});
  EXPECT_EQ(updated.code, 0) << updated.err;
  EXPECT_THAT(updated.err, testing::Not(HasSubstr(" in "))) << "a case has one line";
  EXPECT_THAT(files_in(folder_ / "images"), ElementsAre("manifest.json", "room.exr"));
  const json entry = json::parse(read_file(folder_ / "images" / "manifest.json"))["room.exr"];
  EXPECT_EQ(entry["case"], "room");
  EXPECT_EQ(entry["command"],
            "meninas render room.glb -o images/room.exr --element-size 0.2 --rays "
            "16 --size 24x16 --samples 1");
  EXPECT_EQ(entry["samples"], 1);
  EXPECT_TRUE(entry["standard_error"].is_null());
  EXPECT_THAT(entry["program"], HasSubstr("meninas "));
  EXPECT_EQ(entry["scene_hash"].get<std::string>().size(), 16);
  EXPECT_THAT(entry["date"], testing::MatchesRegex("20..-..-..T..:..:..Z"));

  const Outcome met = run({"--junit", "results.xml", "--threads", "1"});
  EXPECT_EQ(met.code, 0) << met.out;
  EXPECT_THAT(met.out, HasSubstr("passed   room: relmse 0 (limit 1e-06), max_abs 0 (limit 0.01 W/m^2/sr)"));
  EXPECT_THAT(read_file(folder_ / "results.xml"),
              HasSubstr("tests=\"1\" failures=\"0\" errors=\"0\""));
  EXPECT_THAT(files_in(folder_.path()),
              ElementsAre("cases.json", "images", "results.xml", "room.glb"));
}

TEST_F(Regress, AFailureSaysWhatMovedAndLeavesEvidence) {
  write(json::array({tiny_case()}));
  ASSERT_EQ(run({"--update"}).code, 0);
  brighten_lamp(1.01);
  const Outcome outcome = run({"-o", "failures", "--junit", "results.xml"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "meninas: cases.json: 1 of 1 cases failed: room\n");
  EXPECT_THAT(outcome.out, testing::ContainsRegex(
                               "FAILED   room: relmse [0-9.e-]+ exceeds 1e-06(, .*)?; most at x "
                               "[0-9]+-[0-9]+, y [0-9]+-[0-9]+: [0-9.]+ % brighter; whole "
                               "picture (1|0.99) % brighter; worst pixel"));
  EXPECT_THAT(files_in(folder_ / "failures"),
              ElementsAre("room.exr", "room.heat.png", "room.reference.exr"));
  EXPECT_THAT(read_file(folder_ / "results.xml"), HasSubstr("<failure message=\"relmse"));

  // What passes again takes the evidence away.
  brighten_lamp(1.0);
  EXPECT_EQ(run({"-o", "failures"}).code, 0);
  EXPECT_THAT(files_in(folder_ / "failures"), IsEmpty());
}

TEST_F(Regress, CasesAreChosenByNameAndOneBrokenDoesNotStopTheRest) {
  json other = tiny_case();
  other["name"] = "elsewhere";
  other["scene"] = "missing.glb";
  write(json::array({other, tiny_case()}));
  const Outcome both = run({"--update"});
  EXPECT_EQ(both.code, 3);
  EXPECT_THAT(both.out, HasSubstr("BROKEN   elsewhere: missing.glb: no such file"));
  EXPECT_THAT(both.out, HasSubstr("updated  room: images/room.exr"));
  EXPECT_EQ(run({"--filter", "roo"}).code, 0);
  const Outcome none = run({"--filter", "rooom"});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.err, "meninas: --filter: no case is named like 'rooom', did you mean 'room'?\n");
}

TEST_F(Regress, TheStatisticalTestNeedsAVariance) {
  json statistical = tiny_case();
  statistical["limits"] = {{"z", 4.0}};
  write(json::array({statistical}));
  ASSERT_EQ(run({"--update"}).code, 0);
  const Outcome without = run();
  EXPECT_EQ(without.code, 3);
  EXPECT_THAT(without.out, HasSubstr("images/room.exr: no layer 'variance'"));

  // The picture itself with a standard error of 5 % of its values.
  const Image picture = read_image(folder_ / "images" / "room.exr").picture;
  Image variance = picture;
  for (glm::vec3& pixel : variance.pixels) {
    pixel *= 0.0025F * pixel;
  }
  const std::vector<Layer> layers{{"variance", variance}};
  write_exr(folder_ / "images" / "room.exr", picture, layers, PixelType::float32);
  EXPECT_THAT(run().out, HasSubstr("passed   room: z 0 (limit 4)"));
  brighten_lamp(1.5); // ten standard errors
  const Outcome changed = run();
  EXPECT_EQ(changed.code, 1);
  EXPECT_THAT(changed.out, testing::ContainsRegex("FAILED   room: z (9.9|10)[0-9.]* exceeds 4"));
}

TEST_F(Regress, MalformedCasesAreRefusedByTheirPlace) {
  const auto with = [](const std::string& key, const json& value) {
    json changed = tiny_case();
    changed[json::json_pointer(key)] = value;
    return changed;
  };
  expect_refused(with("/limts", 1), "/cases/0/limts: unknown key, did you mean 'limits'?");
  expect_refused(with("/limits", json::object()),
                 "/cases/0/limits: nothing is limited: the case could not fail");
  expect_refused(with("/limits/rmsee", 1),
                 "/cases/0/limits/rmsee: unknown key, did you mean 'rmse'?");
  expect_refused(with("/limits/rmse", "1"), "/cases/0/limits/rmse: is not a number");
  expect_refused(with("/limits/rmse", -1), "/cases/0/limits/rmse: is negative");
  expect_refused(with("/settings/smaples", 4),
                 "/cases/0/settings/smaples: unknown setting, did you mean 'samples'?");
  expect_refused(with("/settings/samples", 1.5),
                 "/cases/0/settings/samples: '1.5' is not a whole number from 1 to 16777216");
  expect_refused(with("/settings/quality", "drafd"),
                 "/cases/0/settings/quality: no value 'drafd', did you mean 'draft'?");
  expect_refused(with("/settings/float", 1), "/cases/0/settings/float: takes true or false");
  expect_refused(with("/settings/size", true), "/cases/0/settings/size: takes a value");
  expect_refused(with("/settings/size", json::object()),
                 "/cases/0/settings/size: is neither a text, a list of texts, a number nor true or false");
  expect_refused(with("/settings/ies", json::array()), "/cases/0/settings/ies: is empty");
  expect_refused(with("/name", "a/b"),
                 "/cases/0/name: has to be a file name of letters, digits, '.', '_' and '-', not "
                 "beginning with '.'");
  expect_refused(with("/reference", "room.png"), "/cases/0/reference: is not an .exr file");
  expect_refused(with("/relmse-epsilon", 0), "/cases/0/relmse-epsilon: is not positive");
  json incomplete = tiny_case();
  incomplete.erase("scene");
  expect_refused(incomplete, "/cases/0: 'scene' is missing");
}

TEST_F(Regress, FilesThatHoldNoCasesAreRefused) {
  const auto expect = [&](const std::string& text, const std::string& line) {
    std::ofstream(folder_ / "cases.json") << text;
    const Outcome outcome = run();
    EXPECT_EQ(outcome.err, "meninas: cases.json: " + line + '\n');
    EXPECT_EQ(outcome.code, 3);
  };
  expect("{\n \"cases\": [\n", "line 3: is not JSON");
  expect("[]", "/: is not an object");
  expect("{}", "/: 'cases' is missing");
  expect("{\"cases\": []}", "/cases: is not a list of cases");
  write(json::array({tiny_case(), tiny_case()}));
  const Outcome twins = run();
  EXPECT_EQ(twins.err, "meninas: cases.json: /cases/1/name: another case is named 'room'\n");
  std::filesystem::remove(folder_ / "cases.json");
  EXPECT_EQ(run().err, "meninas: cases.json: no such file\n");
}

} // namespace
} // namespace meninas::test
