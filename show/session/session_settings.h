#pragma once
/// Everything that a session can be asked for. Each part has its settings beside it.

#include "show/cluster/cluster_settings.h"
#include "show/console/operator_settings.h"
#include "show/player/draw_settings.h"
#include "show/player/drawing_plan.h"
#include "show/player/play_settings.h"
#include "show/recording/record_settings.h"
#include "show/supervision/supervision_settings.h"
#include "show/web/web_settings.h"

namespace stadion {

struct SessionSettings {
  ShowOptions show;
  PlaySettings play;
  DrawSettings draw;
  RecordSettings record;
  OperatorSettings console;
  ClusterSettings cluster;
  SupervisionSettings supervision;
  WebSettings web;

  /// Returns what decides between threads and processes for so many walls.
  DrawingNeeds drawingNeeds(std::size_t walls) const;
  /// The processes that draw the walls; null if this process draws them.
  std::optional<WallProcesses> wallProcesses(const Player& player, const DrawSetting& setting,
                                             RendererKind renderer,
                                             std::function<void(const std::string&)> say) const;
};

}  // namespace stadion
