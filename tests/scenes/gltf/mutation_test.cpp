// Broken on purpose in thousands of ways:
// a file either becomes a scene with finite numbers or ends with a UserError.
#include "tests/scenes/gltf/compression/compressed_files.h"
#include "tests/scenes/gltf/gltf_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meninas::test {

static bool all_finite(const Scene& scene) {
  const auto finite = [](const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  bool good = std::isfinite(scene.position_error) && !scene.triangles.empty();
  for (const auto& vertex : scene.vertices)
    good = good && finite(vertex.position) &&
           std::isfinite(attributes_of(scene, vertex).texcoord[0].x);
  for (const auto& triangle : scene.triangles) {
    good = good && index(triangle.material) < scene.materials.size() &&
           index(triangle.node) < scene.nodes.size();
    for (const auto vertex : triangle.vertices)
      good = good && index(vertex) < scene.vertices.size();
  }
  for (const auto& material : scene.materials) {
    good = good && finite(material.emission) && finite(material.base_color);
    if (material.base_color_texture)
      good = good && index(material.base_color_texture->texture) < scene.textures.size();
  }
  for (const auto& camera : scene.cameras)
    good = good && finite(camera.position) && finite(camera.forward) && finite(camera.up) &&
           camera.aspect >= 0.0;
  for (const auto& light : scene.lights)
    good = good && finite(light.intensity) && finite(light.position) && finite(light.direction);
  return good;
}

class Mutants {
public:
  ~Mutants() {
    std::printf("%d of %d mutants load\n", loaded_, tried_);
    testing::Test::RecordProperty("mutants", tried_);
    testing::Test::RecordProperty("loaded", loaded_);
  }

  void try_one(const std::string& name, const Bytes& bytes, const std::string& story) {
    ++tried_;
    const auto file = folder_.write(name, bytes);
    try {
      // Big enough for every honest reading of these files,
      // small enough for a quick refusal of all others.
      const auto scene = load_gltf(file, {.memory_limit = 1 << 24, .state = {.at = 0.5}});
      ++loaded_;
      EXPECT_TRUE(all_finite(scene)) << story;
    } catch (const UserError& error) {
      const std::string line = error.what();
      EXPECT_TRUE(line.starts_with(file.string() + ": ") && line.find('\n') == std::string::npos)
          << story << " says " << line;
    } catch (const std::exception& error) {
      ADD_FAILURE() << story << " throws " << error.what();
    }
  }

  int loaded() const { return loaded_; }
  int tried() const { return tried_; }

private:
  TemporaryFolder folder_;
  int tried_ = 0;
  int loaded_ = 0;
};

static Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// Replaces one to three bytes, with any byte or with one that JSON text may well have there.
static void flip_bytes(Mutants& mutants, const std::string& name, const Bytes& whole,
                       std::size_t first, int count) {
  static constexpr std::string_view likely = "0123456789-.eE,:[]{}\"AZaz/+ ";
  std::mt19937 random(1); // its numbers are fixed by the standard, unlike those of distributions
  for (int k = 0; k < count; ++k) {
    auto bytes = whole;
    const auto flips = 1 + random() % 3;
    for (unsigned f = 0; f < flips; ++f) {
      const auto at = first + random() % (bytes.size() - first);
      const auto any = random();
      bytes[at] = static_cast<unsigned char>(k % 2 == 0 ? any : likely[any % likely.size()]);
    }
    mutants.try_one(name, bytes, name + ", byte flips " + std::to_string(k));
  }
}

static void truncate(Mutants& mutants, const std::string& name, const Bytes& whole, int count) {
  for (int k = 0; k < count; ++k) {
    const auto size = whole.size() * k / count;
    mutants.try_one(name, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)},
                    name + ", first " + std::to_string(size) + " bytes");
  }
}

TEST(GltfMutation, BytesOfText) {
  const auto whole = bytes_of(as_text(everything()));
  Mutants mutants;
  mutants.try_one("scene.gltf", whole, "unchanged");
  ASSERT_EQ(mutants.loaded(), 1);
  flip_bytes(mutants, "scene.gltf", whole, 0, 500);
  truncate(mutants, "scene.gltf", whole, 100);
}

