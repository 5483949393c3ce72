#include "runtime/stats_sources.hpp"

namespace scenec::runtime {

void finish_compiling(Session& session, std::uint64_t before, PhaseClock& clock, RunStats& stats) {
  clock.finish("compile",
               {{"read", session.files().seconds()},
                {"parse", session.clocks().parsing.seconds()},
                {"check", session.clocks().checking.seconds()}},
               "evaluate");
  if (before == 0) return;
  const std::uint64_t texts = session.sources().text_bytes();
  const std::uint64_t held = allocated_bytes();
  stats.add_memory("texts", texts);
  stats.add_memory("syntax tree", session.tree_bytes());
  // What the compiler leaves behind: the scene, its places in the text, diagnostics.
  stats.add_memory("scene", held > before + texts ? held - before - texts : 0);
}

void add_memory(const backend::MemoryUse& use, std::uint64_t film, std::uint64_t checkpoint,
                RunStats& stats) {
  stats.add_memory("meshes", use.meshes);
  stats.add_memory("images", use.images);
  stats.add_memory("accelerators", use.accelerators);
  stats.add_memory("materials, lights", use.shading);
  stats.add_memory("film", film);
  stats.add_memory("checkpoint", checkpoint);
}

void add_picture(const backend::Picture& picture, RunStats& stats) {
  stats.rays = picture.rays;
  for (std::size_t i = 0; i < ir::effect_count; ++i) {
    if (picture.effect_runs[i] == 0) continue;
    stats.effect_runs.emplace_back(ir::name_of(static_cast<ir::Effect>(i)), picture.effect_runs[i]);
  }
  stats.samples = picture.samples;
  stats.dropped_samples = picture.dropped_samples;
  stats.saturated_samples = picture.saturated_samples;
}

}  // namespace scenec::runtime
