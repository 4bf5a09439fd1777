#include "assets/generator/craft/models.h"

#include <cmath>
#include <cstdio>

namespace stadion::assets {
namespace {

template <class... Values>
void add(std::string& text, const char* format, Values... values) {
  char line[160];
  std::snprintf(line, sizeof line, format, values...);
  text += line;
}

// Six decimals, and no "-0.000000".
double tidy(double v) {
  return std::fabs(v) < 5e-7 ? 0.0 : v;
}

}  // namespace

ObjFile toObj(const Model& model, const std::string& fileName) {
  ObjFile out;
  out.obj = "# Made by stadion-assets. Metres, +Y up, -Z forward.\nmtllib " + fileName + ".mtl\no " +
            model.name + "\n";
  for (const Point& p : model.points) add(out.obj, "v %.6f %.6f %.6f\n", tidy(p.x), tidy(p.z), tidy(-p.y));
  for (std::uint32_t m = 0; m < model.paints.size(); ++m) {
    out.obj += "usemtl " + model.paints[m].name + "\n";
    for (const Triangle& t : model.triangles)
      if (t.paint == m) add(out.obj, "f %u %u %u\n", t.corner[0] + 1, t.corner[1] + 1, t.corner[2] + 1);
  }
  for (const Paint& paint : model.paints) {
    out.mtl += "newmtl " + paint.name + "\n";
    add(out.mtl, "Kd %.4f %.4f %.4f\n", paint.colour[0] / 255.0, paint.colour[1] / 255.0,
        paint.colour[2] / 255.0);
    add(out.mtl, "Ks 0 0 0\nNs %d\nd 1\n", paint.gloss);
  }
  return out;
}

}  // namespace stadion::assets
