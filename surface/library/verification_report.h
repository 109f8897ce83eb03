// What the verification of a mesh found, as JSON for the program and the library.
#pragma once

#include "surface/library/json_tree.h"
#include "surface/verification/verification.h"
#include "volume/affine.h"

namespace deliso {

// An object for each check, with `pass` and its figures.
JsonTree checks_tree(const Verification& v);

// The places that a verification names, under a map.
void move_places(Verification& v, const Affine& map);

}  // namespace deliso
