// Writes and reads INR files with CGAL's ImageIO, for foreign_volumes.py; no part of any build of ours.
//   inr_by_cgal write FILE X Y Z BYTES KIND VX VY VZ TX TY TZ < SAMPLES    KIND: u, i or f; x fastest
//   inr_by_cgal read FILE    prints a line "X Y Z BYTES KIND VX VY VZ TX TY TZ", then the samples
#include <CGAL/ImageIO.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

int main(int count, char** words) {
  const std::string command = count > 2 ? words[1] : "";
  if (command == "write" && count == 14) {
    const int x = std::atoi(words[3]), y = std::atoi(words[4]), z = std::atoi(words[5]), bytes = std::atoi(words[6]);
    const char kind = words[7][0];
    _image* const image =
        _createImage(x, y, z, 1, std::atof(words[8]), std::atof(words[9]), std::atof(words[10]), bytes,
                     kind == 'f' ? WK_FLOAT : WK_FIXED, kind == 'u' ? SGN_UNSIGNED : SGN_SIGNED);
    image->tx = static_cast<float>(std::atof(words[11]));
    image->ty = static_cast<float>(std::atof(words[12]));
    image->tz = static_cast<float>(std::atof(words[13]));
    const std::size_t samples = static_cast<std::size_t>(x) * y * z;
    if (std::fread(image->data, bytes, samples, stdin) != samples) return 1;
    return _writeImage(image, words[2]) == ImageIO_NO_ERROR ? 0 : 1;
  }
  if (command != "read") return 2;
  _image* const image = _readImage(words[2]);
  if (image == nullptr) return 1;
  std::printf("%zu %zu %zu %zu %c %.17g %.17g %.17g %.17g %.17g %.17g\n", image->xdim, image->ydim, image->zdim,
              image->wdim,
              image->wordKind == WK_FLOAT   ? 'f'
              : image->sign == SGN_UNSIGNED ? 'u'
                                            : 'i',
              image->vx, image->vy, image->vz, static_cast<double>(image->tx), static_cast<double>(image->ty),
              static_cast<double>(image->tz));
  std::fwrite(image->data, image->wdim, image->xdim * image->ydim * image->zdim, stdout);
  return 0;
}
