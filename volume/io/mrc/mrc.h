// Maps of electron microscopy and crystallography: MRC and CCP4 (.mrc, .map, .ccp4).
#pragma once

#include "volume/io/base/volume.h"

namespace deliso {

// Modes 0 (i8, or u8 where IMOD says so), 1 (i16), 2 (f32), 6 (u16) and 12 (f16). World coordinates are in angstroms,
// along the axes that MAPC, MAPR and MAPS name, whatever the cell's angles; from ORIGIN, or where that is 0 from
// NXSTART, NYSTART and NZSTART. Throws InputError naming the file and the field.
Volume read_mrc(UnpackedFile& file, const ChannelChoice& choice);

}  // namespace deliso
