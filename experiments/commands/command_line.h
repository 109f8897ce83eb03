// Options that several commands share: the volume and the isovalue.
#pragma once

#include <string>

#include "experiments/commands/command.h"
#include "volume/io/base/volume.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The options that name a volume, as typed. All but the path, the channel and the array describe a .raw file, which has
// no header.
struct VolumeOptions {
  std::string path;
  std::string dims;
  std::string type;
  std::string endian;
  std::string spacing;
  std::string skip;
  std::string channel;
  std::string array;
  std::string format;  // of standard input
  std::string region;  // of samples; empty: all
};

void add_volume_options(Command& command, VolumeOptions& options);
// --region; `mesh` has one of its own, which is a parameter.
void add_region_option(Command& command, VolumeOptions& options);

// Throws InputError when the file or the options are wrong. NaN and infinities are told by the volume.
Volume load_volume(const VolumeOptions& options);

// If another isovalue was used, says on stderr which one and why. `grid`: the one it is of, where it is at hand.
void remark_isovalue(const ScalarGrid* grid, double isovalue, double used);

}  // namespace deliso
