// One try to make a scene from its files as they are now: compile, prepare, build. Keeps what a
// page asks about later: texts, findings, parameters, where things were written.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "backend/accel/tree_store.hpp"
#include "backend/backend.hpp"
#include "backend/scene_memory.hpp"
#include "base/content_cache.hpp"
#include "base/parallel.hpp"
#include "frontend/frontend_cache.hpp"
#include "ir/scene.hpp"
#include "runtime/options.hpp"
#include "runtime/session.hpp"
#include "runtime/stats.hpp"

namespace scenec::runtime {

// What a run of the compiler has read and found.
struct Reading {
  explicit Reading(const Options& given) : options(given), session(options) {}
  Options options;
  Session session;
};

// What can be rendered; the scene lies at one place for good, for the others refer to it.
struct World {
  std::shared_ptr<const Reading> reading;  // where the scene's places lie
  std::unique_ptr<ir::Scene> scene;
  backend::PreparedPtr prepared;
  backend::RenderScenePtr built;
};

// How much of an attempt was there already.
struct Reuse {
  backend::SceneMemory::Counts assets;    // meshes and pictures
  backend::TreeStore::Counts mesh_trees;  // one a mesh
  backend::TreeStore::Counts item_trees;  // over the world, and over each group
};

struct Attempt {
  std::shared_ptr<const Reading> reading;
  std::vector<Finding> findings;
  std::vector<FileRecord> files;
  std::shared_ptr<const World> world;  // null: there were errors
  std::unique_ptr<ir::Scene> places;   // where things stand now, if not in the world's scene
  std::optional<ir::RenderSettings> settings;  // the scene's with the command line's changes
  std::string problem;                         // why the command line does not fit the scene
  RunStats stats;
  Reuse reuse;
  bool mixed = false;  // files were changing while they were read
  [[nodiscard]] const SourceMap& sources() const { return reading->session.sources(); }
  // The scene as it is written now.
  [[nodiscard]] const ir::Scene& scene() const { return places ? *places : *world->scene; }
  [[nodiscard]] bool failed() const { return world == nullptr; }
};

struct Workbench {
  ThreadPool& pool;
  frontend::FrontendCache& texts;
  backend::SceneMemory& memory;
  backend::TreeStore& trees;
  ContentCache* cache = nullptr;
  std::function<bool()> files_change = {};  // whether somebody is writing to them now
};

// `shown` is what is on the screen: a scene that says the same is not built again.
[[nodiscard]] std::shared_ptr<const Attempt> make_attempt(const Options& options,
                                                          const Workbench& bench,
                                                          const Attempt* shown);

}  // namespace scenec::runtime
