// All animations of a file at one time: glTF 2.0, 3.11.
//
// Translations, rotations, scales and morph weights that channels name take the values that
// their keys have at that time (key_frames.h); joints, cameras and lights go with their nodes.
// Where two channels move one thing, the last in the file does.
#pragma once

#include "scenes/gltf/document.h"

namespace meninas::gltf {

/// Writes the pose into the nodes. Throws InputError for keys that are not whole, finite numbers
/// of their kind in ascending order of time, OutputError when there are too many.
void pose_at(Document& document, double seconds, Findings& findings);

} // namespace meninas::gltf
