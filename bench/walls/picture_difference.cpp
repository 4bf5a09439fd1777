#include "bench/walls/picture_difference.h"

#include "bench/walls/wall_room.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace stadion::bench {

Result<RgbPicture> readPpm(const std::string& file) {
  const auto wrong = [&](const char* what) { return Diagnostic{Severity::Error, {file, 0, 0}, what, {}}; };
  std::ifstream in(file, std::ios::binary);
  std::string kind;
  RgbPicture p;
  int most = 0;
  if (!(in >> kind >> p.width >> p.height >> most)) return wrong("is no picture");
  if (kind != "P6" || most != 255 || p.width == 0 || p.width > 16384 || p.height == 0 || p.height > 16384)
    return wrong("is no binary PPM file with 8 bits a channel");
  in.get();
  p.rgb.resize(std::size_t{3} * p.width * p.height);
  if (!in.read(reinterpret_cast<char*>(p.rgb.data()), static_cast<std::streamsize>(p.rgb.size())))
    return wrong("ends too early");
  return p;
}

bool writePpm(const std::string& file, const RgbPicture& p) {
  std::ofstream out(file, std::ios::binary);
  out << "P6\n" << p.width << ' ' << p.height << "\n255\n";
  out.write(reinterpret_cast<const char*>(p.rgb.data()), static_cast<std::streamsize>(p.rgb.size()));
  return static_cast<bool>(out.flush());
}

PictureDifference difference(const RgbPicture& a, const RgbPicture& b, int most) {
  PictureDifference d;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int worst = 0;
    for (std::size_t c = i; c < i + 3; ++c) worst = std::max(worst, std::abs(a.rgb[c] - b.rgb[c]));
    beyond += worst > most;
    d.worst = std::max(d.worst, worst);
  }
  d.beyond = static_cast<double>(beyond) / static_cast<double>(std::max<std::size_t>(1, a.rgb.size() / 3));
  return d;
}

Result<ViewsDifference> differenceOfViews(const std::string& prefix, const std::string& other,
                                          std::size_t walls) {
  ViewsDifference all;
  double beyond = 0, pixels = 0;
  for (std::size_t wall = 0; wall < walls; ++wall)
    for (const char* eye : {"_L", "_R"}) {
      const std::string view = roomWalls()[wall].name + std::string(eye), end = "_" + view + ".ppm";
      const auto a = readPpm(prefix + end), b = readPpm(other + end);
      if (!a) return a.error();
      if (!b) return b.error();
      const RgbPicture& p = a.value();
      if (p.width != b.value().width || p.height != b.value().height) {
        Diagnostic wrong;
        wrong.where.file = other + end;
        wrong.message = "is of another size than " + prefix + end;
        return wrong;
      }
      const PictureDifference d = difference(p, b.value());
      const double size = static_cast<double>(p.width) * p.height;
      beyond += d.beyond * size;
      pixels += size;
      if (d.beyond > all.worstView) {
        all.worstView = d.beyond;
        all.view = view;
      }
      all.worst = std::max(all.worst, d.worst);
    }
  all.frame = pixels > 0 ? beyond / pixels : 0;
  return all;
}

}  // namespace stadion::bench
