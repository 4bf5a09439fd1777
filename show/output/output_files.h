#pragma once
/// The files of `--out DIR` of a command that knows their names before it begins.
///
/// They are opened first, so a folder that cannot be written is reported before the work. Each appears
/// complete, with commit(), or not at all.
///
/// Ownership  owns the temporary files; without commit() they are removed.
/// Threads    one at a time.

#include "engine/base/atomic_file.h"
#include "show/output/output_names.h"

#include <map>
#include <string>
#include <vector>

namespace stadion {

class OutputFiles {
public:
  /// An empty folder: nothing is written.
  OutputFiles(std::string folder, std::vector<std::string> names);

  bool areWanted() const { return !folder_.empty(); }
  /// For refuseOverwriting().
  std::vector<NamedFile> named() const;
  /// Makes the folder and opens the files. False if one cannot be written; the findings say why.
  bool open(Diagnostics& findings);
  /// The content of one of the files. Without areWanted(), nothing happens.
  void write(const std::string& name, std::string_view content);
  /// Completes the files that have been written. False if one could not be.
  bool commit(Diagnostics& findings);

private:
  struct File {
    AtomicFile file;
    bool isWritten = false;
    explicit File(std::string path) : file(std::move(path)) {}
  };

  std::string folder_;
  std::vector<std::string> names_;
  std::map<std::string, File> files_;  ///< by name
};

}  // namespace stadion
