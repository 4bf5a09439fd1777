#include "engine/asset/sound_file.h"

#include "engine/base/late_library.h"

#include <sndfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <memory>

namespace stadion {
namespace {

const LateLibrary soundLibrary(STADION_LIBSNDFILE, "libsndfile1");
const LateFunction<decltype(::sf_close)> sf_close(soundLibrary, "sf_close");
const LateFunction<decltype(::sf_open_fd)> sf_open_fd(soundLibrary, "sf_open_fd");
const LateFunction<decltype(::sf_readf_short)> sf_readf_short(soundLibrary, "sf_readf_short");
const LateFunction<decltype(::sf_strerror)> sf_strerror(soundLibrary, "sf_strerror");

constexpr std::uint64_t kMostBytes = 256ull << 20;   ///< of a file
constexpr std::uint64_t kMostSamples = 100'000'000;  ///< of all channels: 37 minutes of a CD

struct Closer {
  void operator()(SNDFILE* file) const { sf_close(file); }
};
using Open = std::unique_ptr<SNDFILE, Closer>;

bool isRead(int format) {
  switch (format & SF_FORMAT_TYPEMASK) {
  case SF_FORMAT_WAV:
  case SF_FORMAT_WAVEX:
  case SF_FORMAT_AIFF:
  case SF_FORMAT_FLAC: return true;
  case SF_FORMAT_OGG: return (format & SF_FORMAT_SUBMASK) == SF_FORMAT_VORBIS;
  default: return false;
  }
}

struct OpenedSound {
  Open file;
  SoundInfo info;
};

Result<OpenedSound> openSound(int file, const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    return Result<OpenedSound>::failure(fmt::format("\"{}\" {}", path, why));
  };
  if (auto missing = soundLibrary.load()) return *std::move(missing);
  struct stat s {};
  if (fstat(file, &s) != 0 || !S_ISREG(s.st_mode)) return refuse("is not a plain file");
  if (static_cast<std::uint64_t>(s.st_size) > kMostBytes)
    return refuse("is larger than 256 MiB; cut it into pieces");
  // A descriptor of its own: libsndfile moves its offset and closes it.
  const int own = dup(file);
  if (own < 0 || lseek(own, 0, SEEK_SET) != 0) {
    if (own >= 0) close(own);
    return refuse("cannot be read");
  }
  SF_INFO info{};
  OpenedSound opened{Open(sf_open_fd(own, SFM_READ, &info, SF_TRUE)), {}};
  if (!opened.file)
    return refuse(
        fmt::format("cannot be read as a sound (.wav, .aiff, .flac, .ogg): {}", sf_strerror(nullptr)));
  if (!isRead(info.format)) return refuse("is not a WAV, AIFF, FLAC or Ogg Vorbis file");
  if (info.channels != 1 && info.channels != 2)
    return refuse(fmt::format("has {} channels; make it one (mono) or two", info.channels));
  if (info.samplerate < 1000 || info.samplerate > 192'000)
    return refuse(fmt::format("has {} samples a second; from 1000 to 192000 are read", info.samplerate));
  if (info.frames <= 0) return refuse("holds no sound");
  if (static_cast<std::uint64_t>(info.frames) > kMostSamples / static_cast<std::uint64_t>(info.channels))
    return refuse("is too long; cut it into pieces of at most half an hour");
  opened.info = {static_cast<std::uint64_t>(info.frames), static_cast<std::uint32_t>(info.samplerate),
                 static_cast<std::uint32_t>(info.channels)};
  return opened;
}

}  // namespace

Nanoseconds SoundInfo::length() const {
  if (rate == 0) return 0;
  const std::uint64_t whole = samples / rate, rest = samples % rate;
  return static_cast<Nanoseconds>(whole * 1'000'000'000 + (rest * 1'000'000'000 + rate / 2) / rate);
}

Result<SoundInfo> readSoundInfo(int file, const std::string& path) {
  auto opened = openSound(file, path);
  if (!opened) return opened.error();
  return opened.value().info;
}

Result<Sound> readSound(int file, const std::string& path) {
  auto opened = openSound(file, path);
  if (!opened) return opened.error();
  Sound sound{opened.value().info, {}};
  const std::uint64_t wanted = sound.info.samples;
  sound.samples.resize(wanted * sound.info.channels);
  const sf_count_t got =
      sf_readf_short(opened.value().file.get(), sound.samples.data(), static_cast<sf_count_t>(wanted));
  // Missing samples are silence, so that the length is the same on every host.
  if (got < 0) return Result<Sound>::failure(fmt::format("\"{}\" cannot be decoded", path));
  return sound;
}

}  // namespace stadion
