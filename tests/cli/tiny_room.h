// A room of one metre with a lamp and a mirror, as glTF that tests spoil in one way each.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace meninas::test {

struct TinyRoom {
  nlohmann::json root;
  std::vector<std::byte> binary;
};

/// Five grey walls, the front one open;
/// `lamp` under the ceiling, `mirror` in front of the left wall, `camera` before the room.
TinyRoom tiny_room();

/// Numbers at the end of the buffer, so many to an element, and their accessor.
std::size_t add_floats(TinyRoom& room, const std::vector<float>& values, const std::string& type,
                       std::size_t width);

void write_room(const std::filesystem::path& file, const TinyRoom& room);

} // namespace meninas::test
