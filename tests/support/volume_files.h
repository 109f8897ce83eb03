// Helpers for tests that read and write volume files.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "tests/support/temporary_folder.h"
#include "volume/scalar_grid.h"

namespace deliso {

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// Expects an InputError of one line that has all these parts, and `name` too.
template <class Function>
void expect_input_error(Function&& f, std::initializer_list<std::string> parts, const std::string& name = "") {
  try {
    f();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find(name), std::string::npos) << "no \"" << name << "\" in: " << message;
    for (const std::string& part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << "no \"" << part << "\" in: " << message;
    return;
  }
  ADD_FAILURE() << "no InputError";
}

// Samples of a type with random bits (finite for floating point), the extremes of the type among them.
template <class Sample>
std::vector<Sample> random_samples(std::size_t count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Sample> samples;
  for (std::size_t n = 0; n < count; ++n) {
    if constexpr (std::is_integral_v<Sample>) {
      samples.push_back(static_cast<Sample>(rng.next()));
    } else {
      samples.push_back(static_cast<Sample>(rng.uniform(-1, 1) * (n % 3 == 0 ? 1e30 : 1)));
    }
  }
  samples.front() = std::numeric_limits<Sample>::lowest();
  samples.back() = std::numeric_limits<Sample>::max();
  return samples;
}

// The directory of the public volumes, or nothing.
inline std::optional<std::filesystem::path> data_directory() {
  const char* path = std::getenv("DELISO_DATA");
  if (path == nullptr || *path == '\0') return std::nullopt;
  return path;
}

}  // namespace deliso
