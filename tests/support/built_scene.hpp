// A scene of a file all the way to what can be rendered, and the small settings tests render it
// with.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "backend/backend.hpp"
#include "base/file_system.hpp"
#include "base/source_map.hpp"
#include "frontend/compile.hpp"

namespace scenec::test {

struct BuiltScene {
  std::unique_ptr<ir::Scene> scene;
  backend::PreparedPtr prepared;
  backend::RenderScenePtr render_scene;
  std::size_t findings = 0;  // what was said, lints included
};

// Nothing: it does not compile, or is a library without a camera.
[[nodiscard]] inline std::optional<BuiltScene> build_file(
    const std::filesystem::path& path, ThreadPool& pool,
    const backend::BuildOptions& options = {}) {
  RealFileSystem disk;
  SourceMap sources;
  DiagnosticSink sink;
  const auto file = frontend::load(path.string(), {}, disk, sources, sink);
  if (!file) return std::nullopt;
  auto scene = frontend::compile(*file, {}, disk, sources, sink);
  if (!scene || !scene->render.camera.valid()) return std::nullopt;
  BuiltScene built;
  built.scene = std::make_unique<ir::Scene>(std::move(*scene));
  built.prepared = backend::prepare(*built.scene, disk, pool, sink);
  if (!built.prepared) return std::nullopt;
  built.findings = sink.sorted().size();
  built.render_scene = backend::build(*built.prepared, pool, options);
  return built;
}

[[nodiscard]] inline ir::RenderSettings small_settings(const ir::Scene& scene, int samples = 4) {
  ir::RenderSettings settings = scene.render;
  settings.size = {24, 18};
  settings.region.reset();
  settings.stop = {};
  settings.samples = samples;
  return settings;
}

}  // namespace scenec::test
