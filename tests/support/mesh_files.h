// A fixture for tests that write and read mesh files: a directory of its own for every test.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "delaunay/base/check.h"
#include "surface/mesh/io/mesh_io.h"
#include "tests/support/temporary_folder.h"

namespace deliso::testing {

class MeshIo : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  std::filesystem::path write_bytes(const std::string& name, const std::string& bytes) {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }
  static std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // The message of the InputError that reading these bytes gives.
  std::string reading_error(const std::string& name, const std::string& bytes) {
    const std::filesystem::path path = write_bytes(name, bytes);
    try {
      read_mesh(path);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path.string(), 0), 0u) << "does not name the file: " << error.what();
      return std::string(error.what()).substr(path.string().size());
    }
    ADD_FAILURE() << "no error for:\n" << bytes;
    return "";
  }

  TemporaryFolder folder_;
};

}  // namespace deliso::testing
