#include "pipeline/picture/picture.h"

#include "engine/base/atomic_file.h"

#include <fmt/format.h>
#include <png.h>
#include <xxhash.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace stadion {
namespace {

constexpr int kCompression = 3;  ///< fixed, so that equal pictures give equal bytes; higher costs far more
                                 ///< than it saves
constexpr std::uint32_t kMaxSide = 16384;

bool opaque(const Picture& picture) {
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
    if (picture.rgba[i] != 255) return false;
  return true;
}

/// libpng leaves by longjmp after an error; nothing in these frames may need a destructor.
struct WriteJob {
  AtomicFile* file;
  const Picture* picture;
  char problem[200];
};

void onError(png_structp png, png_const_charp message) {
  auto* job = static_cast<WriteJob*>(png_get_error_ptr(png));
  std::snprintf(job->problem, sizeof job->problem, "%s", message);
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onWrite(png_structp png, png_bytep bytes, png_size_t count) {
  auto* job = static_cast<WriteJob*>(png_get_io_ptr(png));
  job->file->write(bytes, count);
  if (job->file->failed()) png_error(png, "not written");
}

void onFlush(png_structp) {}

bool encode(WriteJob* job, bool withAlpha) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, job, onError, onWarning);
  if (!png) return false;
  png_infop info = png_create_info_struct(png);
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, job, onWrite, onFlush);
  png_set_compression_level(png, kCompression);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_IHDR(png, info, job->picture->width, job->picture->height, 8,
               withAlpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  if (!withAlpha) png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (std::uint32_t y = 0; y < job->picture->height; ++y) png_write_row(png, job->picture->at(0, y));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

std::uint64_t imageHash(const Picture& picture) {
  return XXH64(picture.rgba.data(), picture.rgba.size(), 0);
}

std::optional<Diagnostic> writePng(const std::string& path, const Picture& picture) {
  AtomicFile file(path);
  const bool sound = picture.width > 0 && picture.height > 0 && picture.width <= kMaxSide &&
                     picture.height <= kMaxSide &&
                     picture.rgba.size() == std::size_t(picture.width) * picture.height * 4;
  if (!sound) file.fail("the picture is empty or too large");
  WriteJob job{&file, &picture, "libpng has no memory"};
  if (!file.failed() && !encode(&job, !opaque(picture))) file.fail(job.problem);
  return file.commit();
}

std::string pngOf(const Picture& picture) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(picture.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
    rgb.insert(rgb.end(), &picture.rgba[i], &picture.rgba[i + 3]);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = picture.width;
  image.height = picture.height;
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (rgb.empty() || !png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr))
    return "";
  bytes.resize(size);
  return bytes;
}

Result<Picture> readPng(const std::string& path) {
  const auto failure = [&path](const std::string& why) {
    Diagnostic d;
    d.where.file = path;
    d.message = fmt::format("cannot be read: {}", why);
    return d;
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), &std::fclose);
  if (!file) return failure(std::strerror(errno));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_stdio(&image, file.get())) return failure(image.message);
  const std::unique_ptr<png_image, void (*)(png_imagep)> freed(&image, &png_image_free);
  if (image.width > kMaxSide || image.height > kMaxSide) return failure("it is too large");
  image.format = PNG_FORMAT_RGBA;
  Picture picture(image.width, image.height);
  if (!png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr)) return failure(image.message);
  return picture;
}

}  // namespace stadion
