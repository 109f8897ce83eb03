// A picture in memory and as a PNG file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace deliso {

// Pixels row by row from the top left, three bytes (red, green, blue; sRGB) each; white at first.
struct Image {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<std::uint8_t> rgb;

  // Precondition: both at least 1.
  Image(std::int32_t image_width, std::int32_t image_height);
  [[nodiscard]] std::uint8_t* pixel(std::int32_t x, std::int32_t y) { return rgb.data() + offset(x, y); }
  [[nodiscard]] const std::uint8_t* pixel(std::int32_t x, std::int32_t y) const { return rgb.data() + offset(x, y); }

 private:
  [[nodiscard]] std::size_t offset(std::int32_t x, std::int32_t y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

// The bytes of a PNG file. Equal images give equal bytes.
std::string png_bytes(const Image& image);

// Writes whole or not at all. Throws InputError when the file cannot be written.
void write_png(const Image& image, const std::filesystem::path& path);

// Throws InputError unless `path` ends in .png and could be written now. `option` is what the message names.
void check_png_output(const std::filesystem::path& path, const std::string& option);

}  // namespace deliso
