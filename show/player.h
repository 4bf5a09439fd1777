#pragma once
/// The entry for a program that plays shows frame by frame: open a show, take its stages, run the loop.
///
///     ShowOptions options;
///     options.script = "kick.evs";
///     Diagnostics findings;
///     if (!options.complete(findings)) return 2;  // `findings` has the reason
///     const auto player = Player::create(options, findings);
///     if (!player) return 2;
///     ShowParts parts = player->parts(StereoLayout::Off);
///     const auto renderer = ShowRenderer::open({});  // the processors, or OpenGL with a graphics card
///     if (!renderer) return 2;
///     renderer.value()->drawFor(parts);
///     ShowStages stages(std::move(parts));
///     FrameLoop loop(stages, player->loopOptions(), stop);
///     loop.run();

#include "pipeline/loop/frame_loop.h"
#include "pipeline/loop/show_stages.h"
#include "pipeline/target/rasteriser_settings.h"
#include "pipeline/target/target.h"
#include "show/player/player.h"
#include "show/player/show_renderer.h"
