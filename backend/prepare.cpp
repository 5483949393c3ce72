#include "backend/prepare.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "backend/backend.hpp"
#include "backend/prepare_assets.hpp"
#include "backend/scene_memory.hpp"
#include "backend/textures/pyramid.hpp"
#include "base/text.hpp"
#include "ir/print.hpp"

namespace scenec::backend {

void destroy(PreparedScene* scene) {
  delete scene;
}

namespace {

// Smaller trees are built as fast as they are found there.
constexpr std::size_t smallest_cached_tree = 4096;

// Meshes grouped by the file they come from: a file is read once and forgotten when its meshes are
// made. Inline meshes are groups of their own.
struct MeshGroup {
  ir::AssetId asset;
  std::vector<std::size_t> meshes;
};

std::vector<MeshGroup> group_meshes(const ir::Scene& scene) {
  std::vector<MeshGroup> groups;
  std::map<ir::AssetId, std::size_t> group_of;
  const auto& table = scene.table<ir::Mesh>();
  for (std::size_t i = 0; i < table.size(); ++i) {
    const ir::AssetId asset = table[Id<ir::Mesh>(static_cast<std::uint32_t>(i))].file;
    if (!asset.valid()) {
      groups.push_back({asset, {i}});
      continue;
    }
    const auto [place, added] = group_of.try_emplace(asset, groups.size());
    if (added) groups.push_back({asset, {}});
    groups[place->second].meshes.push_back(i);
  }
  return groups;
}

// The place of an inline mesh: the first item that shows it.
std::vector<Span> spans_of_meshes(const ir::Scene& scene) {
  std::vector<Span> spans(scene.table<ir::Mesh>().size());
  const auto look = [&](const std::vector<ir::Item>& items) {
    for (const ir::Item& item : items) {
      const auto* id = std::get_if<Id<ir::Mesh>>(&item.shape);
      if (id != nullptr && !spans[id->value()].valid() && item.origin.valid()) {
        spans[id->value()] = scene.origins[item.origin].span;
      }
    }
  };
  look(scene.items);
  for (const ir::Proto& proto : scene.protos) look(proto.items);
  return spans;
}

// What decides the positions and faces of a mesh. Its normals do not: a tree knows none of them.
Hash128 key_of(const ir::Mesh& source, const Hash128& file_key) {
  Hasher hasher;
  hasher.add(file_key);
  hasher.add(source.unit.value);
  hasher.add(source.part.has_value());
  hasher.add(std::string_view(source.part ? *source.part : std::string{}));
  return hasher.result();
}

void take_report(MeshReport& report, TaskReport& task) {
  if (report.error) task.diagnostics.push_back(std::move(*report.error));
  for (Diagnostic& warning : report.warnings) task.diagnostics.push_back(std::move(warning));
}

const ir::Mesh& mesh_at(const ir::Scene& scene, std::size_t index) {
  return scene.table<ir::Mesh>()[Id<ir::Mesh>(static_cast<std::uint32_t>(index))];
}

using MeshPtr = std::shared_ptr<const TriangleMesh>;

// The meshes of one file: what they have in common is made once.
class FileMeshes {
 public:
  // `once`: one mesh will be asked for, so the data may be used up for it.
  FileMeshes(MeshData data, const ir::Asset& asset, bool once, TaskReport& task)
      : data_(std::move(data)), asset_(asset), once_(once), task_(task), parts_(data_, asset.path) {
    MeshReport report;
    report_file(data_, asset.path, asset.span, report);
    take_report(report, task);
  }

  [[nodiscard]] std::size_t count() const { return made_.size(); }
  MeshPtr mesh_of(const ir::Mesh& source) {
    const auto same_mesh = std::ranges::find_if(made_, [&](const Made& made) {
      return same_whole(*made.source, source) && made.source->part == source.part;
    });
    if (same_mesh != made_.end()) return same_mesh->mesh;
    MeshPtr mesh = source.part ? part_of(source) : whole_of(source);
    made_.push_back({&source, mesh});
    return mesh;
  }

 private:
  struct Made {
    const ir::Mesh* source;
    MeshPtr mesh;
  };

  static bool same_whole(const ir::Mesh& a, const ir::Mesh& b) {
    return a.unit == b.unit && a.normals == b.normals;
  }

