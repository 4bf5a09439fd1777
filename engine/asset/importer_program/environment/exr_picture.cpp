#include "engine/asset/importer_program/environment/radiance_picture.h"

#include "engine/asset/importer_program/source/source_scene.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace stadion::importer {
namespace {

/// The file in memory.
class ExrBytes final : public Imf::IStream {
public:
  explicit ExrBytes(std::span<const std::uint8_t> bytes) : Imf::IStream("picture"), bytes_(bytes) {}

  bool read(char to[], int size) override {
    const auto count = static_cast<std::uint64_t>(size);
    if (size < 0 || at_ > bytes_.size() || count > bytes_.size() - at_)
      throw std::runtime_error("it is cut short");
    std::memcpy(to, bytes_.data() + at_, count);
    at_ += count;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t place) override { at_ = place; }
  void clear() override {}

private:
  std::span<const std::uint8_t> bytes_;
  std::uint64_t at_ = 0;
};

/// Sets which channels fill the colours: red, green and blue, or one of brightness for all three.
void chooseChannels(const Imf::ChannelList& channels, const Imath::Box2i& window, RadianceMap& map,
                    Imf::FrameBuffer& buffer) {
  constexpr std::array kColours{"R", "G", "B"};
  const bool coloured = std::ranges::all_of(kColours, [&](const char* c) { return channels.findChannel(c); });
  if (!coloured && (!channels.findChannel("Y") || channels.findChannel("RY")))
    throw Refusal("has no channels R, G and B, and no Y alone");
  constexpr std::size_t kPixel = sizeof(Radiance);
  for (std::size_t c = 0; c < (coloured ? kColours.size() : 1); ++c)
    buffer.insert(coloured ? kColours[c] : "Y", Imf::Slice::Make(Imf::FLOAT, map.pixels.data()->data() + c,
                                                                 window, kPixel, kPixel * map.width));
}

RadianceMap readPixels(Imf::InputFile& file) {
  const Imath::Box2i window = file.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                     height = std::int64_t{window.max.y} - window.min.y + 1;
  checkRadianceSize(width, height);
  RadianceMap map{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  map.pixels.resize(std::size_t{map.width} * map.height);
  Imf::FrameBuffer buffer;
  chooseChannels(file.header().channels(), window, map, buffer);
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  if (!file.header().channels().findChannel("R"))
    for (Radiance& pixel : map.pixels) pixel[1] = pixel[2] = pixel[0];
  return map;
}

}  // namespace

RadianceMap readExr(std::span<const std::uint8_t> bytes) {
  RadianceMap map;
  try {
    Imf::setGlobalThreadCount(0);
    Imf::Header::setMaxImageSize(static_cast<int>(kMostRadianceColumns),
                                 static_cast<int>(kMostRadianceColumns));
    ExrBytes stream(bytes);
    Imf::InputFile file(stream, 0);
    map = readPixels(file);
  } catch (const Refusal&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    throw Refusal(std::string("is damaged: ") + fault.what());
  }
  checkRadiance(map);
  return map;
}

}  // namespace stadion::importer
