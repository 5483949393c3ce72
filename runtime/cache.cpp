#include "runtime/cache.hpp"

#include <string>

namespace scenec::runtime {

namespace {

std::string user_directory(const Environment& environment) {
  const auto absolute = [&](std::string_view name) -> std::string {
    const auto value = environment.variable(name);
    // The XDG base directory specification has relative ones ignored.
    return value && value->starts_with('/') ? *value : std::string{};
  };
  if (const std::string caches = absolute("XDG_CACHE_HOME"); !caches.empty())
    return caches + "/scenec";
  const std::string home = absolute("HOME");
  return home.empty() ? home : home + "/.cache/scenec";
}

}  // namespace

std::optional<ContentCacheOptions> cache_options_of(const Options& options,
                                                    const Environment& environment) {
  std::string directory = options.cache;
  if (directory.empty()) directory = environment.variable("SCENEC_CACHE").value_or("");
  if (directory.empty()) directory = user_directory(environment);
  if (directory.empty() || directory == "off") return std::nullopt;
  ContentCacheOptions result{.directory = std::move(directory)};
  if (options.cache_budget) result.budget = *options.cache_budget;
  return result;
}

}  // namespace scenec::runtime
