// The data of an NRRD file as plain bytes: decoded, behind what is skipped, from one file or a row of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "volume/io/base/input_file.h"
#include "volume/io/nrrd/nrrd_header.h"

namespace deliso {

// The bytes of all samples of all channels. Throws InputError when they are more than memory can address.
std::uint64_t nrrd_data_bytes(const ByteStream& stream, const SampleLayout& layout);

// Goes over what is skipped before the data, `count` bytes when decoded. Gives them decoded, or nothing when they
// follow in `bytes` as they are. `file`: where the bytes come from, unless it is packed.
std::unique_ptr<ByteStream> nrrd_data(ByteStream& bytes, InputFile* file, const NrrdHeader& header,
                                      std::uint64_t count);

// The data of a row of files, one after another; each has an equal share, and the same lines and bytes are skipped in
// each. Files are opened one at a time.
class NrrdFileRow : public ByteStream {
 public:
  // Throws InputError when a file is missing. `owner`: the file with the header, named in errors.
  NrrdFileRow(const NrrdHeader& header, const ByteStream& owner);

  std::size_t read(std::span<std::byte> out) override;
  [[nodiscard]] std::uint64_t bound() const override { return bound_; }
  [[nodiscard]] std::string name() const override { return owner_.name(); }

 private:
  void open_next();

  const NrrdHeader& header_;
  const ByteStream& owner_;
  std::uint64_t bound_ = 0;
  std::uint64_t share_ = 0;  // bytes of each file
  std::uint64_t left_ = 0;   // of the file that is open
  std::size_t next_ = 0;     // the file to open next
  std::optional<InputFile> file_;
  std::unique_ptr<ByteStream> decoded_;
};

}  // namespace deliso
