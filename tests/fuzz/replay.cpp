// Drives a fuzz target without libFuzzer. On every file of the folders that are given, which is how an ordinary build
// tests the corpora; or on random inputs:
//   fuzz_NAME --random COUNT SEED FOLDER    keeps the inputs that fail in FOLDER
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;

std::vector<std::filesystem::path> files_in(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(path)) return {path};
  for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool passes(const Input& input, const std::string& name) {
  try {
    LLVMFuzzerTestOneInput(input.data(), input.size());
    return true;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return false;
  }
}

int replay(std::span<char*> folders) {
  std::size_t count = 0, failed = 0;
  for (const char* folder : folders) {
    for (const std::filesystem::path& file : files_in(folder)) {
      // Before the run: where it does not return, the last line names the input.
      std::printf("%s\n", file.c_str());
      std::fflush(stdout);
      std::ifstream stream(file, std::ios::binary);
      const Input input{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
      ++count;
      if (!passes(input, file.string())) ++failed;
    }
  }
  std::printf("%zu inputs, %zu failed\n", count, failed);
  return count > 0 && failed == 0 ? 0 : 1;
}

int run_random(std::uint64_t count, std::uint64_t seed, const std::filesystem::path& folder) {
  constexpr std::size_t kLongest = 300;
  std::uint64_t failed = 0;
  for (std::uint64_t n = 0; n < count; ++n) {
    const std::string name = "random-" + std::to_string(seed) + "-" + std::to_string(n);
    std::seed_seq numbers{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(n)};
    std::mt19937 random(numbers);
    Input input(random() % kLongest);
    for (std::uint8_t& byte : input) byte = static_cast<std::uint8_t>(random());
    if (passes(input, name)) continue;
    ++failed;
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
  }
  std::printf("%llu random inputs, %llu failed\n", static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(failed));
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::span<char*> arguments = std::span(argv, static_cast<std::size_t>(argc)).subspan(1);
  const bool is_random = arguments.size() == 4 && std::string_view(arguments[0]) == "--random";
  if (!is_random) return replay(arguments);
  return run_random(std::strtoull(arguments[1], nullptr, 10), std::strtoull(arguments[2], nullptr, 10), arguments[3]);
}
