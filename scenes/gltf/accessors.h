// Numbers out of buffers:
// strided, interleaved, normalised and sparse accessors, every range checked before it is read.
#pragma once

#include "scenes/gltf/document.h"

namespace meninas::gltf {

/// The bytes that an object with `buffer`, `byteOffset` and `byteLength` names;
/// throws InputError about `where` when they are not all there.
std::span<const unsigned char> bytes_of(const Document& document, const Json& range,
                                        const std::string& where);
std::span<const unsigned char> view_bytes(const Document& document, std::size_t view);

std::uint64_t accessor_count(const Document& document, std::size_t accessor);

/// Vectors of `width` components, one after the other; normalised integers become fractions.
struct Vectors {
  std::size_t width = 0;
  std::vector<double> values;
  std::size_t size() const { return values.size() / width; }
};
Vectors decode_vectors(const Document& document, std::size_t accessor, std::size_t width);

/// The distance between neighbouring values that an accessor can hold: of integers and of floats
/// that were quantised to be compressed; 0 of other floats.
///
/// Optimisers quantise to fewer bits than they store: b bits q become q 2^(s-b) + q 2^-(2b-s), the
/// high bits repeated below (`quantize` of glTF-Transform). Where all of many values have that
/// form, the step is that of the fewest such bits.
double step_of_values(const Document& document, std::size_t accessor);

/// Unsigned integers of one component.
std::vector<std::uint32_t> decode_indices(const Document& document, std::size_t accessor);

/// The elements of any accessor as they are stored, one after the other without gaps; zeros where none is.
struct StoredElements {
  std::size_t width = 0;          ///< components of an element
  std::size_t component_size = 0; ///< bytes
  std::uint32_t component = 0;    ///< glTF's code of their type
  std::vector<unsigned char> bytes;
  std::size_t size() const { return width * component_size; }
};
StoredElements stored_elements(const Document& document, std::size_t accessor);

/// A component of an element as a number, not normalised.
double stored_number(const StoredElements& elements, std::size_t element, std::size_t component);

} // namespace meninas::gltf
