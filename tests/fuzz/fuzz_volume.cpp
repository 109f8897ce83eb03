// Any file as a volume. Its name is a part of the input (fuzz_input.h), so a new format needs no new target: a line in
// volume.dict and some files in the corpus. DELISO_FUZZ_FORMAT names an extension: every file is then read as that
// format, so that all runs go to one reader.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "delaunay/base/check.h"
#include "tests/fuzz/fuzz_input.h"
#include "volume/io/nrrd/nrrd.h"
#include "volume/io/volume_file.h"

namespace deliso::fuzz {
namespace {

// What the reader says of it: a volume, or one sentence.
struct Reading {
  std::optional<Volume> volume;
  std::string refusal;
};

Reading try_to_read(const std::filesystem::path& path, const ReadOptions& options) {
  try {
    return {read_placed_volume(path, options), {}};
  } catch (const InputError& error) {
    require_sentence(error.what());
    return {std::nullopt, error.what()};
  }
}

// Where a choice is asked for, one is made.
std::optional<Volume> read(const std::filesystem::path& path) {
  ReadOptions options;
  if (const char* const format = std::getenv("DELISO_FUZZ_FORMAT")) options.format = format;
  options.accepts_not_finite = true;
  Reading reading = try_to_read(path, options);
  if (!reading.volume && reading.refusal.find("choose one with its name") != std::string::npos) {
    options.array = "a";
    reading = try_to_read(path, options);
  }
  if (!reading.volume && reading.refusal.find("choose one with its number") != std::string::npos) {
    options.channel = 1;
    reading = try_to_read(path, options);
  }
  return std::move(reading.volume);
}

bool have_equal_bytes(const Samples& a, const Samples& b) {
  const auto x = sample_bytes(a), y = sample_bytes(b);
  return a.index() == b.index() && std::equal(x.begin(), x.end(), y.begin(), y.end());
}

// What was read can be written, and reads back the same.
void require_round_trip(const ScalarGrid& grid, InputFiles& files) {
  const std::filesystem::path copy = files.output("written.nrrd");
  write_nrrd(grid, copy, grid.sample_count() % 2 == 0 ? NrrdEncoding::kRaw : NrrdEncoding::kGzip);
  const ScalarGrid again = read_volume(copy);
  require(again.dims() == grid.dims(), "dimensions are kept");
  require(again.spacing() == grid.spacing() && again.origin() == grid.origin(), "the geometry is kept");
  require(have_equal_bytes(again.samples(), grid.samples()), "samples are kept");
}

void run(std::string_view input) {
  constexpr std::size_t kMostWritten = 4096;
  InputFiles files(input);
  const std::optional<Volume> volume = read(files.first());
  if (!volume) return;
  const ScalarGrid& grid = volume->grid;
  const auto [low, high] = grid.range();
  require(low <= high, "the range is one");
  const Vec3 spacing = grid.spacing();
  require(spacing.x > 0 && spacing.y > 0 && spacing.z > 0, "spacings are positive");
  require(volume->channel < volume->channels, "the channel is one of the file's");
  require(volume->as_read.has_value() == (volume->not_finite.count() > 0), "what is not finite is counted");
  if (grid.sample_count() <= kMostWritten) require_round_trip(grid, files);
}

}  // namespace
}  // namespace deliso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  deliso::fuzz::run(deliso::fuzz::text_of(data, size));
  return 0;
}
