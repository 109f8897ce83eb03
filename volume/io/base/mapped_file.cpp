#include "volume/io/base/mapped_file.h"

#if __has_include(<sys/mman.h>)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#define DELISO_CAN_MAP 1
#endif

namespace deliso {

#ifdef DELISO_CAN_MAP

std::shared_ptr<const MappedFile> MappedFile::open(const std::filesystem::path& path, std::uint64_t size) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  struct stat status {};
  const bool as_expected = fstat(descriptor, &status) == 0 && static_cast<std::uint64_t>(status.st_size) == size;
  void* const begin = as_expected && size > 0 ? mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0) : MAP_FAILED;
  close(descriptor);  // the mapping stays
  if (begin == MAP_FAILED) return nullptr;
  return std::shared_ptr<const MappedFile>(
      new MappedFile(std::span(static_cast<const std::byte*>(begin), static_cast<std::size_t>(size))));
}

MappedFile::~MappedFile() { munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size()); }

#else

std::shared_ptr<const MappedFile> MappedFile::open(const std::filesystem::path& /*path*/, std::uint64_t /*size*/) {
  return nullptr;
}

MappedFile::~MappedFile() = default;

#endif

}  // namespace deliso
