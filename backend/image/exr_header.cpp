#include "backend/image/exr_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "backend/image/decoders.hpp"
#include "base/text.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t longest_name = 255;
constexpr std::size_t most_channels = 1'024;
constexpr std::uint32_t flag_tiled = 0x200;
constexpr std::uint32_t flag_deep = 0x800;
constexpr std::uint32_t flag_multipart = 0x1000;
// Lines of a chunk by compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
constexpr std::array<std::uint64_t, 10> chunk_lines = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

struct TypeSize {
  std::string_view type;
  std::size_t size;
};
constexpr TypeSize fixed_sizes[] = {{"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
                                    {"compression", 1}, {"double", 8},   {"envmap", 1},
                                    {"float", 4},       {"int", 4},      {"keycode", 28},
                                    {"lineOrder", 1},   {"m33d", 72},    {"m33f", 36},
                                    {"m44d", 128},      {"m44f", 64},    {"rational", 8},
                                    {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
                                    {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
                                    {"v3f", 12},        {"v3i", 12},     {"deepImageState", 1}};

std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::int32_t i32_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::int32_t>(u32_at(bytes, at));
}

class HeaderCheck {
 public:
  HeaderCheck(std::string_view bytes, const ImageLimits& limits) : bytes_(bytes), limits_(limits) {}

  std::optional<AssetProblem> run() {
    if (bytes_.size() < 8) return too_short();
    flags_ = u32_at(bytes_, 4);
    if ((flags_ & 0xFF) != 2)
      return problem(fmt::format("EXR version {} is not known", flags_ & 0xFF));
    if ((flags_ & flag_multipart) != 0) return problem("EXR with several parts is not supported");
    if ((flags_ & flag_deep) != 0) return problem("deep EXR is not supported");
    at_ = 8;
    while (true) {
      std::string_view name;
      if (!text(name)) return too_short();
      if (name.empty()) break;
      if (auto found = attribute(name)) return found;
    }
    return check_sizes();
  }

 private:
  static AssetProblem problem(std::string message) { return {0, std::move(message)}; }
  static AssetProblem too_short() { return problem("EXR header is damaged or ends too early"); }

  // A zero-ended string at at_.
  bool text(std::string_view& found) {
    const std::size_t end =
        bytes_.substr(0, std::min(bytes_.size(), at_ + longest_name + 1)).find('\0', at_);
    if (end == std::string_view::npos) return false;
    found = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return true;
  }

  std::optional<AssetProblem> attribute(std::string_view name) {
    std::string_view type;
    if (!text(type) || bytes_.size() - at_ < 4) return too_short();
    const std::uint32_t size = u32_at(bytes_, at_);
    at_ += 4;
    if (size > bytes_.size() - at_) return too_short();
    const std::string_view value = bytes_.substr(at_, size);
    at_ += size;
    const auto* fixed = std::ranges::find(fixed_sizes, type, &TypeSize::type);
    const bool wrong_size = fixed != std::end(fixed_sizes) && fixed->size != size;
    if (wrong_size || (type == "preview" && !preview_fits(value))) {
      return problem(fmt::format("EXR attribute `{}` has the wrong size", printable(name)));
    }
    return known_attribute(name, type, value);
  }

  static bool preview_fits(std::string_view value) {
    return value.size() >= 8 &&
           std::uint64_t{u32_at(value, 0)} * u32_at(value, 4) == (value.size() - 8) / 4 &&
           value.size() % 4 == 0;
  }

  std::optional<AssetProblem> known_attribute(std::string_view name, std::string_view type,
                                              std::string_view value) {
    struct Known {
      std::string_view name;
      std::string_view type;
      std::string_view* value;
    };
    const Known known[] = {{"dataWindow", "box2i", &window_},
                           {"compression", "compression", &compression_},
                           {"channels", "chlist", &channels_},
                           {"tiles", "tiledesc", &tiles_}};
    for (const Known& row : known) {
      if (row.name != name) continue;
      if (row.type != type || row.value->data() != nullptr) {
        return problem(fmt::format("EXR attribute `{}` is damaged or there twice", name));
      }
      *row.value = value;
    }
    return std::nullopt;
  }

  // Walks the channel list: name, then type, a flag word and the two samplings.
  std::optional<AssetProblem> count_channels(std::uint64_t& count) const {
    HeaderCheck list(channels_, limits_);
    while (true) {
      std::string_view name;
      if (!list.text(name)) return too_short();
      if (name.empty()) break;
      if (channels_.size() - list.at_ < 16) return too_short();
      if (u32_at(channels_, list.at_) > 2) return too_short();
      if (i32_at(channels_, list.at_ + 8) != 1 || i32_at(channels_, list.at_ + 12) != 1) {
        return problem(
            fmt::format("EXR channel `{}` is subsampled, which is not supported", printable(name)));
      }
      list.at_ += 16;
      if (++count > most_channels) return problem("EXR with more than 1024 channels");
    }
    if (list.at_ != channels_.size()) return too_short();
    if (count == 0) return problem("EXR without channels");
    return std::nullopt;
  }

  std::optional<AssetProblem> check_sizes() {
    if (window_.empty() || compression_.empty() || channels_.empty()) return too_short();
    std::uint64_t channels = 0;
    if (auto found = count_channels(channels)) return found;
    const std::int64_t width = std::int64_t{i32_at(window_, 8)} - i32_at(window_, 0) + 1;
    const std::int64_t height = std::int64_t{i32_at(window_, 12)} - i32_at(window_, 4) + 1;
    if (width < 1 || height < 1) return problem("EXR data window is empty");
    const auto columns = static_cast<std::uint64_t>(width);
    const auto rows = static_cast<std::uint64_t>(height);
    if (auto found = find_size_problem(columns, rows, channels * sizeof(float), limits_))
      return found;
    const auto compression = static_cast<unsigned char>(compression_[0]);
    if (compression >= chunk_lines.size()) return problem("EXR compression is not known");
    std::uint64_t chunks = (rows + chunk_lines[compression] - 1) / chunk_lines[compression];
    std::uint64_t chunk_pixels = columns * std::min(rows, chunk_lines[compression]);
    if ((flags_ & flag_tiled) != 0) {
      if (tiles_.empty()) return problem("tiled EXR without a tile size");
      const std::uint64_t x = u32_at(tiles_, 0);
      const std::uint64_t y = u32_at(tiles_, 4);
      if (x == 0 || y == 0 || x > limits_.side || y > limits_.side) {
        return problem(fmt::format("EXR tile size {} x {} is out of range", x, y));
      }
      chunks = ((columns + x - 1) / x) * ((rows + y - 1) / y);
      chunk_pixels = x * y;
    }
    if (chunks > (bytes_.size() - at_) / 8) return problem("EXR chunk table ends too early");
    if (chunk_pixels > limits_.decoded_bytes / (channels * sizeof(float))) {
      return problem("EXR chunks are too large");
    }
    return std::nullopt;
  }

  std::string_view bytes_;
  const ImageLimits& limits_;
  std::size_t at_ = 0;
  std::uint32_t flags_ = 0;
  std::string_view window_;
  std::string_view compression_;
  std::string_view channels_;
  std::string_view tiles_;
};

}  // namespace

std::optional<AssetProblem> find_exr_header_problem(std::string_view bytes,
                                                    const ImageLimits& limits) {
  return HeaderCheck(bytes, limits).run();
}

}  // namespace scenec::backend
