// What all test sources keep to.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

namespace fs = std::filesystem;

// Tests run beside each other: a fixed name in the machine's temporary folder would be shared. TemporaryFolder is not.
TEST(TestSources, WriteInFoldersOfTheirOwn) {
  const std::string shared = std::string("Temp") + "Dir()";
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(DELISO_SOURCE_DIR) / "tests")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
    ++files;
    std::ifstream stream(entry.path());
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_EQ(text.find(shared), std::string::npos) << entry.path() << " uses " << shared;
    const bool is_helper =
        entry.path().parent_path().filename() == "support" || text.find("mkdtemp") != std::string::npos;
    if (is_helper) continue;
    EXPECT_EQ(text.find("temp_directory_path"), std::string::npos) << entry.path();
  }
  EXPECT_GT(files, 200);
}

}  // namespace
