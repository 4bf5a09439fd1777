#include "engine/hall_formats/zip_archive.h"

#include "engine/base/late_library.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>

namespace stadion {
namespace {

const LateLibrary zipLibrary(STADION_LIBZIP, "libzip4");
const LateFunction<decltype(::zip_close)> zip_close(zipLibrary, "zip_close");
const LateFunction<decltype(::zip_discard)> zip_discard(zipLibrary, "zip_discard");
const LateFunction<decltype(::zip_error_fini)> zip_error_fini(zipLibrary, "zip_error_fini");
const LateFunction<decltype(::zip_error_init)> zip_error_init(zipLibrary, "zip_error_init");
const LateFunction<decltype(::zip_error_strerror)> zip_error_strerror(zipLibrary, "zip_error_strerror");
const LateFunction<decltype(::zip_fclose)> zip_fclose(zipLibrary, "zip_fclose");
const LateFunction<decltype(::zip_file_add)> zip_file_add(zipLibrary, "zip_file_add");
const LateFunction<decltype(::zip_file_set_dostime)> zip_file_set_dostime(zipLibrary, "zip_file_set_dostime");
const LateFunction<decltype(::zip_file_strerror)> zip_file_strerror(zipLibrary, "zip_file_strerror");
const LateFunction<decltype(::zip_fopen)> zip_fopen(zipLibrary, "zip_fopen");
const LateFunction<decltype(::zip_fread)> zip_fread(zipLibrary, "zip_fread");
const LateFunction<decltype(::zip_get_name)> zip_get_name(zipLibrary, "zip_get_name");
const LateFunction<decltype(::zip_get_num_entries)> zip_get_num_entries(zipLibrary, "zip_get_num_entries");
const LateFunction<decltype(::zip_name_locate)> zip_name_locate(zipLibrary, "zip_name_locate");
const LateFunction<decltype(::zip_open_from_source)> zip_open_from_source(zipLibrary, "zip_open_from_source");
const LateFunction<decltype(::zip_source_buffer)> zip_source_buffer(zipLibrary, "zip_source_buffer");
const LateFunction<decltype(::zip_source_buffer_create)> zip_source_buffer_create(zipLibrary,
                                                                                  "zip_source_buffer_create");
const LateFunction<decltype(::zip_source_close)> zip_source_close(zipLibrary, "zip_source_close");
const LateFunction<decltype(::zip_source_free)> zip_source_free(zipLibrary, "zip_source_free");
const LateFunction<decltype(::zip_source_keep)> zip_source_keep(zipLibrary, "zip_source_keep");
const LateFunction<decltype(::zip_source_open)> zip_source_open(zipLibrary, "zip_source_open");
const LateFunction<decltype(::zip_source_read)> zip_source_read(zipLibrary, "zip_source_read");
const LateFunction<decltype(::zip_source_stat)> zip_source_stat(zipLibrary, "zip_source_stat");
const LateFunction<decltype(::zip_strerror)> zip_strerror(zipLibrary, "zip_strerror");

constexpr std::size_t kUnpackedAtOnce = 1 << 16;
constexpr zip_uint16_t kDosDate = (0 << 9) | (1 << 5) | 1;  ///< 1 January 1980

struct EntryCloser {
  void operator()(zip_file* entry) const { zip_fclose(entry); }
};

struct ZipFault {
  zip_error_t value{};
  ZipFault() { zip_error_init(&value); }
  ~ZipFault() { zip_error_fini(&value); }
  ZipFault(const ZipFault&) = delete;
  ZipFault& operator=(const ZipFault&) = delete;
};

}  // namespace

void ZipArchive::Closer::operator()(zip* archive) const {
  zip_discard(archive);
}

Result<ZipArchive> ZipArchive::open(const std::string& bytes) {
  if (auto missing = zipLibrary.load()) return *std::move(missing);
  ZipFault fault;
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &fault.value);
  ZipArchive opened;
  if (source) opened.archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &fault.value));
  if (!opened.archive_) {
    if (source) zip_source_free(source);
    return Result<ZipArchive>::failure(
        fmt::format("this is not a sound ZIP archive: {}", zip_error_strerror(&fault.value)));
  }
  if (zip_get_num_entries(opened.archive_.get(), 0) > static_cast<zip_int64_t>(kMostFiles))
    return Result<ZipArchive>::failure(
        fmt::format("the archive has too many files; at most {} are allowed", kMostFiles));
  return opened;
}