TEST(GltfMutation, BytesOfGlb) {
  const auto whole = as_glb(everything());
  Mutants mutants;
  mutants.try_one("scene.glb", whole, "unchanged");
  ASSERT_EQ(mutants.loaded(), 1);
  flip_bytes(mutants, "scene.glb", whole, 0, 300);
  // The JSON is the longer part; what follows it has numbers to break as well.
  flip_bytes(mutants, "scene.glb", whole, whole.size() - everything().data.size() - 8, 300);
  truncate(mutants, "scene.glb", whole, 100);
}

TEST(GltfMutation, CompressedData) {
  const std::pair<const char*, GltfFile> files[] = {
      {"meshopt.glb", with_meshopt(bumpy_sheet(5))},
      {"edgebreaker.glb", with_draco(bumpy_sheet(5), {.position_bits = 11, .normal_bits = 8})},
      {"lossless.glb", with_draco(quantised_sheet(5))},
      {"sequential.glb", with_draco(bumpy_sheet(5), {.position_bits = 11, .edgebreaker = false})}};
  for (const auto& [name, file] : files) {
    const auto whole = as_glb(file);
    const auto first = whole.size() - (file.data.size() + 3) / 4 * 4;
    Mutants mutants;
    mutants.try_one(name, whole, "unchanged");
    ASSERT_EQ(mutants.loaded(), 1) << name;
    flip_bytes(mutants, name, whole, first, 250);
    for (std::size_t view = 0; view < file.json["bufferViews"].size(); ++view) {
      auto shorter = file;
      auto& json = shorter.json["bufferViews"][view];
      auto& range = json.contains("extensions") ? *json["extensions"].begin() : json;
      for (std::size_t size = range["byteLength"]; size > 0; size -= 1 + size / 10) {
        range["byteLength"] = size - 1;
        mutants.try_one(name, as_glb(shorter), std::string(name) + ", a view cut short");
      }
    }
    EXPECT_GT(mutants.loaded(), 1) << name;
    EXPECT_LT(mutants.loaded(), mutants.tried() * 19 / 20) << name;
  }
}

TEST(GltfMutation, ValuesOfJson) {
  auto file = everything();
  file.json["buffers"] =
      Json::array({{{"byteLength", file.data.size()}, {"uri", data_uri(file.data)}}});
  const Json replacements[] = {nullptr,
                               -1,
                               0,
                               1,
                               3,
                               0.5,
                               255,
                               4294967295u,
                               9223372036854775807,
                               18446744073709551615u,
                               -9223372036854775807,
                               1e300,
                               -1e300,
                               1e-300,
                               "",
                               "text",
                               true,
                               Json::array(),
                               {0},
                               {1e300, 1e300, 1e300},
                               Json::object(),
                               {{"index", 0}},
                               Json::array({Json::array()})};
  // Every value at every depth, replaced by each of these, and left out.
  const auto places = file.json.flatten();
  std::set<std::string> pointers;
  for (const auto& [pointer, value] : places.items())
    for (auto at = Json::json_pointer(pointer); !at.empty(); at.pop_back())
      pointers.insert(at.to_string());

  Mutants mutants;
  for (const auto& pointer : pointers) {
    const Json::json_pointer at(pointer);
    for (const auto& replacement : replacements) {
      auto mutant = file;
      mutant.json[at] = replacement;
      mutants.try_one("scene.gltf", bytes_of(as_text(mutant)),
                      pointer + " = " + replacement.dump());
    }
    auto mutant = file;
    auto& parent = mutant.json[at.parent_pointer()];
    if (parent.is_object())
      parent.erase(at.back());
    else
      parent.erase(std::stoul(at.back()));
    mutants.try_one("scene.gltf", bytes_of(as_text(mutant)), pointer + " left out");
  }
  EXPECT_GT(mutants.tried(), 2000);
  // Both outcomes must be there, or the mutations test nothing.
  EXPECT_GT(mutants.loaded(), mutants.tried() / 20);
  EXPECT_LT(mutants.loaded(), mutants.tried() * 19 / 20);
}

} // namespace meninas::test
