/// stadion-walls-floor: the processor time that bare OpenGL needs for the views of a room. Prints the same
/// fields as osg_walls, as one JSON object. Run it with LP_NUM_THREADS=0, so that Mesa rasterises in the
/// drawing thread.

#include "bench/walls/floor/floor_drawing.h"
#include "bench/walls/floor/gl.h"
#include "bench/walls/floor/headless_context.h"
#include "bench/walls/picture_difference.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <ctime>

namespace stadion::bench {
namespace {

struct Setting {
  std::string scene = "a", kind = "STRICT", way = "uniform", pictures;
  std::size_t walls = 4, nodes = 0, moving = 0;
  double far = 0;
  std::uint32_t width = 800, height = 600;
  std::uint64_t warm = 3, frames = 12;
};

double processorMs() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Measured {
  std::vector<double> frame;  ///< of real time [ms]
  double processor = 0;       ///< of all measured frames [ms]
  std::vector<double> draws;  ///< by view, of all measured frames
  double triangles = 0;
};

void writePicture(const Setting& s, std::size_t view) {
  RgbPicture p{s.width, s.height, std::vector<std::uint8_t>(std::size_t{3} * s.width * s.height)};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, static_cast<GLsizei>(s.width), static_cast<GLsizei>(s.height), GL_RGB, GL_UNSIGNED_BYTE,
               p.rgb.data());
  const std::size_t row = std::size_t{3} * s.width;
  for (std::size_t top = 0, bottom = s.height - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(p.rgb.begin() + static_cast<std::ptrdiff_t>(top * row),
                     p.rgb.begin() + static_cast<std::ptrdiff_t>((top + 1) * row),
                     p.rgb.begin() + static_cast<std::ptrdiff_t>(bottom * row));
  const std::string file = s.pictures + "_" + roomWalls()[view / 2].name + (view % 2 ? "_R.ppm" : "_L.ppm");
  if (!writePpm(file, p)) std::fprintf(stderr, "stadion-walls-floor: cannot write %s\n", file.c_str());
}

/// Draws one frame; visible nodes are found before the clocks are read.
void playFrame(const Setting& s, FloorDrawing& drawing, std::uint64_t frame, Measured& m) {
  const bool counts = frame >= s.warm && frame < s.warm + s.frames;
  std::vector<FloorView> views;
  for (std::size_t wall = 0; wall < s.walls; ++wall)
    for (const int eye : {0, 1})
      views.push_back(drawing.view(wall, eye, static_cast<double>(frame) / kWallSceneRate));
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  const double processor = processorMs();
  for (std::size_t i = 0; i < views.size(); ++i) {
    drawing.draw(views[i]);
    glFinish();
    if (!s.pictures.empty() && frame == s.warm + s.frames) writePicture(s, i);
  }
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  if (counts) {
    m.frame.push_back(took.count());
    m.processor += processorMs() - processor;
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (counts) {
      m.draws[i] += static_cast<double>(views[i].visible.size());
      m.triangles += static_cast<double>(views[i].triangles);
    }
    drawing.free(views[i]);
  }
}

double percentile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values.at(std::max<std::size_t>(1, rank) - 1);
}

nlohmann::json rowOf(const Setting& s, const Measured& m) {
  const auto frames = static_cast<double>(s.frames), views = static_cast<double>(m.draws.size());
  double sum = 0, draws = 0;
  for (const double ms : m.frame) sum += ms;
  nlohmann::json perView = nlohmann::json::array();
  for (const double n : m.draws) {
    perView.push_back(std::llround(n / frames));
    draws += n / frames;
  }
  const char* threads = std::getenv("LP_NUM_THREADS");
  const double median = percentile(m.frame, 0.5);
  return nlohmann::json{{"engine", "floor"},
                        {"class", s.kind},
                        {"backend", "egl"},
                        {"renderer", reinterpret_cast<const char*>(glGetString(GL_RENDERER))},
                        {"scene", s.scene},
                        {"flat", 1},
                        {"walls", s.walls},
                        {"eyes", 2},
                        {"width", s.width},
                        {"height", s.height},
                        {"mode", s.way},
                        {"wall_workers", "none"},
                        {"lp_threads", threads ? threads : "default"},
                        {"frames", s.frames},
                        {"fps", 1e3 * frames / sum},
                        {"frame_ms_median", median},
                        {"frame_ms_p95", percentile(m.frame, 0.95)},
                        {"frame_ms_p99", percentile(m.frame, 0.99)},
                        {"frame_ms_max", percentile(m.frame, 1)},
                        {"latency_ms_median", median},
                        {"latency_ms_p95", percentile(m.frame, 0.95)},
                        {"app_ms", 0},
                        {"cull_ms_per_view", 0},
                        {"draw_ms_per_view", median / views},
                        {"cull_ms_sum", 0},
                        {"draw_ms_sum", median},
                        {"cpu_cores", m.processor / sum},
                        {"cpu_ms_per_frame", m.processor / frames},
                        {"cpu_ms_per_view", m.processor / frames / views},
                        {"incomplete", 0},
                        {"draws_per_frame", draws},
                        {"tris_per_frame", m.triangles / frames},
                        {"draws_per_view", perView}};
}

int run(const Setting& s) {
  const auto way = floorWay(s.way);
  if (!way) {
    std::fprintf(stderr, "stadion-walls-floor: there is no way \"%s\"\n", s.way.c_str());
    return 2;
  }
  openHeadlessContext(s.width, s.height);
  glViewport(0, 0, static_cast<GLsizei>(s.width), static_cast<GLsizei>(s.height));
  FloorDrawing drawing({s.scene.front(), s.nodes, s.moving, s.far}, *way);
  Measured measured;
  measured.draws.resize(2 * s.walls);
  const std::uint64_t end = s.warm + s.frames + (s.pictures.empty() ? 0 : 1);
  for (std::uint64_t frame = 0; frame < end; ++frame) playFrame(s, drawing, frame, measured);
  std::printf("%s\n", rowOf(s, measured).dump().c_str());
  return 0;
}

}  // namespace
}  // namespace stadion::bench

int main(int argc, char** argv) {
  stadion::bench::Setting s;
  CLI::App app("What bare OpenGL needs for the views of a room");
  app.add_option("--scene", s.scene, "a, b or c")->check(CLI::IsMember({"a", "b", "c"}));
  app.add_option("--class", s.kind, "what the row says");
  app.add_option("--way", s.way, "clear, uniform, discard, instanced or merged");
  app.add_option("--walls", s.walls, "1 to 6")->check(CLI::Range(1, 6));
  app.add_option("--width", s.width, "[pixels]")->check(CLI::Range(1, 16384));
  app.add_option("--height", s.height, "[pixels]")->check(CLI::Range(1, 16384));
  app.add_option("--warm", s.warm, "frames before those that are measured");
  app.add_option("--frames", s.frames, "frames that are measured")->check(CLI::Range(1, 1000));
  app.add_option("--nodes", s.nodes, "so many, instead of the scene's");
  app.add_option("--moving", s.moving, "so many of them move");
  app.add_option("--far", s.far, "how far is seen, instead of the scene's [m]");
  app.add_option("--pictures", s.pictures, "write the next frame's pictures to PREFIX_WALL_EYE.ppm");
  CLI11_PARSE(app, argc, argv);
  return stadion::bench::run(s);
}