bool ZipArchive::has(const std::string& name) const {
  return zip_name_locate(archive_.get(), name.c_str(), 0) >= 0;
}

std::vector<std::string> ZipArchive::names() const {
  std::vector<std::string> all;
  const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i)
    if (const char* name = zip_get_name(archive_.get(), static_cast<zip_uint64_t>(i), 0))
      all.emplace_back(name);
  return all;
}

Result<std::string> ZipArchive::file(const std::string& name, std::size_t limit) {
  using Bytes = Result<std::string>;
  const std::string shown = quotedWord(name);
  if (!has(name)) return Bytes::failure(fmt::format("{} is not in the archive", shown));
  const std::unique_ptr<zip_file, EntryCloser> entry(zip_fopen(archive_.get(), name.c_str(), 0));
  if (!entry)
    return Bytes::failure(
        fmt::format("{} cannot be unpacked: {}", shown, printable(zip_strerror(archive_.get()), 200)));
  const std::size_t most = std::min(limit, kMostUnpackedBytes - unpacked_);
  std::string bytes;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(std::min(before + kUnpackedAtOnce, most + 1));
    const zip_int64_t count = zip_fread(entry.get(), bytes.data() + before, bytes.size() - before);
    if (count < 0)
      return Bytes::failure(
          fmt::format("{} cannot be unpacked: {}", shown, printable(zip_file_strerror(entry.get()), 200)));
    bytes.resize(before + static_cast<std::size_t>(count));
    if (count == 0) break;
    if (bytes.size() > most)
      return Bytes::failure(fmt::format("{} is too large; at most {} bytes are read", shown, most));
  }
  unpacked_ += bytes.size();
  return bytes;
}

Result<std::string> packArchive(const std::map<std::string, std::string>& files) {
  using Bytes = Result<std::string>;
  if (auto missing = zipLibrary.load()) return *std::move(missing);
  ZipFault fault;
  const auto failure = [&fault](zip_t* archive) {
    const std::string why = archive ? zip_strerror(archive) : zip_error_strerror(&fault.value);
    if (archive) zip_discard(archive);
    return Bytes::failure("the archive cannot be made: " + why);
  };
  zip_source_t* whole = zip_source_buffer_create(nullptr, 0, 0, &fault.value);
  if (!whole) return failure(nullptr);
  zip_source_keep(whole);
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(whole, zip_source_free.address());
  zip_t* archive = zip_open_from_source(whole, ZIP_TRUNCATE, &fault.value);
  if (!archive) {
    zip_source_free(whole);
    return failure(nullptr);
  }
  for (const auto& [name, bytes] : files) {
    zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t at = source ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (at < 0) {
      if (source) zip_source_free(source);
      return failure(archive);
    }
    if (zip_file_set_dostime(archive, static_cast<zip_uint64_t>(at), 0, kDosDate, 0) != 0)
      return failure(archive);
  }
  if (zip_close(archive) != 0) return failure(archive);
  zip_stat_t facts;
  if (zip_source_open(whole) != 0 || zip_source_stat(whole, &facts) != 0) return failure(nullptr);
  std::string bytes(facts.size, '\0');
  const zip_int64_t count = zip_source_read(whole, bytes.data(), bytes.size());
  zip_source_close(whole);
  if (count != static_cast<zip_int64_t>(bytes.size())) return failure(nullptr);
  return bytes;
}

}  // namespace stadion
