#include "cli/assets/models.h"

#include <algorithm>

// Blades of grass, drawn as short strokes of sixteen greens. The PNG is written without compression, because
// what a compressor makes depends on its version.

namespace stadion::assets {
namespace {

constexpr int kSide = 256;  // pixels
constexpr int kShades = 16;

class Dice {  // a small linear congruential generator
public:
  unsigned roll(unsigned sides) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<unsigned>((state_ >> 33) % sides);
  }

private:
  std::uint64_t state_ = 20260101;
};

std::vector<int> draw() {
  std::vector<int> shade(kSide * kSide, 7);
  Dice dice;
  const auto at = [&](int x, int y) -> int& {
    return shade[static_cast<std::size_t>((y & 255) * kSide + (x & 255))];
  };
  for (int blade = 0; blade < 14000; ++blade) {
    int x = static_cast<int>(dice.roll(kSide)), y = static_cast<int>(dice.roll(kSide));
    const int base = 4 + static_cast<int>(dice.roll(5) + dice.roll(4)),
              length = 4 + static_cast<int>(dice.roll(6));
    const int lean = static_cast<int>(dice.roll(3)) - 1;
    for (int i = 0; i < length; ++i) {
      at(x, y) = std::clamp(base - 3 + 5 * i / length, 0, kShades - 1);  // dark at the root, light at the tip
      --y;
      if (dice.roll(3) == 0) x += lean;
    }
  }
  return shade;
}

void put32(std::string& out, std::uint32_t v) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(v >> shift & 255));
}

std::uint32_t crc(const std::string& data) {
  std::uint32_t c = 0xffffffff;
  for (const char byte : data) {
    c ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >> 1) : c >> 1;
  }
  return ~c;
}

void chunk(std::string& out, const std::string& kind, const std::string& content) {
  put32(out, static_cast<std::uint32_t>(content.size()));
  out += kind + content;
  put32(out, crc(kind + content));
}

std::string stored(const std::string& data) {
  std::string out = "\x78\x01";
  for (std::size_t at = 0; at < data.size(); at += 65535) {
    const std::size_t n = std::min<std::size_t>(65535, data.size() - at);
    out.push_back(at + n == data.size() ? 1 : 0);
    for (std::size_t v : {n, ~n})
      out.push_back(static_cast<char>(v & 255)), out.push_back(static_cast<char>(v >> 8 & 255));
    out += data.substr(at, n);
  }
  std::uint32_t a = 1, b = 0;
  for (const char byte : data) a = (a + static_cast<unsigned char>(byte)) % 65521, b = (b + a) % 65521;
  put32(out, b << 16 | a);
  return out;
}

}  // namespace

std::string grassPicture() {
  std::string head, palette, rows;
  put32(head, kSide), put32(head, kSide);
  head += std::string("\x04\x03\0\0\0", 5);  // four bits a pixel, palette
  for (int i = 0; i < kShades; ++i) {
    palette.push_back(static_cast<char>(44 + 5 * i));
    palette.push_back(static_cast<char>(92 + 6 * i));
    palette.push_back(static_cast<char>(30 + 3 * i));
  }
  const std::vector<int> shade = draw();
  for (std::size_t y = 0; y < kSide; ++y) {
    rows.push_back(0);
    for (std::size_t x = 0; x < kSide; x += 2)
      rows.push_back(static_cast<char>(shade[y * kSide + x] << 4 | shade[y * kSide + x + 1]));
  }
  std::string out = "\x89PNG\r\n\x1a\n";
  chunk(out, "IHDR", head), chunk(out, "PLTE", palette), chunk(out, "IDAT", stored(rows)),
      chunk(out, "IEND", "");
  return out;
}

}  // namespace stadion::assets
