#pragma once
/// The room from outside: where its walls are, where the visitor stands and what the hand does.
///
/// Ownership  its figures lie in the show's mesh store, which must outlive it.
/// Threads    moved on the main thread, told of the input on the App thread, asked on its view's Cull thread.

#include "engine/display/wall_file.h"
#include "engine/input/input_sample.h"
#include "pipeline/view/free_camera.h"

#include <mutex>

namespace stadion {

/// How it stands to the middle of the room.
struct OverviewPlace {
  bool shown = false;
  double around = 0.6;  ///< to the right, from behind the visitor [rad]
  double above = 0.45;  ///< the horizon [rad]
  double distance = 0;  ///< [m]; 0 = as far as the room asks for

  void turn(double right, double up);
  /// Above 1 goes away.
  void zoom(double factor, const WallFile& walls);
};

class Overview final : public FreeCamera {
public:
  /// `aspect`: width by height of its picture.
  Overview(MeshStore& meshes, const WallFile& walls, double aspect);
  ~Overview() override;

  void move(const OverviewPlace& place);
  void see(const InputSample& input);

  std::optional<CameraView> view() const override;
  void addTo(std::vector<InstanceRecord>& records, const ViewerRecord& viewer) const override;

private:
  MeshStore& meshes_;
  const WallFile& walls_;
  double aspect_;
  MeshId room_, head_, body_, wand_;
  mutable std::mutex mutex_;
  OverviewPlace place_;
  std::optional<Pose> X_RT_;  ///< the wand
};

}  // namespace stadion