  MeshPtr part_of(const ir::Mesh& source) {
    const MeshPtr whole = whole_of(source);
    MeshReport report;
    auto mesh =
        std::make_shared<TriangleMesh>(parts_.take(*whole, *source.part, asset_.span, report));
    if (mesh->faces.empty() && !whole->faces.empty() && !report.error)
      report.warnings.push_back(
          without_faces(asset_.path + ": part `" + printable(*source.part) + "`", asset_.span));
    take_report(report, task_);
    return mesh;
  }

  MeshPtr whole_of(const ir::Mesh& source) {
    const auto same = std::ranges::find_if(
        wholes_, [&](const Made& made) { return same_whole(*made.source, source); });
    if (same != wholes_.end()) return same->mesh;
    MeshReport report;
    auto mesh = std::make_shared<TriangleMesh>(
        once_ ? mesh_of_file(source, std::move(data_), asset_.path, asset_.span, report)
              : mesh_of_file(source, data_, asset_.path, asset_.span, report));
    take_report(report, task_);
    wholes_.push_back({&source, mesh});
    return mesh;
  }

  MeshData data_;
  const ir::Asset& asset_;
  bool once_;
  TaskReport& task_;
  MeshPartTaker parts_;
  std::vector<Made> wholes_;
  std::vector<Made> made_;
};

// Other than for the cache of trees, normals count.
Hash128 memory_key_of(const ir::Mesh& mesh, const Hash128& file_key) {
  Hasher hasher;
  hasher.add(std::string_view("mesh"));
  hasher.add(key_of(mesh, file_key));
  hasher.add(std::string_view(ir::value_text(mesh.normals)));
  return hasher.result();
}

// Whether all meshes of the file have been kept; then it is not read.
bool take_kept(const MeshGroup& group, const ir::Scene& scene, const Hash128& file_key,
               const AssetSource& source, PreparedScene& prepared) {
  if (source.memory == nullptr || file_key == Hash128{}) return false;
  std::vector<MeshPtr> kept;
  for (const std::size_t index : group.meshes) {
    const Hash128 key = memory_key_of(mesh_at(scene, index), file_key);
    kept.push_back(source.memory->find<TriangleMesh>(key));
    if (!kept.back()) return false;
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto seen = kept.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(kept.begin(), seen, kept[i]) == seen) source.budget.take(memory_of(*kept[i]));
    prepared.meshes[group.meshes[i]] = kept[i];
    if (kept[i]->faces.size() >= smallest_cached_tree)
      prepared.mesh_keys[group.meshes[i]] = key_of(mesh_at(scene, group.meshes[i]), file_key);
  }
  return true;
}

void prepare_group(const MeshGroup& group, const ir::Scene& scene, const std::vector<Span>& spans,
                   const AssetSource& source, PreparedScene& prepared, TaskReport& task) {
  if (!group.asset.valid()) {
    const std::size_t index = group.meshes.front();
    MeshReport report;
    prepared.meshes[index] =
        std::make_shared<TriangleMesh>(mesh_of_lists(mesh_at(scene, index), spans[index], report));
    take_report(report, task);
    return;
  }
  const ir::Asset& asset = scene.assets[group.asset];
  const Hash128 file_key = file_key_of(asset, source.limits);
  if (take_kept(group, scene, file_key, source, prepared)) return;
  std::optional<MeshData> data = read_mesh(asset, source, task);
  if (!data) return;
  FileMeshes meshes(std::move(*data), asset, group.meshes.size() == 1, task);
  for (const std::size_t index : group.meshes) {
    const ir::Mesh& mesh = mesh_at(scene, index);
    const std::size_t made_before = meshes.count();
    prepared.meshes[index] = meshes.mesh_of(mesh);
    if (meshes.count() != made_before) source.budget.take(memory_of(*prepared.meshes[index]));
    if (file_key != Hash128{} && prepared.meshes[index]->faces.size() >= smallest_cached_tree)
      prepared.mesh_keys[index] = key_of(mesh, file_key);
  }
  if (source.memory == nullptr || file_key == Hash128{} || !task.diagnostics.empty()) return;
  for (const std::size_t index : group.meshes) {
    const MeshPtr& mesh = prepared.meshes[index];
    source.memory->keep(memory_key_of(mesh_at(scene, index), file_key), mesh, memory_of(*mesh));
  }
}

std::shared_ptr<const DecodedImage> kept_picture(const ir::Asset& asset, const AssetSource& source,
                                                 TaskReport& task) {
  if (source.memory == nullptr || asset.hash == Hash128{}) return read_picture(asset, source, task);
  Hasher hasher;
  hasher.add(std::string_view("picture"));
  hasher.add(asset.hash);
  hasher.add(std::string_view(extension_of(asset.path)));
  const Hash128 key = hasher.result();
  if (auto kept = source.memory->find<DecodedImage>(key)) {
    source.budget.take(memory_of(*kept));
    return kept;
  }
  auto picture = read_picture(asset, source, task);
  if (picture && task.diagnostics.empty()) source.memory->keep(key, picture, memory_of(*picture));
  return picture;
}

std::vector<ir::AssetId> images_of(const ir::Scene& scene) {
  std::vector<ir::AssetId> images;
  for (const ir::TextureNode& node : scene.textures) {
    if (const auto* image = std::get_if<ir::ImageTexture>(&node.kind))
      images.push_back(image->file);
  }
  std::sort(images.begin(), images.end());
  images.erase(std::unique(images.begin(), images.end()), images.end());
  return images;
}

// Whether smaller copies of a picture will be made.
bool is_blurred(const ir::Scene& scene, ir::AssetId asset) {
  for (const ir::TextureNode& node : scene.textures) {
    const auto* image = std::get_if<ir::ImageTexture>(&node.kind);
    if (image != nullptr && image->file == asset && image->filter == ir::TextureFilter::trilinear)
      return true;
  }
  return false;
}

Diagnostic too_much_memory(const ir::Scene& scene, const Limits& limits) {
  const Span first = scene.assets.size() == 0 ? Span{} : scene.assets[ir::AssetId(0)].span;
  return Diagnostic(DiagnosticKind::assets_too_large, first,
                    "the meshes and pictures of the scene take more than " +
                        std::to_string(limits.asset_memory) + " bytes of memory")
      .hint(sets_the_limit(limit_option::asset_memory));
}

}  // namespace

