#pragma once
/// The samples of a show's sound files. Each is read once; the loader has already reported what is wrong with it.
///
/// Ownership  borrows the roots. Voices share the samples.
/// Threads    one at a time.
/// Errors     a file that cannot be read has no samples.

#include "engine/asset/roots.h"
#include "engine/asset/sound_file.h"
#include "engine/published/sound_scape.h"

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace stadion {

class SampleStore {
public:
  explicit SampleStore(const AssetRoots& roots) : roots_(roots) {}

  /// A sound with a place has one channel. Null: there are no samples.
  std::shared_ptr<const Sound> samplesOf(const SoundRecord& sound);
  /// Reads again what could not be read, such as without memory.
  void forgetMissing();

private:
  const AssetRoots& roots_;
  /// By file, and whether mixed into one channel.
  std::map<std::pair<std::string, bool>, std::shared_ptr<const Sound>> samples_;
};

/// Returns the sound with its two channels averaged.
Sound mixedDown(const Sound& stereo);

}  // namespace stadion
