#include "volume/io/base/file_row.h"

#include <algorithm>
#include <utility>

#include "delaunay/base/check.h"

namespace deliso {

FileRow::FileRow(std::vector<std::filesystem::path> paths, std::uint64_t skipped_in_each, const ByteStream& owner)
    : paths_(std::move(paths)), skipped_(skipped_in_each), owner_(owner) {
  for (const std::filesystem::path& path : paths_) {
    try {
      bound_ += InputFile(path).size();
    } catch (const InputError& error) {
      owner.fail(std::string("the data file ") + error.what());
    }
  }
}

std::size_t FileRow::read(std::span<std::byte> out) {
  std::size_t done = 0;
  while (done < out.size()) {
    if (!file_ || file_->remaining() == 0) {
      if (next_ == paths_.size()) break;
      file_.emplace(paths_[next_++]);
      file_->skip(skipped_, "the first sample");
      continue;
    }
    done += file_->read(out.subspan(done));
  }
  bound_ -= std::min<std::uint64_t>(bound_, done);
  return done;
}

}  // namespace deliso
