#include "pipeline/cpu_draw/fragment_shading.h"

#include <algorithm>

namespace stadion {

void Fragments::begin(unsigned triangles, std::size_t most) {
  if (memory_.size() < 3 * most) memory_.resize(3 * most);
  times_.assign(triangles + std::size_t{1}, 0);
  list_ = {memory_.data(), memory_.data() + most, memory_.data() + 2 * most, 0, times_.data()};
}

void FragmentShading::findVisible(const BandTriangles& triangles, const FragmentList& fragments) {
  visible_.clear();
  for (unsigned number = 0; number < triangles.size(); ++number)
    if (fragments.times[number] != 0) visible_.push_back(number);
}

/// By counting. The sky comes last.
void FragmentShading::sort(const PictureShading& picture, const BandTriangles& triangles,
                           const FragmentList& fragments) {
  const PictureSetup& setup = *picture.setup;
  const std::size_t sky = setup.materials().size();
  const auto materialOf = [&](unsigned number) { return setup.stretchOf(triangles.record(number)).material; };
  ends_.assign(sky + 2, 0);
  for (const unsigned number : visible_) ends_[materialOf(number) + 1] += fragments.times[number];
  for (std::size_t m = 1; m <= sky; ++m) ends_[m] += ends_[m - 1];
  next_.resize(triangles.size() + std::size_t{1});
  next_[triangles.size()] = ends_[sky];
  for (const unsigned number : visible_) {
    unsigned& end = ends_[materialOf(number)];
    next_[number] = end;
    end += fragments.times[number];
  }
  ends_[sky] = fragments.size;
  const std::size_t size = fragments.size + std::size_t{kKernelPadding};
  for (auto* values : {&pixel_, &surface_, &place_}) {
    if (values->size() < size) values->resize(size);
    std::fill_n(values->begin() + fragments.size, kKernelPadding, 0);
  }
  for (unsigned i = 0; i < fragments.size; ++i) {
    const unsigned number = fragments.number[i], to = next_[number]++;
    pixel_[to] = fragments.pixel[i];
    place_[to] = fragments.place[i];
    surface_[to] = number < triangles.size() ? triangles.block(number) : 0;
  }
}

void FragmentShading::shade(const PictureShading& picture, BandTriangles& triangles,
                            const SurfaceBlocks& blocks, const FragmentList& fragments, bool runs,
                            float* colours) {
  findVisible(triangles, fragments);
  triangles.makeBlocks(blocks, visible_);
  sort(picture, triangles, fragments);
  FragmentJob job{};
  job.surfaces = triangles.blocks();
  job.extras = triangles.extras();
  job.runs = runs;
  job.colours = colours;
  job.scene = picture.scene;
  job.shadow = picture.shadow;
  job.view = picture.view;
  job.nearestLevel = picture.rung.nearestLevel;
  const DrawKernels& k = *picture.kernels;
  const bool plain = picture.rung.look == Look::Plain;
  const auto materials = picture.setup->materials();
  const std::size_t sky = materials.size();
  for (std::size_t m = 0, first = 0; m <= sky; first = ends_[m++]) {
    job.pixel = pixel_.data() + first;
    job.surface = surface_.data() + first;
    job.place = place_.data() + first;
    job.count = ends_[m] - static_cast<unsigned>(first);
    if (job.count == 0 || (m == sky && picture.surfacesOnly)) continue;
    job.material = m < sky ? materials[m] : nullptr;
    if (m == sky && plain)
      k.skyPlain(job);
    else if (m == sky)
      k.sky(job);
    else if (plain)
      k.shadePlain(job);
    else
      k.shade(job);
  }
}

}  // namespace stadion
