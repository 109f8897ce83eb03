// A fixture for tests of files that are no volumes, and the good header that they break.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "tests/support/volume_files.h"
#include "volume/io/nrrd/nrrd.h"
#include "volume/io/volume_file.h"
#include "volume/scalar_grid.h"

namespace deliso::test {

inline const std::string kSamples = "abcdefghijkl";  // 2 x 3 x 2 bytes

// Lines of a good header; each test breaks one.
struct Header {
  std::string magic = "NRRD0004\n";
  std::string type = "type: uint8\n";
  std::string dimension = "dimension: 3\n";
  std::string sizes = "sizes: 2 3 2\n";
  std::string encoding = "encoding: raw\n";
  std::string more;
  [[nodiscard]] std::string text() const { return magic + type + dimension + sizes + encoding + more + "\n"; }
};

class BadVolume : public ::testing::Test {
 protected:
  // Expects the file of these bytes to be refused, with the file's name and these parts in the message.
  void refuse(const std::string& content, std::initializer_list<std::string> parts,
              const std::string& name = "v.nrrd") {
    write_text(directory_ / name, content);
    expect_input_error([&] { read_volume(directory_ / name); }, parts, name);
  }
  void refuse(const Header& header, std::initializer_list<std::string> parts) {
    refuse(header.text() + kSamples, parts);
  }
  [[nodiscard]] std::string gzip_file(const ScalarGrid& grid) const {
    write_nrrd(grid, directory_ / "good.nrrd");
    return read_text(directory_ / "good.nrrd");
  }

  TemporaryFolder directory_;
};

}  // namespace deliso::test
