#include "engine/base/shared_library.h"

#include "engine/base/file_descriptor.h"

#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <string>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>

namespace stadion {
namespace {

/// The library to look for, and the build stamp that was found.
struct Stamp {
  ElfW(Addr) place;
  std::string text{};
};

/// A segment of notes. Each note has a head, a name and a content; name and content fill words of four bytes.
std::string stampIn(const char* at, const char* end) {
  const auto whole = [](std::size_t bytes) { return (bytes + 3) & ~std::size_t{3}; };
  while (at + sizeof(ElfW(Nhdr)) <= end) {
    ElfW(Nhdr) note;
    std::memcpy(&note, at, sizeof note);
    const char* name = at + sizeof note;
    const char* content = name + whole(note.n_namesz);
    at = content + whole(note.n_descsz);
    if (at > end || note.n_type != NT_GNU_BUILD_ID ||
        std::string_view(name, note.n_namesz) != std::string_view("GNU", 4))
      continue;
    std::string text;
    for (const char* byte = content; byte != content + note.n_descsz; ++byte)
      text += fmt::format("{:02x}", static_cast<unsigned char>(*byte));
    return text;
  }
  return {};
}

int lookForStamp(dl_phdr_info* library, std::size_t, void* stamp) {
  Stamp& wanted = *static_cast<Stamp*>(stamp);
  if (library->dlpi_addr != wanted.place) return 0;
  for (int i = 0; i < library->dlpi_phnum && wanted.text.empty(); ++i) {
    const ElfW(Phdr)& segment = library->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const char* begin = reinterpret_cast<const char*>(library->dlpi_addr + segment.p_vaddr);
    wanted.text = stampIn(begin, begin + segment.p_memsz);
  }
  return 1;
}

}  // namespace

Result<SharedLibrary> SharedLibrary::open(const char* file, const char* package) {
  if (void* handle = dlopen(file, RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle);
  const char* reason = dlerror();
  const std::string why = reason ? reason : "unknown reason";
  // The loader's message begins with the missing file: ours, or one that ours needs.
  if (why.rfind(file, 0) == 0 && why.find("No such file") != std::string::npos)
    return Result<SharedLibrary>::failure(std::string(file) + " is missing: apt-get install " + package);
  return Result<SharedLibrary>::failure(std::string(file) + " cannot be loaded: " + why);
}

// The loader identifies a library by its file and its path, so a file in memory is a separate library. The
// file stays open: its path contains its number, which no other file may get.
Result<SharedLibrary> SharedLibrary::openCopy(const char* file, const char* package) {
  const auto original = open(file, package);
  if (!original) return original;
  const link_map* place = nullptr;
  const auto why = [&](const char* what) {
    return Result<SharedLibrary>::failure(std::string(file) + " cannot be loaded twice: " + what);
  };
  if (dlinfo(original.value().handle_, RTLD_DI_LINKMAP, &place) != 0 || !place) return why("where is it?");
  const FileDescriptor from(::open(place->l_name, O_RDONLY | O_CLOEXEC));
  const int copy = memfd_create(file, MFD_CLOEXEC);
  struct stat about {};
  if (from.get() < 0 || copy < 0 || fstat(from.get(), &about) != 0) return why(std::strerror(errno));
  for (off_t done = 0; done < about.st_size;)
    if (sendfile(copy, from.get(), &done, static_cast<std::size_t>(about.st_size - done)) <= 0)
      return why(std::strerror(errno));
  const std::string path = "/proc/self/fd/" + std::to_string(copy);
  if (void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle);
  return why(dlerror());
}

std::string SharedLibrary::buildId() const {
  const link_map* place = nullptr;
  if (dlinfo(handle_, RTLD_DI_LINKMAP, &place) != 0 || !place) return {};
  Stamp stamp{place->l_addr};
  dl_iterate_phdr(lookForStamp, &stamp);
  return stamp.text;
}

}  // namespace stadion
