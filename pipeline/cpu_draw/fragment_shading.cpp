#include "pipeline/cpu_draw/band_colours.h"

namespace stadion {

void FragmentShading::shade(const PictureShading& picture, BandTriangles& triangles,
                            const SurfaceBlocks& blocks, const std::vector<unsigned>& pixels,
                            const std::vector<unsigned>& of, const Colours& out) {
  const auto materials = picture.setup->materials();
  const std::size_t count = pixels.size(), sky = materials.size();
  surface_.resize(count), material_.resize(count), order_.resize(count);
  ends_.assign(sky + 2, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const bool isSky = of[i] == kNoTriangle;
    surface_[i] = isSky ? 0 : triangles.block(of[i], blocks);
    material_[i] = isSky ? static_cast<unsigned>(sky) : triangles.stretch(of[i]).material;
    ++ends_[material_[i] + 1];
  }
  for (std::size_t m = 1; m < ends_.size(); ++m) ends_[m] += ends_[m - 1];
  for (std::size_t i = 0; i < count; ++i) order_[ends_[material_[i]]++] = static_cast<unsigned>(i);

  FragmentJob job{};
  job.surfaces = triangles.blocks(), job.pixel = pixels.data(), job.surface = surface_.data();
  job.red = out.red, job.green = out.green, job.blue = out.blue, job.alpha = out.alpha;
  job.scene = picture.scene, job.shadow = picture.shadow, job.view = picture.view;
  job.nearestLevel = picture.rung.nearestLevel;
  const DrawKernels& k = *picture.kernels;
  const bool plain = picture.rung.look == Look::Plain;
  for (std::size_t m = 0, first = 0; m <= sky; first = ends_[m++]) {
    job.order = order_.data() + first, job.count = ends_[m] - static_cast<unsigned>(first);
    if (job.count == 0) continue;
    job.material = m < sky ? materials[m] : nullptr;
    if (m == sky)
      plain ? k.skyPlain(job) : k.sky(job);
    else
      plain ? k.shadePlain(job) : k.shade(job);
  }
}

}  // namespace stadion
