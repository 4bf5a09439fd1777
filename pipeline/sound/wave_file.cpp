#include "pipeline/sound/wave_file.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::uint32_t kSampleBytes = 3;
constexpr double kFullScale = 8'388'607;
constexpr std::uint32_t kFormatBytes = 40, kSizesBytes = 28;
constexpr std::uint64_t kHeaderBytes = 12 + 8 + kSizesBytes + 8 + kFormatBytes + 8;

void putBytes(std::string& to, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i) & 0xff);
}

}  // namespace

WaveFile::WaveFile(std::string path, std::uint32_t channels, std::uint32_t rate)
    : file_(std::move(path)), channels_(channels), rate_(rate) {
  file_.write(header());
}

/// The same length for every size: the sizes of an RF64 file stand in a chunk that is else unused.
std::string WaveFile::header() const {
  constexpr std::uint64_t kMost = 0xffff'ffff;
  const std::uint64_t riff = kHeaderBytes - 8 + bytes_ + bytes_ % 2;
  const bool isLarge = riff > kMost;
  std::string text = isLarge ? "RF64" : "RIFF";
  putBytes(text, isLarge ? kMost : riff, 4);
  text += "WAVE";
  text += isLarge ? "ds64" : "JUNK";
  putBytes(text, kSizesBytes, 4);
  putBytes(text, isLarge ? riff : 0, 8);
  putBytes(text, isLarge ? bytes_ : 0, 8);
  putBytes(text, isLarge ? bytes_ / (kSampleBytes * channels_) : 0, 8);
  putBytes(text, 0, 4);
  text += "fmt ";
  putBytes(text, kFormatBytes, 4);
  putBytes(text, 0xfffe, 2);  // WAVE_FORMAT_EXTENSIBLE
  putBytes(text, channels_, 2);
  putBytes(text, rate_, 4);
  putBytes(text, std::uint64_t{rate_} * channels_ * kSampleBytes, 4);
  putBytes(text, std::uint64_t{channels_} * kSampleBytes, 2);
  putBytes(text, 8 * kSampleBytes, 2);
  putBytes(text, 22, 2);
  putBytes(text, 8 * kSampleBytes, 2);
  putBytes(text, 0, 4);  // no places
  putBytes(text, 1, 2);  // PCM: the first bytes of its GUID
  putBytes(text, 0x0010'0000'0000, 6);
  putBytes(text, 0x719b'3800'aa00'0080, 8);
  text += "data";
  putBytes(text, isLarge ? kMost : bytes_, 4);
  return text;
}

void WaveFile::write(std::span<const float> samples) {
  packed_.resize(samples.size() * kSampleBytes);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = samples[i];
    clipped_ += std::fabs(x) > 1;
    const long value = std::lround(std::clamp(x, -1.0, 1.0) * kFullScale);
    for (std::uint32_t b = 0; b < kSampleBytes; ++b)
      packed_[i * kSampleBytes + b] = static_cast<char>(value >> (8 * b) & 0xff);
  }
  file_.write(packed_.data(), packed_.size());
  bytes_ += packed_.size();
}

std::optional<Diagnostic> WaveFile::finish() {
  if (bytes_ % 2 == 1) file_.write(std::string_view("\0", 1));
  file_.overwrite(0, header());
  return file_.commit();
}

}  // namespace stadion
