// Draws a shape: rays find what is seen, lighting gives it colours, several rays per pixel smooth it.
#pragma once

#include <cstdint>
#include <functional>

#include "experiments/pictures/camera.h"
#include "experiments/pictures/image.h"
#include "experiments/pictures/shape.h"

namespace deliso {

struct PictureOptions {
  std::int32_t samples = 3;  // along each side of a pixel: samples^2 rays; >= 1
  double line_width = 1.1;   // of edges, in pixels, whatever the zoom; 0: no edges
  std::int32_t threads = 1;  // the picture does not depend on it
  // Called now and then, by the thread that draws, with the fraction that is done; may be empty.
  std::function<void(double share)> progress;
};

// Draws what of `shape` is in `kept` into the camera's width x height pixels of `image` from column `left` on. Pixels
// where nothing is seen keep their colour. Returns whether anything is seen. Precondition: they are all in the image,
// and kept is a finite box.
bool draw(const Shape& shape, const Box3& kept, const Camera& camera, const PictureOptions& options, std::int32_t left,
          Image& image);

}  // namespace deliso
