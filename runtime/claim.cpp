#include "runtime/claim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "backend/image/exr.hpp"
#include "base/shell_words.hpp"
#include "base/text.hpp"
#include "runtime/cli.hpp"

namespace scenec::runtime {

namespace {

using Fields = std::map<std::string, std::string, std::less<>>;

Fields fields_of(const backend::ExrImage& image) {
  Fields fields;
  for (const backend::ExrAttribute& attribute : image.attributes) {
    if (const auto* text = std::get_if<std::string>(&attribute.value))
      fields[attribute.name] = *text;
  }
  return fields;
}

// Channels of a layer, interleaved; empty when one is missing.
std::vector<float> channels_of(const backend::ExrImage& image,
                               const std::array<std::string_view, 3>& names) {
  std::vector<float> values(3 * std::size_t{image.width} * image.height);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto plane = std::ranges::find(image.planes, names[c], &backend::ExrPlane::name);
    if (plane == image.planes.end()) return {};
    for (std::size_t i = 0; i < plane->samples.size(); ++i) values[3 * i + c] = plane->samples[i];
  }
  return values;
}

bool is_half(const backend::ExrImage& image) {
  const auto plane = std::ranges::find(image.planes, "R", &backend::ExrPlane::name);
  return plane != image.planes.end() && plane->depth == backend::ExrDepth::half;
}

// The options behind `scenec render`; they need a scene to be read, which is not theirs.
std::optional<Options> options_of(std::string_view command) {
  auto words = shell_words(command);
  if (!words || words->size() < 2 || (*words)[0] != "scenec" || (*words)[1] != "render")
    return std::nullopt;
  words->erase(words->begin());
  words->insert(words->end(), {"--", "scene.sdl"});
  CommandLine line = parse_command_line(*words);
  auto* const options = std::get_if<Options>(&line);
  if (options == nullptr) return std::nullopt;
  options->operands.clear();
  return options->frames ? options_in_frame(*options, options->frames->first) : *options;
}

}  // namespace

Result<Claim, std::string> read_claim(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG") || bytes.starts_with("BM"))
    return Failure{
        std::string("only an EXR file holds the numbers that can be held to a claim; "
                    "render to `.exr`")};
  const auto read = backend::read_exr(bytes);
  if (!read.ok()) return Failure{read.error().message};
  const backend::ExrImage& image = read.value();
  const Fields fields = fields_of(image);
  Claim claim;
  std::string missing;
  const auto field = [&](std::string_view name) {
    const auto found = fields.find(name);
    if (found == fields.end() && missing.empty()) missing = name;
    return found == fields.end() ? std::string() : found->second;
  };
  claim.software = field("software");
  claim.scene_hash = field("scenec/scene_hash");
  claim.effects = field("scenec/effects");
  const std::string command = field("scenec/command");
  const auto seed = parse_int(field("scenec/seed"));
  const auto samples = parse_int(field("scenec/samples"));
  if (!missing.empty())
    return Failure{fmt::format("claims nothing: it has no field `{}`", missing)};
  if (const auto scene = fields.find("scenec/scene"); scene != fields.end())
    claim.scene = scene->second;
  auto options = options_of(command);
  if (!options) return Failure{fmt::format("its command `{}` is none", printable(command))};
  if (options->adaptive)
    return Failure{std::string("it was sampled adaptively: its pixels have unequal samples")};
  if (!seed || *seed < 0 || !samples || *samples < 1)
    return Failure{std::string("its `seed` or `samples` is no number of any")};
  claim.options = std::move(*options);
  claim.seed = *seed;
  auto& picture = claim.picture.picture;
  claim.picture.is_half = is_half(image);
  picture.width = image.width;
  picture.height = image.height;
  picture.samples = static_cast<double>(*samples);
  picture.rgb = channels_of(image, {"R", "G", "B"});
  picture.variance = channels_of(image, {"variance.R", "variance.G", "variance.B"});
  if (claim.picture.is_half) picture.rounding = 0x1p-11;
  if (picture.rgb.empty()) return Failure{std::string("it has no channels `R`, `G` and `B`")};
  return claim;
}

}  // namespace scenec::runtime
