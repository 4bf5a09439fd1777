#include "engine/hall_formats/light_map_file.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>

namespace stadion {
namespace {

constexpr int kLightMapCompression = 6;
constexpr std::uint64_t kMostInflation = 1100;  ///< no deflated byte stands for more

/// libpng leaves by longjmp after an error; nothing in the frames between may need a destructor.
struct LightMapJob {
  std::string_view rest;  ///< of the file that is read
  std::uint64_t size = 0;
  std::string* written = nullptr;
  const LightMap* map = nullptr;
  bool eightBits = false;
  ReadLightMap* read = nullptr;
  std::vector<png_byte>* rows = nullptr;
  std::vector<png_bytep>* starts = nullptr;
  char problem[200] = "libpng has no memory";
};

LightMapJob* jobOf(png_voidp pointer) {
  return static_cast<LightMapJob*>(pointer);
}

void onLightMapError(png_structp png, png_const_charp message) {
  auto* job = jobOf(png_get_error_ptr(png));
  std::snprintf(job->problem, sizeof job->problem, "%s", message);
  png_longjmp(png, 1);
}

void onLightMapWarning(png_structp, png_const_charp) {}

void takeBytes(png_structp png, png_bytep to, png_size_t count) {
  auto* job = jobOf(png_get_io_ptr(png));
  if (job->rest.size() < count) png_error(png, "the file ends too early");
  std::memcpy(to, job->rest.data(), count);
  job->rest.remove_prefix(count);
}

void giveBytes(png_structp png, png_bytep bytes, png_size_t count) {
  jobOf(png_get_io_ptr(png))->written->append(reinterpret_cast<const char*>(bytes), count);
}

void flushNothing(png_structp) {}

/// Makes the rows grey or RGB with 8 or 16 bits.
void asPlainRows(png_structp png, png_infop info, LightMapJob* job) {
  const png_byte colour = png_get_color_type(png, info);
  job->read->bitDepth = png_get_bit_depth(png, info);
  if (colour == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
  if (colour == PNG_COLOR_TYPE_GRAY && job->read->bitDepth < 8) png_set_expand_gray_1_2_4_to_8(png);
  job->read->hadOpacity = (colour & PNG_COLOR_MASK_ALPHA) != 0;
  if (job->read->hadOpacity) png_set_strip_alpha(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
}

bool decodeLightMap(LightMapJob* job) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, job, onLightMapError, onLightMapWarning);
  if (!png) return false;
  png_infop info = png_create_info_struct(png);
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_user_limits(png, kMostLightMapSide, kMostLightMapSide);
  png_set_chunk_malloc_max(png, 1 << 22);
  png_set_read_fn(png, job, takeBytes);
  png_read_info(png, info);
  LightMap& map = job->read->map;
  map.width = png_get_image_width(png, info);
  map.height = png_get_image_height(png, info);
  if (std::uint64_t{map.width} * map.height > kMostLightMapPixels) png_error(png, "it has too many pixels");
  asPlainRows(png, info, job);
  map.channels = png_get_channels(png, info);
  const bool wide = png_get_bit_depth(png, info) == 16;
  if (map.channels != 1 && map.channels != 3) png_error(png, "it is neither grey nor RGB");
  const std::size_t row = png_get_rowbytes(png, info);
  if (row * map.height > kMostInflation * job->size) png_error(png, "the file ends too early");
  job->rows->resize(row * map.height);
  job->starts->resize(map.height);
  for (std::uint32_t y = 0; y < map.height; ++y) (*job->starts)[y] = job->rows->data() + y * row;
  png_read_image(png, job->starts->data());
  map.values.resize(std::size_t{map.width} * map.height * map.channels);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const png_byte* at = job->rows->data() + (wide ? 2 * i : i);
    map.values[i] = static_cast<std::uint16_t>(wide ? at[0] << 8 | at[1] : at[0] * 257);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

bool encodeLightMap(LightMapJob* job) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, job, onLightMapError, onLightMapWarning);
  if (!png) return false;
  png_infop info = png_create_info_struct(png);
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  const LightMap& map = *job->map;
  png_set_write_fn(png, job, giveBytes, flushNothing);
  png_set_compression_level(png, kLightMapCompression);
  png_set_IHDR(png, info, map.width, map.height, job->eightBits ? 8 : 16,
               map.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const std::size_t count = std::size_t{map.width} * map.channels;
  job->rows->resize(2 * count);
  for (std::uint32_t y = 0; y < map.height; ++y) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint16_t value = map.values[y * count + i];
      if (job->eightBits) {
        (*job->rows)[i] = static_cast<png_byte>(value >> 8);
      } else {
        (*job->rows)[2 * i] = static_cast<png_byte>(value >> 8);
        (*job->rows)[2 * i + 1] = static_cast<png_byte>(value & 255);
      }
    }
    png_write_row(png, job->rows->data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

Result<ReadLightMap> readLightMap(std::string_view png) {
  ReadLightMap read;
  std::vector<png_byte> rows;
  std::vector<png_bytep> starts;
  LightMapJob job;
  job.rest = png;
  job.size = png.size();
  job.read = &read;
  job.rows = &rows;
  job.starts = &starts;
  if (decodeLightMap(&job)) return read;
  return Result<ReadLightMap>::failure(
      fmt::format("this is not a PNG file that can be read: {}", job.problem));
}

Result<std::string> lightMapAsPng(const LightMap& map) {
  using Bytes = Result<std::string>;
  if (map.width == 0 || map.height == 0 || map.width > kMostLightMapSide || map.height > kMostLightMapSide ||
      (map.channels != 1 && map.channels != 3) ||
      map.values.size() != std::size_t{map.width} * map.height * map.channels)
    return Bytes::failure("a light map is empty or too large");
  std::string bytes;
  std::vector<png_byte> rows;
  LightMapJob job;
  job.written = &bytes;
  job.map = &map;
  job.rows = &rows;
  job.eightBits = std::ranges::all_of(map.values, [](std::uint16_t v) { return v % 257 == 0; });
  if (encodeLightMap(&job)) return bytes;
  return Bytes::failure(fmt::format("the PNG file cannot be made: {}", job.problem));
}

}  // namespace stadion
