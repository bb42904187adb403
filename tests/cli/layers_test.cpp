// `render --layers`: the nine parts of a picture, of both passes and of the reference.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace meninas::test {
namespace {

const std::vector<std::string> names{
    "emission",         "emission.mirror",         "emission.mirrors",
    "diffuse.direct",   "diffuse.direct.mirror",   "diffuse.direct.mirrors",
    "diffuse.mirrored", "diffuse.mirrored.mirror", "diffuse.mirrored.mirrors"};

class LayersOption : public testing::Test {
protected:
  LayersOption() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(const std::string& command, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {command, "room.glb", "--quiet"});
    return run_program(folder_.path(), arguments);
  }

  /// The layers of a small picture by name, after a check that they add up to it.
  std::map<std::string, Image> layers_of(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--layers", "--size", "40x30", "-o", "out.exr"});
    const Outcome outcome = run("render", std::move(arguments));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const ImageFile file = read_image(folder_ / "out.exr");
    std::map<std::string, Image> layers;
    for (const Layer& layer : file.layers)
      layers[layer.name] = layer.image;
    for (std::size_t p = 0; p < file.picture.pixels.size(); ++p) {
      glm::vec3 sum(0.0F);
      for (const std::string& name : names)
        sum += layers.at(name).pixels[p];
      EXPECT_EQ(sum, file.picture.pixels[p]) << "exactly, in their order: all are floats";
    }
    return layers;
  }

  void expect_error(int code, const std::string& line, const std::string& command,
                    const std::vector<std::string>& arguments) {
    const auto before = files_in(folder_.path());
    const Outcome outcome = run(command, arguments);
    EXPECT_EQ(outcome.err, "meninas: " + line + '\n');
    EXPECT_EQ(outcome.code, code);
    EXPECT_EQ(files_in(folder_.path()), before);
  }

  TemporaryFolder folder_;
};

TEST_F(LayersOption, OfBothPasses) {
  const auto layers = layers_of({"--quality", "draft"});
  EXPECT_EQ(layers.size(), names.size());
}

TEST_F(LayersOption, OfAReferenceWithItsVariance) {
  const auto layers = layers_of({"--mode", "reference", "--samples", "32"});
  EXPECT_EQ(layers.size(), names.size() + 1);
  EXPECT_TRUE(layers.contains("variance"));
}

TEST_F(LayersOption, OfASolutionThatKnowsItsMirroredPart) {
  ASSERT_EQ(run("solve", {"--quality", "draft", "-o", "known.glb"}).code, 0);
  EXPECT_EQ(layers_of({"--quality", "draft", "--solution", "known.glb"}).size(), names.size());
  ASSERT_EQ(
      run("solve", {"--quality", "draft", "-o", "blind.glb", "--interpolation", "average"}).code,
      0);
  expect_error(
      3, "blind.glb: does not know what mirrors brought: solve again with --interpolation gather",
      "render", {"--layers", "--solution", "blind.glb", "-o", "no.exr"});
}

// `fine` computes light of emitters at the hits where the solution knows the rest by itself,
// and interpolates where not.
TEST_F(LayersOption, OfASolutionThatDoesNotTellLightOfEmittersApart) {
  ASSERT_EQ(run("solve", {"--element-size", "0.5", "-o", "mixed.glb", "--form-factors", "analytic",
                          "--interpolation", "average"})
                .code,
            0);
  const auto render = [&](const std::string& picture, std::vector<std::string> more) {
    std::vector<std::string> options{"--quality",  "fine",      "--samples", "4",
                                     "--solution", "mixed.glb", "-o",        picture};
    options.insert(options.end(), more.begin(), more.end());
    return run("render", options);
  };
  ASSERT_EQ(render("fine.exr", {}).code, 0);
  ASSERT_EQ(render("interpolated.exr", {"--diffuse", "interpolated"}).code, 0);
  EXPECT_EQ(read_image(folder_ / "fine.exr").picture.pixels,
            read_image(folder_ / "interpolated.exr").picture.pixels);
  const Outcome refused = render("direct.exr", {"--diffuse", "direct"});
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, testing::HasSubstr("does not know its light without that of emitters"));
}

TEST_F(LayersOption, WhereTheyCannotBeIsSaid) {
  expect_error(2, "--layers: has no effect with --mode radiosity: its mirrors are black", "render",
               {"--layers", "--mode", "radiosity", "-o", "no.exr"});
  expect_error(2, "--layers: needs --interpolation gather", "render",
               {"--layers", "--interpolation", "average", "-o", "no.exr"});
  expect_error(2, "--layers: needs an EXR to write them to", "render",
               {"--layers", "-o", "no.png"});
}

TEST_F(LayersOption, DiffuseTermsThatHaveNoEffectAreRefused) {
  expect_error(2, "--diffuse: has no effect with --mode reference: there is no pass one", "render",
               {"--diffuse", "direct", "--mode", "reference", "-o", "no.exr"});
  expect_error(2, "--diffuse: has no effect with --mode radiosity: it shows pass one", "render",
               {"--diffuse", "gather", "--mode", "radiosity", "-o", "no.exr"});
  expect_error(2, "--diffuse direct: needs --interpolation gather with --form-factors analytic",
               "render",
               {"--diffuse", "direct", "--form-factors", "analytic", "--interpolation", "average",
                "-o", "no.exr"});
}

} // namespace
} // namespace meninas::test
