// meninas_gallery [FOLDER]:
// writes every committed scene of the gallery as FOLDER/NAME.gltf (default: the current folder).
// meninas_gallery --large [FOLDER]: the scenes that are too large for that, as FOLDER/NAME.glb.
#include "scenes/gallery/generator/glb_file.h"
#include "scenes/gallery/generator/gltf_text.h"
#include "scenes/gallery/generator/stages.h"
#include "scenes/gallery/living_room/living_room.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace {

bool write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream << bytes;
  stream.close();
  if (!stream)
    std::fprintf(stderr, "meninas_gallery: %s: cannot be written\n", file.c_str());
  return static_cast<bool>(stream);
}

} // namespace

int main(int argc, char** argv) {
  using namespace meninas::gallery;
  const bool large = argc > 1 && std::string_view(argv[1]) == "--large";
  const int first = large ? 2 : 1;
  if (argc > first + 1 || (argc > first && argv[first][0] == '-')) {
    std::fputs("usage: meninas_gallery [--large] [FOLDER]\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = argc > first ? argv[first] : ".";
  if (large) {
    const auto stage = living_room();
    return write(folder / (stage.name + ".glb"), glb_bytes(stage)) ? 0 : 4;
  }
  for (const auto& stage : all_stages())
    if (!write(folder / (stage.name + ".gltf"), gltf_text(stage)))
      return 4;
  return 0;
}
