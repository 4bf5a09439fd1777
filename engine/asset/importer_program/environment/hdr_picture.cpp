#include "engine/asset/importer_program/environment/radiance_picture.h"

#include "engine/asset/importer_program/source/source_scene.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <string_view>

namespace stadion::importer {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

[[noreturn]] void refuseDamaged(const char* where) {
  throw Refusal(std::string("is damaged: ") + where);
}

class HdrReader {
public:
  explicit HdrReader(std::span<const std::uint8_t> file) : rest_(file) {}

  RadianceMap read() {
    readHead();
    RadianceMap map;
    readSize(map);
    map.pixels.reserve(std::size_t{map.width} * map.height);
    std::vector<Rgbe> row(map.width);
    for (std::uint32_t y = 0; y < map.height; ++y) {
      readRow(row);
      for (const Rgbe& pixel : row) map.pixels.push_back(lightOf(pixel));
    }
    return map;
  }

private:
  /// Up to the end of the line, which some programs write in two bytes.
  std::string_view line() {
    constexpr std::size_t kLongest = 4096;
    const auto end = std::ranges::find(rest_.first(std::min(rest_.size(), kLongest)), '\n');
    const auto size = static_cast<std::size_t>(end - rest_.begin());
    if (size >= std::min(rest_.size(), kLongest)) refuseDamaged("its head has no end");
    std::string_view text(reinterpret_cast<const char*>(rest_.data()), size);
    rest_ = rest_.subspan(size + 1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  /// Up to the empty line.
  void readHead() {
    const std::string_view first = line();
    if (!first.starts_with("#?RADIANCE") && !first.starts_with("#?RGBE"))
      throw Refusal("is no Radiance picture: it does not begin with #?RADIANCE");
    constexpr std::string_view kFormat = "FORMAT=";
    for (std::string_view text = line(); !text.empty(); text = line())
      if (text.starts_with(kFormat) && text.substr(kFormat.size()) != "32-bit_rle_rgbe")
        throw Refusal("has the format " + std::string(text.substr(kFormat.size())) + "; use 32-bit_rle_rgbe");
  }

  static std::int64_t numberIn(std::string_view& text, std::string_view before) {
    if (!text.starts_with(before)) throw Refusal("does not begin with its upper left pixel");
    text.remove_prefix(before.size());
    std::int64_t number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (fault != std::errc()) refuseDamaged("its size is no number");
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
  }

  void readSize(RadianceMap& map) {
    std::string_view text = line();
    const std::int64_t height = numberIn(text, "-Y "), width = numberIn(text, " +X ");
    checkRadianceSize(width, height);
    map.width = static_cast<std::uint32_t>(width);
    map.height = static_cast<std::uint32_t>(height);
  }

  std::uint8_t byte() {
    if (rest_.empty()) refuseDamaged("it is cut short");
    const std::uint8_t value = rest_[0];
    rest_ = rest_.subspan(1);
    return value;
  }
  Rgbe pixel() {
    Rgbe value{};
    for (std::uint8_t& part : value) part = byte();
    return value;
  }

  void readRow(std::vector<Rgbe>& row) {
    constexpr std::size_t kLeastPacked = 8, kMostPacked = 32767;
    const Rgbe head = pixel();
    const bool packed = head[0] == 2 && head[1] == 2 && head[2] < 128;
    if (!packed || row.size() < kLeastPacked || row.size() > kMostPacked) return readPlainRow(row, head);
    if ((std::size_t{head[2]} << 8 | head[3]) != row.size()) refuseDamaged("a row has another length");
    for (std::size_t part = 0; part < 4; ++part)
      for (std::size_t x = 0; x < row.size();) {
        const std::uint8_t count = byte();
        const bool repeats = count > 128;
        const std::size_t run = repeats ? count - 128u : count;
        if (run == 0 || run > row.size() - x) refuseDamaged("a run is longer than its row");
        for (std::uint8_t value = repeats ? byte() : std::uint8_t{0}, i = 0; i < run; ++i)
          row[x++][part] = repeats ? value : byte();
      }
  }

  /// Pixel by pixel. One that is (1, 1, 1, n) repeats the pixel before it; several in a row count higher.
  void readPlainRow(std::vector<Rgbe>& row, Rgbe next) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < row.size(); next = x < row.size() ? pixel() : next) {
      if (next[0] != 1 || next[1] != 1 || next[2] != 1) {
        row[x++] = next;
        shift = 0;
        continue;
      }
      const std::size_t run = shift < 24 ? std::size_t{next[3]} << shift : row.size() + 1;
      if (x == 0 || run > row.size() - x) refuseDamaged("a run is longer than its row");
      std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), run, row[x - 1]);
      x += run;
      shift += 8;
    }
  }

  static Radiance lightOf(const Rgbe& p) {
    if (p[3] == 0) return {};
    // 2 to the (exponent - 136), in two steps, since it may be smaller than a float's exponent.
    const auto power = [](int e) { return std::bit_cast<float>(static_cast<std::uint32_t>(e + 127) << 23); };
    const int exponent = int{p[3]} - 136, half = exponent / 2;
    const float scale = power(half) * power(exponent - half);
    const auto light = [&](std::uint8_t part) { return static_cast<float>(part) * scale; };
    return {light(p[0]), light(p[1]), light(p[2])};
  }

  std::span<const std::uint8_t> rest_;
};

}  // namespace

RadianceMap readRadianceHdr(std::span<const std::uint8_t> file) {
  RadianceMap map = HdrReader(file).read();
  checkRadiance(map);
  return map;
}

}  // namespace stadion::importer
