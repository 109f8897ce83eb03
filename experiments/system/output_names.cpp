#include "experiments/system/output_names.h"

#include <span>
#include <system_error>

#include "delaunay/base/check.h"
#include "experiments/system/files.h"
#include "volume/io/base/atomic_file.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

bool are_same(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  // At least one of them does not exist yet.
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(behind_links(a), error), error);
  const fs::path whole_b = fs::weakly_canonical(fs::absolute(behind_links(b), error), error);
  return !error && whole_a == whole_b;
}

void check_apart_from(const NamedFile& output, std::span<const NamedFile> others) {
  for (const NamedFile& other : others) {
    if (other.path.empty() || !are_same(output.path, other.path)) continue;
    throw InputError(output.option + ": names the same file as " + other.option + ", '" + output.path.string() + "'");
  }
}

void check_one(const std::vector<NamedFile>& files, const std::string& stream) {
  const NamedFile* first = nullptr;
  for (const NamedFile& file : files) {
    if (!is_standard_stream(file.path)) continue;
    if (first != nullptr)
      throw InputError(file.option + ": " + stream + " is that of " + first->option + " already, expected a file");
    first = &file;
  }
}

}  // namespace

void check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].path.empty() || is_special(outputs[i].path)) continue;
    check_apart_from(outputs[i], inputs);
    check_apart_from(outputs[i], std::span(outputs).first(i));
  }
}

void check_apart_from_data(const std::vector<fs::path>& data_files, const std::vector<NamedFile>& outputs) {
  std::vector<NamedFile> inputs;
  inputs.reserve(data_files.size());
  for (const fs::path& file : data_files) inputs.push_back({"the samples of VOLUME", file});
  check_distinct(inputs, outputs);
}

void check_one_standard_output(const std::vector<NamedFile>& outputs) { check_one(outputs, "standard output"); }

void check_one_standard_input(const std::vector<NamedFile>& inputs) { check_one(inputs, "standard input"); }

}  // namespace deliso
