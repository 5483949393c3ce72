// PGM and PPM, ascii and binary. Samples are scaled to the full range of 8 or 16 bits.
#include <fmt/format.h>

#include <optional>
#include <utility>

#include "backend/image/decoders.hpp"

namespace scenec::backend {
namespace {

constexpr bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

class PnmReader {
 public:
  PnmReader(std::string_view bytes, const ImageLimits& limits) : bytes_(bytes), limits_(limits) {}

  DecodeResult run() {
    const char kind = bytes_[1];
    at_ = 2;
    if (kind == '1' || kind == '4') return Failure{AssetProblem{0, "bilevel PBM is not supported"}};
    ascii_ = kind == '2' || kind == '3';
    image_.channels = kind == '2' || kind == '5' ? 1 : 3;
    if (!header()) return Failure{std::move(problem_)};
    if (!(largest_ > 255 ? pixels<std::uint16_t>() : pixels<std::uint8_t>())) {
      return Failure{std::move(problem_)};
    }
    return std::move(image_);
  }

 private:
  bool fail(std::string message) {
    problem_ = {0, std::move(message)};
    return false;
  }

  // Blanks and `#` comments, then digits.
  bool number(std::uint32_t& value) {
    while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else {
        ++at_;
      }
    }
    const std::size_t begin = at_;
    value = 0;
    while (at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9' && value < 100'000'000) {
      value = value * 10 + static_cast<std::uint32_t>(bytes_[at_++] - '0');
    }
    if (at_ == begin) return fail(fmt::format("number missing at byte {}", at_));
    return true;
  }

  bool header() {
    if (!number(image_.width) || !number(image_.height) || !number(largest_)) return false;
    if (largest_ == 0 || largest_ > 65'535) {
      return fail(fmt::format("largest value is {}; needs 1 to 65535", largest_));
    }
    const std::uint64_t sample_bytes = largest_ > 255 ? 2 : 1;
    const std::uint64_t pixel_bytes = image_.channels * sample_bytes;
    if (auto problem = find_size_problem(image_.width, image_.height, pixel_bytes, limits_)) {
      problem_ = std::move(*problem);
      return false;
    }
    if (at_ == bytes_.size() || !is_space(bytes_[at_])) return fail("header ends too early");
    ++at_;
    // An ascii sample takes a digit and, but for the last, a blank.
    const std::uint64_t samples = std::uint64_t{image_.width} * image_.height * image_.channels;
    const std::uint64_t needed = ascii_ ? 2 * samples - 1 : samples * sample_bytes;
    if (needed > bytes_.size() - at_) {
      return fail(fmt::format("{} x {} pixels need {} bytes, {} follow", image_.width,
                              image_.height, needed, bytes_.size() - at_));
    }
    return true;
  }

  template <class Sample>
  bool pixels() {
    constexpr std::uint32_t full = (std::uint32_t{1} << (8 * sizeof(Sample))) - 1;
    std::vector<Sample> samples(std::size_t{image_.width} * image_.height * image_.channels);
    for (Sample& sample : samples) {
      std::uint32_t value = 0;
      if (ascii_) {
        if (!number(value)) return false;
      } else {
        for (std::size_t i = 0; i < sizeof(Sample); ++i) {
          value = value << 8 | static_cast<unsigned char>(bytes_[at_++]);
        }
      }
      if (value > largest_) {
        return fail(
            fmt::format("value {} at byte {} is above the declared {}", value, at_, largest_));
      }
      sample = static_cast<Sample>((std::uint64_t{value} * full + largest_ / 2) / largest_);
    }
    image_.samples = std::move(samples);
    return true;
  }

  std::string_view bytes_;
  const ImageLimits& limits_;
  std::size_t at_ = 0;
  bool ascii_ = false;
  std::uint32_t largest_ = 0;
  DecodedImage image_;
  AssetProblem problem_;
};

}  // namespace

DecodeResult decode_pnm(std::string_view bytes, const ImageLimits& limits) {
  return PnmReader(bytes, limits).run();
}

}  // namespace scenec::backend
