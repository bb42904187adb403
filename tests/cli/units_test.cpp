// Every figure has its unit: in JSON by the entry `units`, in tables by their heads, in lines beside it.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <regex>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;

/// Numbers that are neither counts nor below a key that `units` knows, by their keys.
void add_without_unit(const json& value, const json& units, const std::string& place, bool known,
                      std::vector<std::string>& found) {
  if (value.is_number_float() && !known)
    found.push_back(place);
  if (value.is_array())
    for (const json& one : value)
      add_without_unit(one, units, place, known, found);
  if (value.is_object())
    for (const auto& [key, one] : value.items())
      if (key != "units")
        add_without_unit(one, units, place + '.' + key, known || units.contains(key), found);
}

std::vector<std::string> without_unit(const json& document) {
  std::vector<std::string> found;
  add_without_unit(document, document.value("units", json::object()), "", false, found);
  return found;
}

/// Both by how the file's light is read and by what the file itself says.
class Units : public testing::TestWithParam<std::string> {
protected:
  Units() {
    TinyRoom room = tiny_room();
    if (GetParam() == "of the file")
      room.root["asset"]["extras"] = {{"light_units", "photometric"}};
    write_room(folder_ / "room.glb", room);
  }
  /// The figures are those of a tiny room, so that they take no time.
  Outcome run(std::vector<std::string> arguments, bool reads_light = true) {
    if (reads_light && GetParam() != "of the file")
      arguments.insert(arguments.end(), {"--units", GetParam()});
    const Outcome outcome = run_program(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  json document(const std::string& name) { return json::parse(read_file(folder_ / name)); }

  TemporaryFolder folder_;
};

TEST_P(Units, AreInTheFilesOfSolve) {
  const Outcome outcome =
      run({"solve", "room.glb", "-o", "s.glb", "--quality", "draft", "--by-lamp", "--per-node", "nodes.json",
           "--stats", "stats.json", "--grid", "floor", "--points-out", "points.json"});
  EXPECT_THAT(outcome.err,
              ContainsRegex("points [0-9.]+ x [0-9.]+ m apart, illuminance [0-9.e-]+ lx at least, "
                            "[0-9.e-]+ lx in the mean, [0-9.e-]+ lx at most"));
  EXPECT_THAT(outcome.err, ContainsRegex("elements in [0-9.]+ s"));
  for (const char* file : {"nodes.json", "stats.json", "points.json"})
    EXPECT_THAT(without_unit(document(file)), testing::IsEmpty()) << file;
  EXPECT_EQ(document("nodes.json")["units"]["radiosity"], "W/m^2");
  EXPECT_EQ(document("nodes.json")["units"]["illuminance"], "lx");
  // The nearest key upwards tells: seconds.solve are seconds.
  EXPECT_FALSE(document("stats.json")["units"].contains("solve"));
  EXPECT_EQ(document("stats.json")["units"]["residual"], "1");
  EXPECT_EQ(document("stats.json")["units"]["energy"], "W");
  run({"solve", "room.glb", "-o", "s.glb", "--quality", "draft", "--by-lamp", "--grid", "floor"});
  const std::string table = read_file(folder_ / "s.points.csv"), head = table.substr(0, table.find('\n'));
  EXPECT_TRUE(std::regex_match(head, std::regex("set,x_m,y_m,z_m,nx,ny,nz(,illuminance\\w*_lx|,irradiance\\w*_W_m2)+"))) << head;
}

TEST_P(Units, AreInWhatPlanAndFormfactorsSay) {
  const std::string plan = run({"plan", "room.glb", "--quality", "draft"}).out;
  EXPECT_THAT(plan, ContainsRegex("mirrors +mirror, [0-9.]+ m\\^2, reflectance"));
  EXPECT_THAT(plan, ContainsRegex("about [0-9.e-]+ s with [0-9]+ threads \\([0-9.e-]+ s of it pass one\\) and [0-9.]+ .iB"));
  if (GetParam() == "of the file") {
    EXPECT_THAT(plan, HasSubstr("light is in cd/m^2, cd and lx, as asset.extras.light_units says"));
  }
  EXPECT_THAT(without_unit(json::parse(run({"plan", "room.glb", "--quality", "draft", "--json"}).out)), testing::IsEmpty());
  const std::vector<std::string> factors{"formfactors", "room.glb", "--from", "floor", "--to", "lamp"};
  EXPECT_THAT(run(factors, false).out, ContainsRegex("from +floor, [0-9.]+ m\\^2"));
  std::vector<std::string> as_json = factors;
  as_json.push_back("--json");
  EXPECT_THAT(without_unit(json::parse(run(as_json, false).out)), testing::IsEmpty());
}

TEST_P(Units, AreInWhatPicturesAndComparisonsSay) {
  for (const char* seed : {"1", "2"})
    run({"render", "room.glb", "-o", std::string(seed) + ".exr", "-o", std::string(seed) + ".png", "--quality", "draft",
         "--size", "24x24", "--seed", seed, "--stats", "stats.json"});
  EXPECT_THAT(without_unit(document("stats.json")), testing::IsEmpty());
  const std::string radiances = run({"diff", "1.exr", "2.exr"}, false).out, whites = run({"diff", "1.png", "2.png"}, false).out;
  for (const char* metric : {"rmse", "mae", "max_abs"}) {
    EXPECT_THAT(radiances, ContainsRegex(std::string(metric) + " +[0-9.e-]+ W/m\\^2/sr"));
    EXPECT_THAT(whites, ContainsRegex(std::string(metric) + " +[0-9.e-]+ of white"));
  }
  EXPECT_THAT(radiances, ContainsRegex("psnr +[0-9.]+ dB"));
  EXPECT_THAT(without_unit(json::parse(run({"diff", "1.exr", "2.exr", "--json"}, false).out)), testing::IsEmpty());
  // False colours are no radiance; the numbers that they stand for are a layer.
  for (const char* seed : {"1", "2"})
    run({"render", "room.glb", "-o", std::string("lux") + seed + ".exr", "--quality", "draft", "--size", "24x24", "--seed", seed,
         "--view", "illuminance"});
  EXPECT_THAT(run({"diff", "lux1.exr", "lux2.exr"}, false).out, ContainsRegex("rmse +[0-9.e-]+ of white"));
  EXPECT_THAT(run({"diff", "lux1.exr", "lux2.exr", "--layer", "illuminance"}, false).out, ContainsRegex("rmse +[0-9.e-]+ lx"));
  for (const auto& [view, unit] : {std::pair{"irradiance", "W/m\\^2"}, {"illuminance", "lx"}, {"luminance", "cd/m2"},
                                   {"closure", "of a row"}, {"mirror-depth", "mirrors in a row"}})
    EXPECT_THAT(run({"render", "room.glb", "-o", "v.png", "--quality", "draft", "--size", "24x24", "--view", view}).err,
                ContainsRegex(std::string("view ") + view + ": from 0 \\(black\\) to [0-9.e+-]+ " + unit + " "));
}

TEST_P(Units, AreOnPagesAndInTheirFigures) {
  run({"compare", "room.glb", "-o", "compared", "--quality", "draft", "--size", "24x24"});
  EXPECT_THAT(without_unit(document("compared/figures.json")), testing::IsEmpty());
  const std::string page = read_file(folder_ / "compared/index.html");
  EXPECT_THAT(page, HasSubstr("RMSE / (W/m²/sr)"));
  EXPECT_THAT(page, HasSubstr("PSNR / dB"));
  run({"walk", "room.glb", "-o", "room.html", "--quality", "draft"});
  const std::string walk = read_file(folder_ / "room.html");
  for (const char* said : {"irradiance H, W/m²", "} W/m² (", "} lx, at ${efficacy} lm/W", " EV`", " ms${left}`"})
    EXPECT_THAT(walk, HasSubstr(said));
  std::ofstream(folder_ / "jobs.json")
      << json{{"jobs", {{{"scenes", "room.glb"}, {"settings", {{"quality", "draft"}, {"size", "16x16"}}}, {"outputs", "a.png"}}}}};
  run({"batch", "jobs.json", "-o", "batch"}, false);
  EXPECT_THAT(without_unit(document("batch/summary.json")), testing::IsEmpty());
}

// Once: it measures for a while.
TEST(UnitsOfTrade, AreInItsFigures) {
  const TemporaryFolder folder;
  write_room(folder / "room.glb", tiny_room());
  const Outcome outcome = run_program(folder.path(), {"trade", "room.glb", "-o", "traded", "--size", "16x16", "--budget", "3"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(without_unit(json::parse(read_file(folder / "traded/trade.json"))), testing::IsEmpty());
  EXPECT_THAT(read_file(folder / "traded/trade.csv"), testing::StartsWith("id,front,seconds,processor_seconds,error,"));
}

INSTANTIATE_TEST_SUITE_P(Light, Units, testing::Values("radiometric", "photometric", "of the file"),
                         [](const auto& one) { return std::regex_replace(one.param, std::regex(" "), "_"); });

} // namespace
} // namespace meninas::test
