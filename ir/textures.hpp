// Textures: expressions over the surface's uv, stored as a table of nodes that refer to earlier
// ones.
#pragma once

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "ir/schema.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };
template <>
struct EnumNames<Wrap> {
  static constexpr std::array<std::string_view, 3> names{"repeat", "clamp", "mirror"};
};
enum class TextureFilter : std::uint8_t { nearest, bilinear, trilinear };
template <>
struct EnumNames<TextureFilter> {
  static constexpr std::array<std::string_view, 3> names{"nearest", "bilinear", "trilinear"};
};
// `.auto`: sRGB for 8-bit colour images used as colours, linear otherwise.
enum class Encoding : std::uint8_t { automatic, srgb, linear };
template <>
struct EnumNames<Encoding> {
  static constexpr std::array<std::string_view, 3> names{"auto", "srgb", "linear"};
};
enum class Channel : std::uint8_t { r, g, b, alpha };
template <>
struct EnumNames<Channel> {
  static constexpr std::array<std::string_view, 4> names{"r", "g", "b", "alpha"};
};

struct ImageTexture {
  AssetId file;
  Wrap wrap = Wrap::repeat;
  TextureFilter filter = TextureFilter::bilinear;
  Encoding encoding = Encoding::automatic;
  Vec2 scale{1, 1};  // uv is multiplied by it; v = 0 is the bottom row
};
struct CheckerTexture {
  ColorInput a;
  ColorInput b;
  double scale = 1;
};
struct FractalTexture {
  double scale = 1;
  std::int64_t octaves = 4;
  ColorInput a;
  ColorInput b{white, {}};
};
struct RampTexture {
  NumberInput t;
  std::vector<std::pair<double, Color>> stops;  // ascending
};
struct GridTexture {
  ColorInput line;
  ColorInput fill;
  double scale = 1;
  double width = 0.05;
};
struct ConstantTexture {
  Color color;
};
struct ProductTexture {
  ColorInput a;
  ColorInput b;
};
struct MixTexture {
  ColorInput a;
  ColorInput b;
  NumberInput t;
};
struct ChannelTexture {
  TextureId source;
  Channel channel = Channel::r;
};

using TextureKind =
    std::variant<ImageTexture, CheckerTexture, FractalTexture, RampTexture, GridTexture,
                 ConstantTexture, ProductTexture, MixTexture, ChannelTexture>;
// Every node gives a colour. A scalar node was written with numbers (or picks a channel): all its
// colours are greys, it may stand where a number is wanted, and its constants print as numbers.
struct TextureNode {
  TextureKind kind;
  bool scalar = false;
};

}  // namespace scenec::ir
