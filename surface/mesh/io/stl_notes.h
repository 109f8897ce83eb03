// The comments of a mesh as the header of a binary STL file has room for them.
#pragma once

#include <string>

#include "surface/mesh/io/mesh_file_options.h"

namespace deliso {

// The lines that a mesh file says of itself as the header of a binary STL file holds them: first a line of short words
// for what decides a verification, without what is the default, like "DelIso RAS inv closed local sp=1 nan=in l=2
// drop=1 d=.75 s=1.5 r=0:9,2:8,1:7" (spacing ignored, label, components dropped, promised distance, smoothing, region);
// then isovalue, local origin, version and volume, those for which there is room.
struct StlNotes {
  MeshComments comments;
  std::string options_needed;  // of `verify`, for what has no room
};
StlNotes short_stl_notes(const MeshComments& comments);
// The lines again. Comments that are not of the short form, of earlier versions or other programs, stay as they are.
MeshComments long_stl_notes(const MeshComments& comments);

}  // namespace deliso
