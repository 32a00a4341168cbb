#include "saved/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "boxwood/error.h"

namespace boxwood {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

[[noreturn]] void fail(const std::filesystem::path& file, int cause) {
  throw Error(fmt::format("cannot read '{}': {}", file.string(), std::generic_category().message(cause)));
}

}  // namespace

MappedFile map_file(const std::filesystem::path& file) {
  const Descriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status = {};
  if (descriptor.get() < 0 || fstat(descriptor.get(), &status) != 0) fail(file, errno);
  if (S_ISDIR(status.st_mode)) fail(file, EISDIR);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return {};  // an empty mapping does not exist
  void* memory = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor.get(), 0);
  if (memory == MAP_FAILED) fail(file, errno);
  std::shared_ptr<const void> owner(memory, [size](const void* m) { munmap(const_cast<void*>(m), size); });
  return {{static_cast<const std::byte*>(memory), size}, std::move(owner)};
}

}  // namespace boxwood
