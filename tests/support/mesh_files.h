// A fixture for tests that write and read mesh files: a directory of its own for every test.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "delaunay/base/check.h"
#include "surface/mesh/io/mesh_io.h"

namespace deliso::testing {

class MeshIo : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = std::filesystem::path(::testing::TempDir()) / (std::string("deliso_mesh_io_") + info->name());
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return directory_ / name; }
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

  std::filesystem::path directory_;
};

}  // namespace deliso::testing
