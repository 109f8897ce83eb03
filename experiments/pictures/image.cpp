#include "experiments/pictures/image.h"

#include <png.h>

#include <cctype>

#include "delaunay/base/check.h"
#include "experiments/system/files.h"

namespace deliso {

Image::Image(std::int32_t image_width, std::int32_t image_height)
    : width(image_width),
      height(image_height),
      rgb(3 * static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height), 255) {}

std::string png_bytes(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  // Allocate for the worst case; `size` becomes the actual size.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  const int written = png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr);
  DELISO_CHECK(written != 0, "an image can be written as PNG");
  bytes.resize(size);
  return bytes;
}

void write_png(const Image& image, const std::filesystem::path& path) { write_text(png_bytes(image), path); }

void check_png_output(const std::filesystem::path& path, const std::string& option) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".png") {
    throw InputError(option + ": a picture's name ends in .png, found '" + path.string() + "'");
  }
  check_writable(path, option);
}

}  // namespace deliso
