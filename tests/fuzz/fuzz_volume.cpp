// Any file as a volume. Its name is a part of the input (fuzz_input.h), so a new format needs no new target: a line in
// volume.dict and some files in the corpus.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "delaunay/base/check.h"
#include "tests/fuzz/fuzz_input.h"
#include "volume/io/nrrd/nrrd.h"
#include "volume/io/volume_file.h"

namespace deliso::fuzz {
namespace {

std::optional<ScalarGrid> read(const std::filesystem::path& path) {
  try {
    return read_volume(path);
  } catch (const InputError& error) {
    require_sentence(error.what());
    return std::nullopt;
  }
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
  const std::optional<ScalarGrid> grid = read(files.first());
  if (!grid) return;
  const auto [low, high] = grid->range();
  require(low <= high, "the range is one");
  if (grid->sample_count() <= kMostWritten) require_round_trip(*grid, files);
}

}  // namespace
}  // namespace deliso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  deliso::fuzz::run(deliso::fuzz::text_of(data, size));
  return 0;
}
