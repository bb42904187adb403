// JSON Schema (draft 2020-12), the part of it that the schemas shipped with the program use.
//
// Understood: $ref (into the same schema), type, enum, anyOf, required, properties,
// additionalProperties, items, minItems, maxItems, minLength, minimum, maximum, exclusiveMinimum,
// exclusiveMaximum; title, description, default, $schema and $defs say nothing about validity.
// A schema with any other keyword breaks a precondition:
// what is not checked must not look as if it were.
#pragma once

#include "runs/json/json_place.h"

namespace meninas {

/// Throws InputError `FILE: POINTER: WHAT` for the first thing at the place
/// that the schema forbids; unknown keys get the nearest known one as a hint.
/// Where none of several alternatives holds, the one that is nearest (of the right type) says why.
void check_schema(const Place& place, const Json& schema);

} // namespace meninas
