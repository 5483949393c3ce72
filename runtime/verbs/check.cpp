// `scenec check`: compiles a scene and reads its assets; silent when all is well.
#include "backend/backend.hpp"
#include "base/parallel.hpp"
#include "runtime/cache.hpp"
#include "runtime/output.hpp"
#include "runtime/session.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

ExitCode verbs::check(const Options& options, const Environment& environment) {
  Session session(options);
  if (!check_outputs(options, session.sink())) {
    static_cast<void>(session.finish(environment));
    return ExitCode::file_error;
  }
  ThreadPool pool(static_cast<unsigned>(options.threads.value_or(0)));
  if (const auto scene = session.load_and_compile(pool)) {
    std::optional<ContentCache> cache;
    if (auto kept = cache_options_of(options, environment)) cache.emplace(std::move(*kept));
    static_cast<void>(backend::prepare(*scene, session.files(), pool, session.sink(),
                                       cache ? &*cache : nullptr, options.limits));
  }
  return session.finish(environment);
}

}  // namespace scenec::runtime
