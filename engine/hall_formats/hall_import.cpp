#include "engine/hall_formats/hall_import.h"

#include "engine/base/atomic_file.h"
#include "engine/base/plain_file.h"
#include "engine/display/covered_rectangle.h"
#include "engine/display/wall_lint.h"
#include "engine/hall_formats/hall_text.h"
#include "engine/hall_formats/mpcdi_reader.h"
#include "engine/hall_formats/mpcdi_writer.h"
#include "engine/hall_formats/ndisplay_reader.h"
#include "engine/hall_formats/sgct_reader.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

namespace stadion {
namespace {

constexpr std::size_t kMostConfigurationBytes = 8U << 20;

std::string dateNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

std::optional<WallFile> readByKind(const std::string& path, const std::string& content, Diagnostics& out) {
  const NeighbourFiles files = neighboursOf(path);
  if (content.starts_with("PK")) return readMpcdi(content, path, out);
  if (path.ends_with(".xml")) return readMpcdiXml(content, path, files, out);
  if (path.ends_with(".mpcdi")) return readMpcdi(content, path, out);
  if (path.ends_with(".cfg")) return readNdisplayCfg(content, path, files, out);
  if (path.ends_with(".ndisplay") || content.find("\"nDisplay\"") != std::string::npos)
    return readNdisplayJson(content, path, files, out);
  return readSgct(content, path, files, out);
}

}  // namespace

bool isForeignHall(const std::string& path) {
  return std::ranges::any_of(
      std::initializer_list<const char*>{".mpcdi", ".mpcdi.xml", ".json", ".ndisplay", ".cfg"},
      [&path](const char* ending) { return path.ends_with(ending); });
}

std::optional<WallFile> readForeignHall(const std::string& path, Diagnostics& out) {
  const Result<std::string> content =
      readPlainFile(path, path.ends_with(".mpcdi") ? kMostMpcdiBytes : kMostConfigurationBytes);
  if (!content) {
    out.add(content.error());
    return std::nullopt;
  }
  auto hall = readByKind(path, content.value(), out);
  if (hall) placeRectangles(*hall);
  return hall;
}

std::optional<WallFile> loadHall(const std::string& nameOrPath, const std::string& folder, Diagnostics& out) {
  if (!isForeignHall(nameOrPath)) return loadWalls(nameOrPath, folder, out);
  auto hall = readForeignHall(nameOrPath, out);
  if (!hall) return std::nullopt;
  Diagnostics findings;
  lintWalls(*hall, findings);
  out.append(findings);
  if (findings.hasErrors()) return std::nullopt;
  return hall;
}

std::optional<Diagnostic> writeHall(const WallFile& hall, const std::string& path, Diagnostics& out) {
  if (path.ends_with(".walls")) return writeHallText(hall, path, out);
  if (!path.ends_with(".mpcdi"))
    return Diagnostic{
        Severity::Error, {}, fmt::format("{} must end in .walls or .mpcdi", quotedWord(path)), {}};
  MpcdiSettings settings;
  settings.date = dateNow();
  const auto bytes = formatMpcdi(hall, neighboursOf(hall.file), settings);
  if (!bytes) return bytes.error();
  for (const WallEntry& entry : hall.walls)
    if (entry.projector && entry.projector->blend.computed) {
      out.note({path, 0, 0},
               "blend ramps are computed when the hall is drawn; the file has none for other programs");
      break;
    }
  return writeFile(path, bytes.value());
}

}  // namespace stadion
