// meninas_gallery [FOLDER]:
// writes every scene of the gallery as FOLDER/NAME.gltf (default: the current folder).
#include "scenes/gallery/generator/gltf_text.h"
#include "scenes/gallery/generator/stages.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

int main(int argc, char** argv) {
  using namespace meninas::gallery;
  if (argc > 2) {
    std::fputs("usage: meninas_gallery [FOLDER]\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = argc == 2 ? argv[1] : ".";
  for (const auto& stage : all_stages()) {
    const auto file = folder / (stage.name + ".gltf");
    std::ofstream stream(file, std::ios::binary);
    stream << gltf_text(stage);
    stream.close();
    if (!stream) {
      std::fprintf(stderr, "meninas_gallery: %s: cannot be written\n", file.c_str());
      return 4;
    }
  }
  return 0;
}
