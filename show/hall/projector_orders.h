#pragma once
/// Switches the projectors of a hall, and asks how they are: those that the wall file gives a control.
///
/// Threads  one for each projector, so that a silent one does not hold up the others.
/// Errors   by projector: one sentence each.

#include "engine/display/wall_file.h"
#include "pipeline/projector_control/pjlink_projector.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

enum class ProjectorOrder {
  Status,  ///< only asks
  On,
  Off,
  Open,  ///< shows the picture
  Shut,  ///< dark, and ready to be opened at once
};

/// What became of an order.
struct OrderedProjector {
  std::string name;                    ///< of the wall or projector in the file
  std::string host;                    ///< with its port
  std::optional<PjlinkStatus> status;  ///< after the order; nothing after an error
  std::string error;                   ///< empty: none
};

/// Gives the order to the projectors with these names, or to all if there are none. The result is in file
/// order. Nothing if a name has no control in the file, or none has: the findings say so. Waits at most
/// `patience` for each line of a projector.
std::optional<std::vector<OrderedProjector>> orderProjectors(const WallFile& hall, ProjectorOrder order,
                                                             const std::vector<std::string>& names,
                                                             std::chrono::milliseconds patience,
                                                             Diagnostics& findings);

}  // namespace stadion
