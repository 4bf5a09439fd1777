#pragma once
/// The files in a ZIP archive, in memory.
///
/// Bounds   a file that unpacks to more than the caller's limit, or together with others to more than
///          kMostUnpackedBytes, is refused before more of it is unpacked.
/// Threads  one archive, one thread.
/// Errors   are sentences for the user.

#include "engine/base/diagnostic.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace stadion {

class ZipArchive {
public:
  static constexpr std::size_t kMostUnpackedBytes = std::size_t{1} << 30;
  static constexpr std::size_t kMostFiles = 4096;

  /// Opens an archive; `bytes` stays alive as long as the archive.
  static Result<ZipArchive> open(const std::string& bytes);

  bool has(const std::string& name) const;
  std::vector<std::string> names() const;
  /// Unpacks the file.
  Result<std::string> file(const std::string& name, std::size_t limit);

private:
  struct Closer {
    void operator()(zip* archive) const;
  };
  std::unique_ptr<zip, Closer> archive_;
  std::size_t unpacked_ = 0;
};

/// Packs the files, by name. All their dates are the same, so that equal files give equal archives.
Result<std::string> packArchive(const std::map<std::string, std::string>& files);

}  // namespace stadion
