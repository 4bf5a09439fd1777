#include "pipeline/target/shared_library.h"

#include "engine/asset/file_descriptor.h"

#include <cstring>
#include <fcntl.h>
#include <link.h>
#include <string>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>

namespace stadion {

Result<SharedLibrary> SharedLibrary::open(const char* file, const char* package) {
  if (void* handle = dlopen(file, RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle);
  const char* reason = dlerror();
  const std::string why = reason ? reason : "unknown reason";
  // The loader names the file it misses first: ours, or one that ours needs.
  if (why.rfind(file, 0) == 0 && why.find("No such file") != std::string::npos)
    return Result<SharedLibrary>::failure(std::string(file) + " is missing: apt-get install " + package);
  return Result<SharedLibrary>::failure(std::string(file) + " cannot be loaded: " + why);
}

// The loader knows a library by its file and its path; a file in memory is another one. It stays open, so
// that no other gets its number, which is its path.
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

}  // namespace stadion