namespace {

PreparedPtr prepare_all(const ir::Scene& scene, FileSystem& files, ThreadPool& pool,
                        DiagnosticSink& sink, ContentCache* cache, const Limits& limits,
                        SceneMemory* memory) {
  MemoryBudget budget(limits.asset_memory);
  const AssetSource source{files, cache, limits, budget, memory};
  PreparedPtr prepared(new PreparedScene{&scene, {}, {}, {}});
  prepared->meshes.resize(scene.table<ir::Mesh>().size());
  prepared->mesh_keys.resize(prepared->meshes.size());
  prepared->images.resize(scene.assets.size());
  const std::vector<MeshGroup> groups = group_meshes(scene);
  const std::vector<ir::AssetId> images = images_of(scene);
  const std::vector<Span> spans = spans_of_meshes(scene);
  std::vector<TaskReport> reports(groups.size() + images.size());
  pool.for_each(reports.size(), [&](std::size_t i, unsigned) {
    if (budget.exceeded()) return;
    if (i < groups.size()) {
      prepare_group(groups[i], scene, spans, source, *prepared, reports[i]);
    } else {
      const ir::AssetId asset = images[i - groups.size()];
      auto& image = prepared->images[asset.value()];
      image = kept_picture(scene.assets[asset], source, reports[i]);
      // For colour and for data.
      if (image && is_blurred(scene, asset)) budget.take(2 * Pyramid::memory_for(*image));
    }
  });
  const std::size_t errors_before = sink.error_count();
  if (budget.exceeded()) {  // what else is wrong depends on how far the reading came
    sink.report(too_much_memory(scene, limits));
    return nullptr;
  }
  for (TaskReport& report : reports) {
    for (Diagnostic& diagnostic : report.diagnostics) sink.report(std::move(diagnostic));
  }
  check_items(scene, sink);
  return sink.error_count() == errors_before ? std::move(prepared) : nullptr;
}

}  // namespace

PreparedPtr prepare(const ir::Scene& scene, FileSystem& files, ThreadPool& pool,
                    DiagnosticSink& sink, ContentCache* cache, const Limits& limits) {
  return prepare_all(scene, files, pool, sink, cache, limits, nullptr);
}

PreparedPtr prepare(const ir::Scene& scene, FileSystem& files, ThreadPool& pool,
                    DiagnosticSink& sink, ContentCache* cache, const Limits& limits,
                    SceneMemory& memory) {
  return prepare_all(scene, files, pool, sink, cache, limits, &memory);
}

}  // namespace scenec::backend
