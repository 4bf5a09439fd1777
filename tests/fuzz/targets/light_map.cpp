#include "engine/hall_formats/light_map_file.h"
#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

void light_map(Bytes bytes) {
  const auto read = readLightMap(asText(bytes));
  if (!read) return require(!read.error().message.empty(), "what is refused has a reason");
  const LightMap& map = read.value().map;
  require(map.values.size() == std::size_t{map.width} * map.height * map.channels,
          "a map has all its values");
  const auto written = lightMapAsPng(map);
  require(static_cast<bool>(written), "what is read can be written");
  const auto again = readLightMap(written.value());
  require(again && again.value().map == map, "what is written is read again");
}

}  // namespace stadion::fuzz
