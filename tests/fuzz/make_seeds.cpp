// Writes the files the fuzzer begins with into a folder:
// small ones that together use all the loader reads, and the words of the format.
#include "tests/scenes/gltf/compression/compressed_files.h"
#include "tests/scenes/gltf/gltf_samples.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>

namespace {

using namespace meninas::test;
namespace fs = std::filesystem;

void write(const fs::path& file, const Bytes& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Every key and word of the seeds, for the fuzzer to put in place of others.
void collect(const Json& json, std::set<std::string>& words) {
  for (const auto& [key, value] : json.items()) {
    if (json.is_object()) {
      words.insert('"' + key + '"');
    }
    if (value.is_string() && value.get<std::string>().size() < 40) {
      words.insert(value.dump());
    }
    if (value.is_structured()) {
      collect(value, words);
    }
  }
}

} // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: make_seeds FOLDER\n";
    return 2;
  }
  const fs::path folder = arguments[1];
  fs::create_directories(folder / "seeds");
  std::set<std::string> words{"1e308", "-1", "4294967295", "18446744073709551615", "null", "[]", "{}"};
  const std::pair<const char*, GltfFile> files[] = {
      {"square", square()},           {"everything", everything()},
      {"skinned", skinned_square()},  {"morphed", morphed_square()},
      {"animated", animated_square()}, {"instanced", instanced_square()}, {"layered", layered_square()}, {"old", old_material()},
      {"meshopt", with_meshopt(bumpy_sheet(3))},
      {"draco", with_draco(quantised_sheet(3))},
      {"sequential", with_draco(bumpy_sheet(3), {.position_bits = 11, .normal_bits = 8, .edgebreaker = false})}};
  for (const auto& [name, file] : files) {
    const std::string text = as_text(file);
    write(folder / "seeds" / (std::string(name) + ".gltf"), Bytes(text.begin(), text.end()));
    write(folder / "seeds" / (std::string(name) + ".glb"), as_glb(file));
    collect(file.json, words);
  }
  std::ofstream dictionary(folder / "words.dict");
  for (const std::string& word : words) {
    dictionary << Json(word).dump() << '\n';
  }
  return dictionary.flush() ? 0 : 1;
}
