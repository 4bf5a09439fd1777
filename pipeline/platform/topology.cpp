// The only file that knows hwloc.
#include "pipeline/platform/topology.h"

#include <climits>
#include <hwloc.h>

namespace stadion {

struct Topology::Loaded {
  hwloc_topology_t topology = nullptr;

  Loaded() { hwloc_topology_init(&topology); }
  ~Loaded() { hwloc_topology_destroy(topology); }
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  /// Leaves out disks and networks, which take time to find.
  bool load() {
    hwloc_topology_set_io_types_filter(topology, HWLOC_TYPE_FILTER_KEEP_NONE);
    return hwloc_topology_load(topology) == 0;
  }

  std::size_t count(hwloc_obj_type_t type) const {
    const int n = hwloc_get_nbobjs_by_type(topology, type);
    return n > 0 ? static_cast<std::size_t>(n) : 0;
  }
};

Topology::Topology(std::unique_ptr<Loaded> loaded) : loaded_(std::move(loaded)) {}
Topology::~Topology() = default;
Topology::Topology(Topology&&) noexcept = default;
Topology& Topology::operator=(Topology&&) noexcept = default;

Topology Topology::ofThisMachine() {
  auto loaded = std::make_unique<Loaded>();
  hwloc_topology_set_flags(loaded->topology, HWLOC_TOPOLOGY_FLAG_RESTRICT_TO_CPUBINDING);
  return Topology(loaded->load() ? std::move(loaded) : nullptr);
}

Topology Topology::synthetic(const std::string& description) {
  auto loaded = std::make_unique<Loaded>();
  const bool well = hwloc_topology_set_synthetic(loaded->topology, description.c_str()) == 0;
  return Topology(well && loaded->load() ? std::move(loaded) : nullptr);
}

std::string Topology::model() const {
  if (!loaded_) return {};
  const hwloc_obj_t package = hwloc_get_obj_by_type(loaded_->topology, HWLOC_OBJ_PACKAGE, 0);
  const char* name = package ? hwloc_obj_get_info_by_name(package, "CPUModel") : nullptr;
  return name ? name : "";
}

std::size_t Topology::cores() const {
  return loaded_ ? loaded_->count(HWLOC_OBJ_CORE) : 0;
}

std::size_t Topology::hardwareThreads() const {
  return loaded_ ? loaded_->count(HWLOC_OBJ_PU) : 0;
}

std::vector<ProcessorSet> Topology::parts(std::size_t walls) const {
  std::vector<ProcessorSet> parts(walls);
  if (!loaded_ || walls == 0) return parts;
  std::vector<hwloc_bitmap_t> sets(walls, nullptr);
  hwloc_obj_t root = hwloc_get_root_obj(loaded_->topology);
  if (hwloc_distrib(loaded_->topology, &root, 1, sets.data(), static_cast<unsigned>(walls), INT_MAX, 0) != 0)
    return parts;
  for (std::size_t wall = 0; wall < walls; ++wall) {
    for (int i = hwloc_bitmap_first(sets[wall]); i >= 0; i = hwloc_bitmap_next(sets[wall], i))
      parts[wall].add(static_cast<std::size_t>(i));
    hwloc_bitmap_free(sets[wall]);
  }
  return parts;
}

}  // namespace stadion
