#include "engine/asset/importer_program/mesh/picture_decoder.h"

#include <png.h>
#include <webp/decode.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include <jpeglib.h>

namespace stadion::importer {
namespace {

bool roomFor(std::uint64_t width, std::uint64_t height, const MeshLimits& limits, std::uint64_t& budget,
             std::string& why) {
  if (width == 0 || height == 0 || width > limits.textureSide || height > limits.textureSide) {
    why = "measures " + std::to_string(width) + " x " + std::to_string(height) + " pixels; at most " +
          std::to_string(limits.textureSide) + " a side are allowed";
    return false;
  }
  if (width * height * 4 > budget) {
    why = "is one picture too many: together they exceed the memory for textures";
    return false;
  }
  budget -= width * height * 4;
  return true;
}

bool decodePng(std::span<const std::uint8_t> bytes, const MeshLimits& limits, std::uint64_t& budget,
               Texture& out, std::string& why) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) {
    why = std::string("is not a sound PNG: ") + image.message;
    return false;
  }
  if (!roomFor(image.width, image.height, limits, budget, why)) {
    png_image_free(&image);
    return false;
  }
  image.format = PNG_FORMAT_RGBA;
  out.width = image.width;
  out.height = image.height;
  out.rgba.resize(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, out.rgba.data(), 0, nullptr)) {
    why = std::string("is not a sound PNG: ") + image.message;
    return false;
  }
  return true;
}

struct JpegErrors {
  jpeg_error_mgr base;
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX];
};

void onJpegError(j_common_ptr info) {
  auto* errors = reinterpret_cast<JpegErrors*>(info->err);
  info->err->format_message(info, errors->message);
  std::longjmp(errors->back, 1);
}

void onJpegWarning(j_common_ptr, int) {}

// Between setjmp and longjmp lives no object with a destructor: the caller owns them all.
bool runJpeg(jpeg_decompress_struct& jpeg, JpegErrors& errors, const MeshLimits& limits,
             std::uint64_t& budget, Texture& out, std::vector<std::uint8_t>& row, std::string& why,
             std::span<const std::uint8_t> bytes) {
  if (setjmp(errors.back)) {
    why = std::string("is not a sound JPEG: ") + errors.message;
    return false;
  }
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  if (!roomFor(jpeg.image_width, jpeg.image_height, limits, budget, why)) return false;
  jpeg.out_color_space = JCS_RGB;
  jpeg_start_decompress(&jpeg);
  if (jpeg.output_components != 3) {
    why = "is a JPEG of an unusual colour space";
    return false;
  }
  out.width = jpeg.output_width;
  out.height = jpeg.output_height;
  out.rgba.assign(std::size_t{out.width} * out.height * 4, 255);
  row.resize(std::size_t{out.width} * 3);
  while (jpeg.output_scanline < jpeg.output_height) {
    std::uint8_t* to = out.rgba.data() + std::size_t{jpeg.output_scanline} * out.width * 4;
    JSAMPROW rows[] = {row.data()};
    jpeg_read_scanlines(&jpeg, rows, 1);
    for (std::size_t x = 0; x < out.width; ++x) std::memcpy(to + 4 * x, row.data() + 3 * x, 3);
  }
  return true;
}

bool decodeJpeg(std::span<const std::uint8_t> bytes, const MeshLimits& limits, std::uint64_t& budget,
                Texture& out, std::string& why) {
  jpeg_decompress_struct jpeg{};
  JpegErrors errors{};
  jpeg.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = onJpegError;
  errors.base.emit_message = onJpegWarning;
  jpeg_create_decompress(&jpeg);
  std::vector<std::uint8_t> row;
  const bool good = runJpeg(jpeg, errors, limits, budget, out, row, why, bytes);
  jpeg_destroy_decompress(&jpeg);
  return good;
}

bool decodeWebp(std::span<const std::uint8_t> bytes, const MeshLimits& limits, std::uint64_t& budget,
                Texture& out, std::string& why) {
  int width = 0, height = 0;
  const bool known = WebPGetInfo(bytes.data(), bytes.size(), &width, &height) != 0;
  why = "is not a sound WebP";
  if (!known ||
      !roomFor(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), limits, budget, why))
    return false;
  out.width = static_cast<std::uint32_t>(width);
  out.height = static_cast<std::uint32_t>(height);
  out.rgba.resize(std::size_t{out.width} * out.height * 4);
  why = "is not a sound WebP";
  return WebPDecodeRGBAInto(bytes.data(), bytes.size(), out.rgba.data(), out.rgba.size(), 4 * width) !=
         nullptr;
}

bool startsWith(std::span<const std::uint8_t> bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

}  // namespace

bool decodePicture(std::span<const std::uint8_t> bytes, const MeshLimits& limits, std::uint64_t& budget,
                   Texture& out, std::string& why) {
  if (startsWith(bytes, "\x89PNG")) return decodePng(bytes, limits, budget, out, why);
  if (startsWith(bytes, "\xff\xd8\xff")) return decodeJpeg(bytes, limits, budget, out, why);
  if (startsWith(bytes, "RIFF") && startsWith(bytes.subspan(std::min<std::size_t>(8, bytes.size())), "WEBP"))
    return decodeWebp(bytes, limits, budget, out, why);
  why = "is a picture of another format; use PNG or JPEG";
  if (startsWith(bytes, "BM")) why = "is a BMP picture; use PNG or JPEG";
  if (startsWith(bytes, "DDS ")) why = "is a DDS picture; use PNG or JPEG";
  if (startsWith(bytes, "GIF8")) why = "is a GIF picture; use PNG or JPEG";
  if (startsWith(bytes, "\xabKTX 20")) why = "is a KTX2 picture; use PNG or JPEG";
  return false;
}

}  // namespace stadion::importer
