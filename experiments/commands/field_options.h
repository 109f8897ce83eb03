// Which field of a volume a command works on: isovalue, label, smoothing, the side that is inside, and NaN.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/commands/command.h"
#include "experiments/config/json.h"
#include "surface/base/parameters.h"
#include "surface/mesh/io/mesh_io.h"
#include "volume/filters/labels.h"
#include "volume/filters/meshed_field.h"
#include "volume/io/base/volume.h"
#include "volume/region.h"

namespace deliso {

// As typed.
struct FieldOptions {
  std::string isovalue;  // a number or a name (isovalue_choice.h)
  std::string label;     // "3", or "1,2,3" where several surfaces are meshed
  std::string smooth;    // a length
  std::string nan = "refuse";
  bool invert = false;
};

void add_isovalue_option(Command& command, FieldOptions& options);
void add_field_options(Command& command, FieldOptions& options);

// Throws InputError when an option's form is wrong; to be checked before the volume is read.
void check_field_options(const FieldOptions& options);
// The labels, in the order typed and each once; none without the option.
std::vector<std::int32_t> parse_labels(const std::string& text);
// What the options set, over what is there already. Of several labels none is set. Without a volume lengths of the
// world are checked only.
void apply_field_options(const FieldOptions& options, const Volume* volume, FieldParameters& parameters);

// The samples, finite, and the isovalue: what meshed_field() takes.
struct ChosenField {
  ScalarGrid grid;
  double isovalue = 0;
  FieldParameters parameters;
};
// NaN lies outside or inside, as far beyond the isovalue as the farthest sample is on either side of it, and infinities
// on their own side. Where only a region of the volume is meshed, its samples alone decide. Throws InputError when
// there are such samples and none are wanted, or the isovalue is missing.
ChosenField choose_field(const std::string& path, const Volume& volume, const FieldOptions& options,
                         const FieldParameters& parameters, const SampleRegion& region = {});
// choose_field and meshed_field; the spacing is the grid's.
struct FieldOfOptions {
  ChosenField chosen;
  MeshedField meshed;
};
FieldOfOptions field_of_options(const std::string& path, const Volume& volume, const FieldOptions& options,
                                bool is_closed);

// label, smooth, invert, nan and in words which field it is, for reports.
Json field_json(const FieldOptions& options, const ChosenField& chosen);

// The report of the only surface, or {"schema": "deliso-labels-1", "labels": reports} of several.
Json one_or_all(Json reports);

// The hash of a volume's samples as they were read.
std::string sha256_as_read(const Volume& volume);

// One line each: the isovalue that a name stands for, and samples that are not finite.
std::vector<std::string> field_remarks(const Volume& volume, const FieldOptions& options, const ChosenField& chosen);
// A line about a mask or labels, and what to do; empty where there is nothing to say. `chosen`: what is done already.
std::string kinds_remark(const SampleKinds& kinds, const ChosenField* chosen = nullptr);

// How a mesh file tells of its field, and how `verify` takes it from there where the options do not say: lines of a key
// and a value.
void append_field_notes(const FieldOptions& options, const Parameters& parameters, std::vector<std::string>& lines);
std::string label_note(const std::vector<std::int32_t>& labels);
// Medit gives every triangle a number: it is a label only where the file notes several labels.
void keep_noted_labels(MeshFile& file);
// Returns whether the mesh is noted to be closed along the box.
bool take_field_notes(const std::vector<std::string>& comments, FieldOptions& options);

}  // namespace deliso
