// A scene with all that is needed to build it: what verbs begin with that render it in many ways.
#pragma once

#include <optional>

#include "backend/backend.hpp"
#include "base/parallel.hpp"
#include "ir/scene.hpp"
#include "runtime/environment.hpp"
#include "runtime/exit_codes.hpp"
#include "runtime/options.hpp"
#include "runtime/session.hpp"

namespace scenec::runtime {

// Stays where it is: `prepared` points to `scene`.
struct ReadyScene {
  std::optional<ir::Scene> scene;
  std::optional<ir::RenderSettings> settings;
  backend::PreparedPtr prepared;
};

// Compiles the session's scene, finds its settings and prepares it; what was found is printed.
// Anything but `ok`: it is not ready, and why has been told.
[[nodiscard]] ExitCode make_ready(ReadyScene& ready, Session& session, const Options& options,
                                  const Environment& environment, ThreadPool& pool);

}  // namespace scenec::runtime
