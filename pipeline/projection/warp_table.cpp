#include "pipeline/projection/warp_table.h"

#include "pipeline/projection/blended_hall.h"

namespace stadion {
namespace {

TableGrid gridOf(const std::vector<float>& values, std::uint32_t size, const ColourTable::Range& range) {
  TableGrid grid;
  if (size == 0) return grid;
  grid.values = values.data();
  grid.last = static_cast<int>(size) - 1;
  for (std::size_t c = 0; c < 3; ++c) {
    grid.low[c] = static_cast<float>(range.low[c]);
    grid.scale[c] = static_cast<float>((size - 1) / (range.high[c] - range.low[c]));
  }
  return grid;
}

}  // namespace

ProjectorTable::ProjectorTable(const ColourTable& table, const ProjectorLight& light)
    : curve_(table.curve), solid_(table.solid) {
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t step = 0; step <= kWarpSteps; ++step) {
      const double root = static_cast<double>(step) / kWarpSteps;
      encoded_.push_back(static_cast<float>(displayValue(root * root, light.gamma[c])));
    }
  for (std::size_t c = 0; c < 3; ++c) table_.encoded[c] = encoded_.data() + c * (kWarpSteps + 1);
  table_.curve = gridOf(curve_, table.curveSize, table.curveRange);
  table_.solid = gridOf(solid_, table.solidSize, table.solidRange);
}

}  // namespace stadion
