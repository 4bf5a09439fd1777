#include "cli/bench_walls.h"

#include "cli/exit_code.h"
#include "cli/number_option.h"
#include "cli/player.h"
#include "cli/temporary_folder.h"
#include "cli/walls_measure.h"
#include "profiling/bench/walls/wall_scene.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace stadion {
namespace {

struct Options {
  WallsSetting one;
  bool measureOne = false;
  std::string layout = "flat";
};

/// In this process, so that its processor time is that setting's.
int measureOne(WallsSetting s) {
  const TemporaryFolder folder;
  const bench::WallScene scene{s.scene.front()};
  const std::string wrong =
      bench::writeWallScene(folder.path(""), scene, s.walls, !s.flat, s.warm + s.frames + 1);
  if (!wrong.empty()) return std::fprintf(stderr, "stadion: %s\n", wrong.c_str()), kBadInput;
  const auto row = measureWalls(s, folder.path(""));
  if (!row) {
    std::fprintf(stderr, "stadion: %s\n", format(row.error()).c_str());
    return kInternalFault;
  }
  std::printf("%s\n", row.value().dump().c_str());
  return kOk;
}

int benchWalls(const Options& o) {
  WallsSetting one = o.one;
  one.flat = o.layout == "flat";
  return measureOne(std::move(one));
}

}  // namespace

void addBenchWalls(CLI::App& bench, int& code) {
  auto o = std::make_shared<Options>();
  CLI::App* command =
      bench.add_subcommand("walls", "A room of stereo walls beside OpenSceneGraph and bare OpenGL");
  command->add_flag("--one", o->measureOne, "measure one setting in this process and print it as JSON");
  command->add_option("--scene", o->one.scene, "a, b or c")->check(CLI::IsMember({"a", "b", "c"}));
  command->add_option("--class", o->one.kind, "STRICT, OPEN or SUBMIT")
      ->check(CLI::IsMember({"STRICT", "OPEN", "SUBMIT"}));
  command->add_option("--mode", o->one.mode, "pipelined or sequential")
      ->check(CLI::IsMember({"pipelined", "sequential"}));
  command->add_option("--gl", o->one.gl, "osmesa or egl")->check(CLI::IsMember({"osmesa", "egl"}));
  command->add_option("--wall-workers", o->one.workers, "thread or process")
      ->check(CLI::IsMember({"thread", "process"}));
  command->add_option("--layout", o->layout, "flat, or grid: nodes in cells with a group each")
      ->check(CLI::IsMember({"flat", "grid"}));
  command->add_option("--walls", o->one.walls, "1 to 6")->check(wholeNumberFrom(1, 6));
  command->add_option("--width", o->one.width, "[pixels]")->check(wholeNumberFrom(8, 16384));
  command->add_option("--height", o->one.height, "[pixels]")->check(wholeNumberFrom(8, 16384));
  command->add_option("--warm", o->one.warm, "frames before those that are measured")
      ->check(wholeNumberFrom(1, 100));
  command->add_option("--frames", o->one.frames, "frames that are measured")->check(wholeNumberFrom(1, 1000));
  command->add_option("--pictures", o->one.pictures,
                      "write the next frame's pictures to PREFIX_WALL_EYE.ppm");
  command->callback([o, &code] { code = benchWalls(*o); });
}

}  // namespace stadion
