// Where a mesh is written: spaces, local origins, lengths of the world, and the lines that tell of them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/commands/command.h"
#include "experiments/config/json.h"
#include "volume/io/base/volume.h"

namespace deliso {

// As typed.
struct WorldOptions {
  std::string space = "native";  // empty in the beginning: what a mesh's file says
  bool local_origin = false;
};

void add_world_options(Command& command, WorldOptions& options);

// The coordinates of a mesh's file.
struct World {
  Affine from_grid;                  // from the grid's own coordinates
  std::string space, units;          // empty: unknown
  std::optional<Vec3> local_origin;  // what was taken off: the point of the whole volume's first sample
  bool is_sheared = false;
};

// What is not given, from the lines of a mesh's file (mesh_comments): another tool's mesh has none, and is native.
void take_world_notes(const std::vector<std::string>& comments, const Volume& volume, WorldOptions& options);
// Throws InputError when the space is none or the volume does not say its own.
World world_of(const Volume& volume, const WorldOptions& options);
// Throws InputError when the option's value is no space; to be checked before the volume is read.
void check_space(const std::string& space);

// A length as typed, in voxels (smallest spacings): a plain number, or with the suffix `w` in units of the world, or
// with `mm`. Throws InputError naming the option, also where the volume's units have a name that is not known. Without
// a volume only form and sign of a length of the world are known: it counts as 1 voxel, 0 or -1.
double parse_length(const std::string& text, const std::string& option, const Volume* volume);
// An assignment `key=value` of --set with its value in voxels, where the key is a length and the value is in units of
// the world; any other as it is.
std::string with_length_in_voxels(const std::string& assignment, const Volume* volume);

// One line on stderr where one of these lengths, as typed, is in mm (or areas in mm2, volumes in mm3) and the file does
// not tell its units.
void print_units_remark(const std::string& path, const Volume& volume, const std::vector<std::string>& lengths);

// Metres in a unit of the world; none where the units are unknown.
std::optional<double> metres_in_unit(const std::string& units);

// What a mesh file says of its origin: program and isovalue, promise, space and units, volume, hash, one line each. A
// binary STL file holds them in a short form (short_stl_notes).
// `notes`: what mesh_notes.h and the field's options say, after the isovalue.
std::vector<std::string> mesh_comments(const std::string& volume_path, const std::string& sha256, double isovalue,
                                       const World& world, const std::vector<std::string>& notes);
// The text after a key in lines that are a key and a value, if there is such a line.
std::optional<std::string> note_in(const std::vector<std::string>& comments, std::string_view key);
// The promise.max_distance that one of such lines of a mesh file names, if any does.
std::optional<double> promised_distance(const std::vector<std::string>& comments);

// format, stored_type, channels, channel, space, units and the affine map from index to world, for reports.
Json source_json(const Volume& volume);
// space, units and local_origin of the mesh, and whether lengths are those before a shear.
Json world_json(const World& world);

// One line about a shear; empty without one.
std::string shear_remark(const World& world);

}  // namespace deliso
