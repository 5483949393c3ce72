#include "backend/image/image.hpp"

#include <array>
#include <type_traits>

#include "backend/image/tone.hpp"

namespace scenec::backend {
namespace {

// linear value = table[sample], for colour and for alpha.
template <class Sample>
std::vector<float> table_of(SampleEncoding encoding) {
  constexpr std::size_t count = std::size_t{1} << (8 * sizeof(Sample));
  std::vector<float> table(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double value = static_cast<double>(i) / static_cast<double>(count - 1);
    table[i] = static_cast<float>(encoding == SampleEncoding::srgb ? linear_of_srgb(value) : value);
  }
  return table;
}

template <class Sample>
void convert(const DecodedImage& image, const std::vector<Sample>& samples, FloatImage& result) {
  if constexpr (std::is_same_v<Sample, float>) {
    result.samples = samples;
  } else {
    const std::vector<float> colour = table_of<Sample>(image.encoding);
    const std::vector<float> alpha = table_of<Sample>(SampleEncoding::linear);
    const bool has_alpha = image.channels % 2 == 0;
    result.samples.resize(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const bool is_alpha = has_alpha && i % image.channels == image.channels - 1;
      result.samples[i] = (is_alpha ? alpha : colour)[samples[i]];
    }
  }
}

}  // namespace

std::uint64_t memory_of(const DecodedImage& image) {
  return std::visit(
      [](const auto& samples) { return std::uint64_t{sizeof(samples[0])} * samples.size(); },
      image.samples);
}

FloatImage linear_image_of(const DecodedImage& image) {
  FloatImage result{image.width, image.height, image.channels, {}};
  std::visit([&](const auto& samples) { convert(image, samples, result); }, image.samples);
  return result;
}

}  // namespace scenec::backend
