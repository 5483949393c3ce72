#include "runtime/ready_scene.hpp"

#include "base/assert.hpp"
#include "runtime/settings.hpp"

namespace scenec::runtime {

ExitCode make_ready(ReadyScene& ready, Session& session, const Options& options,
                    const Environment& environment, ThreadPool& pool) {
  ready.scene = session.load_and_compile(pool);
  if (!ready.scene) return session.finish(environment);
  ready.settings = settings_of(options, *ready.scene, environment);
  if (!ready.settings) return ExitCode::usage;
  ready.prepared = backend::prepare(*ready.scene, session.files(), pool, session.sink(), nullptr,
                                    options.limits);
  const ExitCode code = session.finish(environment);
  SCENEC_ASSERT(ready.prepared || code != ExitCode::ok);
  return code;
}

}  // namespace scenec::runtime
