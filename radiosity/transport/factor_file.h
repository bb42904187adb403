// Form factors as a file, so that a scene under other light is only solved again.
//
// Transport depends on the geometry, the reflectances of mirrors, the mesh and the sampling of rays. It does not
// depend on emission and diffuse reflectances: those may change, as may cameras and names. The parts it depends on
// are hashed one by one, so that a refusal can name the part that changed. Direct light is computed anew.
//
// Layout, little-endian: magic, version of the program, the hashes,
// the arrays of FormFactors each with its length, and at the end a hash of all bytes before it.
// A file is as large as the factors in memory, and is written whole or not at all.
#pragma once

#include "radiosity/transport/factor_key.h"
#include "radiosity/transport/form_factors.h"

#include <filesystem>

namespace meninas {

/// Some rows as a file of a folder in which all parts of them come together: `rows-K-of-N.factors`, K from 1.
struct FactorPart {
  std::uint64_t number = 0, count = 1; ///< from 0
  std::uint64_t elements = 0;          ///< of all parts
};
std::filesystem::path part_file(const std::filesystem::path& folder, const FactorPart& part);
void write_factor_part(const std::filesystem::path& folder, const FormFactors& rows,
                       const FactorPart& part, const FactorKey& key);

/// All rows of a folder, put together: the bits of assemble_transport. Throws InputError that names the file where
/// parts are missing, damaged, of another division, of another version, or made from something else than `key`.
FormFactors join_factor_parts(const std::filesystem::path& folder, const FactorKey& key,
                              std::size_t elements);

void write_factors(const std::filesystem::path& file, const FormFactors& factors,
                   const FactorKey& key);

/// Throws InputError when the file is damaged,
/// of another version of the program, or made from something else than `key`. The result is valid for a solver,
/// whatever the file says: a row for each of the elements, columns among them, numbers that are finite.
FormFactors read_factors(const std::filesystem::path& file, const FactorKey& key, std::size_t elements);

} // namespace meninas
