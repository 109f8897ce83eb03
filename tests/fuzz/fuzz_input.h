// What the fuzz targets have in common: what must hold, and how an input becomes files.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace deliso::fuzz {

// Throws what no target catches: libFuzzer takes it for a crash, the replay names the input.
inline void require(bool holds, const std::string& what, const std::string& detail = {}) {
  if (!holds) throw std::logic_error("does not hold: " + what + (detail.empty() ? "" : "\n" + detail));
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// A refusal takes a sentence of one line. (Names of files may hold anything; the program prints them on one line.)
inline void require_sentence(const std::string& message) {
  require(message.size() > 10 && message.size() < 4000, "a refusal is a sentence", message);
}

// An input as files in a folder of this process. Its first line names the first file; the bytes after it are the file,
// up to a line "%%FILE NAME" that begins another. A header and its data file are so one input.
class InputFiles {
 public:
  explicit InputFiles(std::string_view input) : folder_(folder()) {
    constexpr std::string_view kNext = "\n%%FILE ";
    for (bool more = true; more;) {
      const std::size_t line_end = std::min(input.find('\n'), input.size());
      const std::string name = file_name(input.substr(0, line_end));
      input.remove_prefix(std::min(line_end + 1, input.size()));
      const std::size_t end = input.find(kNext);
      more = end != std::string_view::npos;
      write(name, input.substr(0, std::min(end, input.size())));
      if (more) input.remove_prefix(end + kNext.size());
    }
  }
  ~InputFiles() {
    for (const std::string& path : paths_) ::unlink(path.c_str());
  }
  InputFiles(const InputFiles&) = delete;
  InputFiles& operator=(const InputFiles&) = delete;

  [[nodiscard]] std::filesystem::path first() const { return paths_.front(); }
  // A path for what the target writes; removed at the end.
  std::filesystem::path output(const std::string& name) {
    paths_.push_back(folder_ + "/" + name);
    return paths_.back();
  }

 private:
  // In memory where the system has such a folder: a run takes some microseconds.
  static const std::string& folder() {
    static const struct Folder {
      Folder() {
        const char* parent = ::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
        path = std::string(parent) + "/deliso-fuzz-XXXXXX";
        require(mkdtemp(path.data()) != nullptr, "a folder can be made", path);
      }
      ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
      }
      std::string path;
    } kFolder;
    return kFolder.path;
  }
  static std::string file_name(std::string_view line) {
    constexpr std::size_t kLongest = 80;
    std::string name(line.substr(0, kLongest));
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == '\0'; }, '_');
    return name.empty() || name == "." || name == ".." ? "none" : name;
  }
  void write(const std::string& name, std::string_view bytes) {
    const std::string path = folder_ + "/" + name;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    require(file != nullptr, "a file can be made", path);
    if (!bytes.empty()) std::fwrite(bytes.data(), 1, bytes.size(), file);  // an empty view has no data
    std::fclose(file);
    paths_.push_back(path);
  }

  std::string folder_;
  std::vector<std::string> paths_;
};

}  // namespace deliso::fuzz
