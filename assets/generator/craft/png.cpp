#include "assets/generator/craft/picture.h"

#include <algorithm>

namespace stadion::assets {
namespace {

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

std::string png(std::uint32_t width, std::uint32_t height, PngKind kind, const std::string& palette,
                const std::string& rows) {
  std::string head;
  put32(head, width), put32(head, height);
  head.push_back(static_cast<char>(kind.bits)), head.push_back(static_cast<char>(kind.colour));
  head += std::string(3, '\0');
  std::string out = "\x89PNG\r\n\x1a\n";
  chunk(out, "IHDR", head);
  if (!palette.empty()) chunk(out, "PLTE", palette);
  chunk(out, "IDAT", stored(rows)), chunk(out, "IEND", "");
  return out;
}

}  // namespace stadion::assets
