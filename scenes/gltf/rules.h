// The properties that the loader reads from a glTF file, as rules: their types, and the arrays they refer to.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace meninas::gltf {

enum class Kind {
  size,
  index,
  indices,
  attributes,     ///< an object of indices
  attribute_sets, ///< an array of them
  sizes,          ///< an object of whole numbers
  number,
  numbers,
  text,
  texts,
  boolean,
  object,
  objects
};
enum class Presence { optional, required };

struct Rule {
  std::string_view name;
  Kind kind;
  Presence presence = Presence::optional;
  std::string_view target = {};      ///< the array that indices point into
  std::size_t length = 0;            ///< of an array of numbers; 0: any
  std::span<const Rule> fields = {}; ///< of an object, or of each object of an array
};

/// The rules of the file's root object.
std::span<const Rule> root_rules();

} // namespace meninas::gltf
