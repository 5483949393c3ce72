#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <half.h>

#include <exception>

#include "backend/image/write_image.hpp"
#include "base/assert.hpp"
#include "base/text.hpp"

namespace scenec::backend {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;

// OpenEXR comes back to fill in its chunk table, so writes may land before the end.
class StringStream final : public imf::OStream {
 public:
  explicit StringStream(std::string& bytes) : OStream("picture"), bytes_(bytes) {}

  void write(const char* data, int size) override {
    const auto count = static_cast<std::size_t>(size);
    if (bytes_.size() < at_ + count) bytes_.resize(at_ + count);
    bytes_.replace(at_, count, data, count);
    at_ += count;
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t position) override { at_ = position; }

 private:
  std::string& bytes_;
  std::size_t at_ = 0;
};

struct InsertAttribute {
  imf::Header& header;
  const std::string& name;

  void operator()(const std::string& value) const {
    header.insert(name, imf::StringAttribute(value));
  }
  void operator()(std::int32_t value) const { header.insert(name, imf::IntAttribute(value)); }
  void operator()(float value) const { header.insert(name, imf::FloatAttribute(value)); }
  void operator()(const Chromaticities& value) const {
    using V2f = IMATH_NAMESPACE::V2f;
    const auto& xy = value.xy;
    header.insert(name,
                  imf::ChromaticitiesAttribute(imf::Chromaticities(
                      V2f(xy[0], xy[1]), V2f(xy[2], xy[3]), V2f(xy[4], xy[5]), V2f(xy[6], xy[7]))));
  }
};

std::vector<half> halves_of(const ExrChannel& channel, std::size_t count) {
  std::vector<half> result(count);
  for (std::size_t i = 0; i < count; ++i) result[i] = half(channel.samples[i * channel.stride]);
  return result;
}

void write(StringStream& stream, const imf::Header& header, std::span<const ExrChannel> channels,
           std::size_t width, std::size_t height) {
  imf::FrameBuffer buffer;
  std::vector<std::vector<half>> halves;
  halves.reserve(channels.size());
  for (const ExrChannel& channel : channels) {
    if (channel.depth == ExrDepth::half) {
      halves.push_back(halves_of(channel, width * height));
      buffer.insert(channel.name,
                    imf::Slice(imf::HALF, reinterpret_cast<char*>(halves.back().data()),
                               sizeof(half), sizeof(half) * width));
    } else {
      // OpenEXR only reads from it.
      auto* data = reinterpret_cast<char*>(const_cast<float*>(channel.samples.data()));
      const std::size_t step = sizeof(float) * channel.stride;
      buffer.insert(channel.name, imf::Slice(imf::FLOAT, data, step, step * width));
    }
  }
  imf::OutputFile file(stream, header, 0);
  file.setFrameBuffer(buffer);
  file.writePixels(static_cast<int>(height));
}

}  // namespace

void round_to_half(std::vector<float>& values) {
  for (float& value : values) value = half(value);
}

Result<std::string, AssetProblem> encode_exr(std::uint32_t width, std::uint32_t height,
                                             std::span<const ExrChannel> channels,
                                             std::span<const ExrAttribute> attributes) {
  SCENEC_ASSERT(width > 0 && height > 0 && width <= 0x7FFF'FFFF && height <= 0x7FFF'FFFF);
  SCENEC_ASSERT(!channels.empty());
  const std::size_t count = std::size_t{width} * height;
  for (const ExrChannel& channel : channels) {
    SCENEC_ASSERT(!channel.name.empty() && channel.stride > 0);
    SCENEC_ASSERT(channel.samples.size() > (count - 1) * channel.stride);
  }
  try {
    imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = imf::ZIP_COMPRESSION;
    for (const ExrChannel& channel : channels) {
      const bool half = channel.depth == ExrDepth::half;
      header.channels().insert(channel.name, imf::Channel(half ? imf::HALF : imf::FLOAT));
    }
    for (const ExrAttribute& attribute : attributes) {
      std::visit(InsertAttribute{header, attribute.name}, attribute.value);
    }
    std::string bytes;
    StringStream stream(bytes);
    write(stream, header, channels, width, height);
    return bytes;
  } catch (const std::exception& error) {
    return Failure{
        AssetProblem{0, fmt::format("cannot encode the EXR: {}", printable(error.what(), 200))}};
  }
}

}  // namespace scenec::backend
