#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <utility>

#include "backend/image/decoders.hpp"
#include "backend/image/exr.hpp"
#include "backend/image/exr_header.hpp"
#include "base/text.hpp"

namespace scenec::backend {
namespace {

// Planes grow by this many rows at a time, so that a file without pixels costs no memory.
constexpr int rows_at_once = 256;

class MemoryStream final : public OPENEXR_IMF_NAMESPACE::IStream {
 public:
  explicit MemoryStream(std::string_view bytes) : IStream("picture"), bytes_(bytes) {}

  // OpenEXR's contract: throws when the bytes are not there, false when none is left behind them.
  bool read(char* target, int size) override {
    const auto wanted = static_cast<std::size_t>(size);
    if (size < 0 || at_ > bytes_.size() || wanted > bytes_.size() - at_) {
      throw std::runtime_error("file ends too early");
    }
    std::memcpy(target, bytes_.data() + at_, wanted);
    at_ += wanted;
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t position) override { at_ = position; }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

std::vector<ExrAttribute> attributes_of(const OPENEXR_IMF_NAMESPACE::Header& header) {
  namespace imf = OPENEXR_IMF_NAMESPACE;
  std::vector<ExrAttribute> result;
  for (auto i = header.begin(); i != header.end(); ++i) {
    const imf::Attribute& attribute = i.attribute();
    if (const auto* text = dynamic_cast<const imf::StringAttribute*>(&attribute)) {
      result.push_back({i.name(), text->value()});
    } else if (const auto* whole = dynamic_cast<const imf::IntAttribute*>(&attribute)) {
      result.push_back({i.name(), std::int32_t{whole->value()}});
    } else if (const auto* real = dynamic_cast<const imf::FloatAttribute*>(&attribute)) {
      result.push_back({i.name(), real->value()});
    } else if (const auto* xy = dynamic_cast<const imf::ChromaticitiesAttribute*>(&attribute)) {
      const imf::Chromaticities& c = xy->value();
      result.push_back({i.name(), Chromaticities{{c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x,
                                                  c.blue.y, c.white.x, c.white.y}}});
    }
  }
  return result;
}

void read_rows(OPENEXR_IMF_NAMESPACE::InputFile& file, ExrImage& image, int left, int top) {
  namespace imf = OPENEXR_IMF_NAMESPACE;
  const int height = static_cast<int>(image.height);
  const std::size_t row_bytes = image.width * sizeof(float);
  for (int row = 0; row < height; row += rows_at_once) {
    const int end = std::min(height, row + rows_at_once);
    imf::FrameBuffer buffer;
    for (ExrPlane& plane : image.planes) {
      plane.samples.resize(static_cast<std::size_t>(end) * image.width);
      buffer.insert(
          plane.name,
          imf::Slice::Make(imf::FLOAT, plane.samples.data(), IMATH_NAMESPACE::V2i(left, top),
                           std::int64_t{image.width}, std::int64_t{end}, sizeof(float), row_bytes));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(top + row, top + end - 1);
  }
}

ExrImage read_checked(std::string_view bytes) {
  namespace imf = OPENEXR_IMF_NAMESPACE;
  MemoryStream stream(bytes);
  imf::InputFile file(stream, 0);
  const IMATH_NAMESPACE::Box2i window = file.header().dataWindow();
  ExrImage image;
  image.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
  image.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
  const imf::ChannelList& channels = file.header().channels();
  for (auto i = channels.begin(); i != channels.end(); ++i) {
    const bool half = i.channel().type == imf::HALF;
    image.planes.push_back({i.name(), half ? ExrDepth::half : ExrDepth::float32, {}});
  }
  image.attributes = attributes_of(file.header());
  read_rows(file, image, window.min.x, window.min.y);
  return image;
}

const ExrPlane* find_plane(const ExrImage& image, std::string_view name) {
  const auto found = std::ranges::find(image.planes, name, &ExrPlane::name);
  return found == image.planes.end() ? nullptr : &*found;
}

std::string names_of(const ExrImage& image) {
  std::vector<std::string_view> names;
  for (const ExrPlane& plane : image.planes) names.push_back(plane.name);
  return quoted_list(names, 12);
}

// The unnamed layer: R G B or Y, with A if there.
std::vector<const ExrPlane*> colour_planes(const ExrImage& image) {
  std::vector<const ExrPlane*> planes = {find_plane(image, "R"), find_plane(image, "G"),
                                         find_plane(image, "B")};
  if (std::ranges::find(planes, nullptr) != planes.end()) planes = {find_plane(image, "Y")};
  if (planes.front() == nullptr) return {};
  if (const ExrPlane* alpha = find_plane(image, "A")) planes.push_back(alpha);
  return planes;
}

}  // namespace

Result<ExrImage, AssetProblem> read_exr(std::string_view bytes, const ImageLimits& limits) {
  if (!bytes.starts_with("\x76\x2F\x31\x01")) return Failure{AssetProblem{0, "not an EXR file"}};
  if (auto problem = find_exr_header_problem(bytes, limits)) return Failure{std::move(*problem)};
  try {
    return read_checked(bytes);
  } catch (const std::exception& error) {
    return Failure{AssetProblem{0, fmt::format("damaged EXR: {}", printable(error.what(), 200))}};
  }
}

DecodeResult decode_exr(std::string_view bytes, const ImageLimits& limits) {
  const Result<ExrImage, AssetProblem> read = read_exr(bytes, limits);
  if (!read) return Failure{read.error()};
  const ExrImage& image = read.value();
  const std::vector<const ExrPlane*> planes = colour_planes(image);
  if (planes.empty()) {
    return Failure{AssetProblem{
        0, fmt::format("EXR has no channels `R`, `G`, `B` or `Y`; it has {}", names_of(image))}};
  }
  DecodedImage result;
  result.width = image.width;
  result.height = image.height;
  result.channels = static_cast<std::uint32_t>(planes.size());
  result.encoding = SampleEncoding::linear;
  std::vector<float> samples(planes[0]->samples.size() * planes.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const float value = planes[i % planes.size()]->samples[i / planes.size()];
    samples[i] = std::isfinite(value) ? value : 0.0f;
    if (!std::isfinite(value)) ++result.replaced_samples;
  }
  result.samples = std::move(samples);
  return result;
}

}  // namespace scenec::backend
