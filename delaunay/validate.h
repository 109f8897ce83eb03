// Checks of a tetrahedralization, from cheap to exhaustive. A violation is returned as one sentence that names the
// culprit; an empty result means that there is none.
#pragma once

#include <optional>
#include <string>

#include "delaunay/tetrahedralization.h"

namespace deliso {

// The combinatorial invariants: mirrors, shared vertices, ghosts, incident tetrahedra, distinct vertices, and the Euler
// relation of a closed 3-manifold (v - e + f - t = 0, the infinite vertex included). Linear time.
std::optional<std::string> find_combinatorial_violation(const Tetrahedralization& tets);

// A finite tetrahedron that is flat or turned, or a hull facet that some neighbouring hull vertex sees. Linear time.
std::optional<std::string> find_orientation_violation(const Tetrahedralization& tets);

// A facet whose neighbour's far vertex is in conflict with the tetrahedron, ties perturbed by vertex index. Together
// with the two checks above this proves the whole triangulation Delaunay (Delaunay lemma). Linear time.
std::optional<std::string> find_delaunay_violation(const Tetrahedralization& tets);

// A vertex in conflict with any tetrahedron at all, ties perturbed. Quadratic time: for tests.
std::optional<std::string> find_delaunay_violation_by_brute_force(const Tetrahedralization& tets);

// The first violation of the three linear checks.
std::optional<std::string> find_violation(const Tetrahedralization& tets);

}  // namespace deliso
