#include "pipeline/sound/sample_store.h"

namespace stadion {

Sound mixedDown(const Sound& stereo) {
  Sound mixed{stereo.info, {}};
  mixed.info.channels = 1;
  mixed.samples.resize(stereo.samples.size() / 2);
  for (std::size_t i = 0; i < mixed.samples.size(); ++i)
    mixed.samples[i] =
        static_cast<std::int16_t>((int{stereo.samples[2 * i]} + int{stereo.samples[2 * i + 1]}) / 2);
  return mixed;
}

std::shared_ptr<const Sound> SampleStore::samplesOf(const SoundRecord& sound) {
  const auto [at, isNew] = samples_.try_emplace({sound.file, sound.range > 0});
  if (!isNew) return at->second;
  const auto found = roots_.open(sound.file);
  if (!found) return nullptr;
  auto read = readSound(found.value().file.get(), found.value().path);
  if (!read || read.value().samples.empty()) return nullptr;
  const bool mixes = sound.range > 0 && read.value().info.channels == 2;
  at->second = std::make_shared<const Sound>(mixes ? mixedDown(read.value()) : std::move(read.value()));
  return at->second;
}

void SampleStore::forgetMissing() {
  std::erase_if(samples_, [](const auto& s) { return !s.second; });
}

}  // namespace stadion
