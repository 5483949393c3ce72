#include "runtime/picture_metadata.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>
#include <string>

#include "base/text.hpp"
#include "runtime/cli.hpp"

namespace scenec::runtime {

namespace {

std::string host_name() {
  utsname name{};
  return ::uname(&name) == 0 ? name.nodename : "unknown";
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

}  // namespace

backend::EncodeOptions encode_options(const Options& options, const ir::Scene& scene,
                                      const ir::RenderSettings& settings,
                                      const ir::EffectSet& effects, const backend::Picture& picture,
                                      unsigned threads, const backend::ErrorEstimate& error) {
  backend::EncodeOptions encode{.half = options.half, .metadata = {}};
  encode.metadata = {{"software", std::string(version_text)},
                     {"scenec/scene_hash", scene.hash.hex()},
                     {"scenec/command", picture_command(options)},
                     {"scenec/effects", names_of(effects)},
                     {"scenec/seed", std::to_string(settings.seed)},
                     {"scenec/samples", std::to_string(picture.samples)}};
  if (error.known) {
    const auto add = [&](const char* name, double value) {
      encode.metadata.emplace_back(name, short_number_text(value));
    };
    add("scenec/error", error.relative.value);
    add("scenec/error_low", error.relative.low);
    add("scenec/error_high", error.relative.high);
  }
  if (options.stamp) {
    encode.metadata.emplace_back("scenec/date", utc_now());
    encode.metadata.emplace_back("scenec/host", host_name());
    encode.metadata.emplace_back("scenec/threads", std::to_string(threads));
    encode.metadata.emplace_back("scenec/scene", options.operands.at(0));
  }
  return encode;
}

std::string names_of(const ir::EffectSet& effects) {
  std::string text;
  for (std::size_t i = 0; i < ir::effect_count; ++i) {
    const auto effect = static_cast<ir::Effect>(i);
    if (effects.has(effect)) text += fmt::format("{}{}", text.empty() ? "" : " ", name_of(effect));
  }
  return text;
}

}  // namespace scenec::runtime
