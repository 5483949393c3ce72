#include "backend/prepare.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "backend/assets/mesh_codec.hpp"
#include "backend/assets/obj.hpp"
#include "backend/assets/ply.hpp"
#include "backend/backend.hpp"
#include "backend/image/read_image.hpp"
#include "base/text.hpp"

namespace scenec::backend {

void destroy(PreparedScene* scene) {
  delete scene;
}

namespace {

// Where assets come from, and what is too much of them.
struct AssetSource {
  FileSystem& files;
  ContentCache* cache;  // null: none
  const Limits& limits;
};

// Diagnostics of one task; reported afterwards in the order of the tasks.
struct TaskReport {
  std::vector<Diagnostic> diagnostics;
};

std::optional<FileContent> read_asset(const ir::Asset& asset, FileSystem& files,
                                      std::uint64_t limit, std::string_view limit_option,
                                      TaskReport& report) {
  auto content = files.read(asset.path, limit);
  if (content) return std::move(content).value();
  Diagnostic diagnostic(DiagnosticKind::file_unreadable, asset.span,
                        asset.path + " cannot be read: " + files.reason_of(content.error()));
  const bool too_large = content.error() == FileError::too_large;
  report.diagnostics.push_back(too_large ? std::move(diagnostic).hint(sets_the_limit(limit_option))
                                         : std::move(diagnostic));
  return std::nullopt;
}

Diagnostic broken(DiagnosticKind kind, const ir::Asset& asset, const AssetProblem& problem) {
  Diagnostic diagnostic(kind, asset.span,
                        asset.path + (problem.line != 0 ? ":" + std::to_string(problem.line) : "") +
                            ": " + problem.message);
  if (problem.limit_option.empty()) return diagnostic;
  return std::move(diagnostic).hint(sets_the_limit(problem.limit_option));
}

// Smaller files are decoded as fast as they are found in the cache.
constexpr std::uint64_t smallest_cached_file = 64 * 1024;
// Smaller trees are built as fast as they are found there.
constexpr std::size_t smallest_cached_tree = 4096;

// What is in the cache stands for the bytes whose hash it is kept under. Scenes made without the
// front end have no hash.
std::optional<MeshData> find_cached(ContentCache& cache, const Hash128& key) {
  const auto entry = cache.find(key);
  if (!entry) return std::nullopt;
  auto mesh = decode_mesh(entry->bytes);
  if (!mesh) cache.refuse();
  return mesh;
}

// Whatever the format: the key of what a reader makes of the file, zero without a hash of it.
Hash128 file_key_of(const ir::Asset& asset, const Limits& limits) {
  if (asset.hash == Hash128{}) return {};
  return mesh_key(asset.hash, extension_of(asset.path), MeshLimits(limits));
}

std::optional<MeshData> read_mesh(const ir::Asset& asset, const AssetSource& source,
                                  TaskReport& report) {
  const std::string extension = extension_of(asset.path);
  if (extension != ".obj" && extension != ".ply") {
    report.diagnostics.push_back(
        Diagnostic(DiagnosticKind::mesh_format_unknown, asset.span,
                   asset.path + " is neither an `.obj` nor a `.ply` file"));
    return std::nullopt;
  }
  const MeshLimits limits(source.limits);
  const Hash128 key = file_key_of(asset, source.limits);
  ContentCache* cache = key == Hash128{} ? nullptr : source.cache;
  if (cache != nullptr) {
    if (auto cached = find_cached(*cache, key)) return cached;
  }
  const auto content =
      read_asset(asset, source.files, limits.file_bytes, limit_option::mesh_bytes, report);
  if (!content) return std::nullopt;
  auto data =
      extension == ".obj" ? read_obj(content->bytes, limits) : read_ply(content->bytes, limits);
  if (data) {
    // The file may have changed since its hash was taken.
    if (cache != nullptr && content->bytes.size() >= smallest_cached_file &&
        hash_bytes(content->bytes) == asset.hash) {
      const EncodedMesh encoded(data.value());
      cache->store(key, encoded.pieces());
    }
    return std::move(data).value();
  }
  report.diagnostics.push_back(broken(DiagnosticKind::mesh_broken, asset, data.error()));
  return std::nullopt;
}

std::shared_ptr<const DecodedImage> read_picture(const ir::Asset& asset, const AssetSource& source,
                                                 TaskReport& report) {
  const ImageLimits limits(source.limits);
  const auto content =
      read_asset(asset, source.files, limits.file_bytes, limit_option::image_bytes, report);
  if (!content) return nullptr;
  auto image = read_image(content->bytes, extension_of(asset.path), limits);
  if (image) return std::make_shared<DecodedImage>(std::move(image).value());
  report.diagnostics.push_back(broken(DiagnosticKind::image_broken, asset, image.error()));
  return nullptr;
}

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
  std::optional<MeshData> data = read_mesh(asset, source, task);
  if (!data) return;
  FileMeshes meshes(std::move(*data), asset, group.meshes.size() == 1, task);
  const Hash128 file_key = file_key_of(asset, source.limits);
  for (const std::size_t index : group.meshes) {
    const ir::Mesh& mesh = mesh_at(scene, index);
    prepared.meshes[index] = meshes.mesh_of(mesh);
    if (file_key != Hash128{} && prepared.meshes[index]->faces.size() >= smallest_cached_tree)
      prepared.mesh_keys[index] = key_of(mesh, file_key);
  }
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

}  // namespace

PreparedPtr prepare(const ir::Scene& scene, FileSystem& files, ThreadPool& pool,
                    DiagnosticSink& sink, ContentCache* cache, const Limits& limits) {
  const AssetSource source{files, cache, limits};
  PreparedPtr prepared(new PreparedScene{&scene, {}, {}, {}});
  prepared->meshes.resize(scene.table<ir::Mesh>().size());
  prepared->mesh_keys.resize(prepared->meshes.size());
  prepared->images.resize(scene.assets.size());
  const std::vector<MeshGroup> groups = group_meshes(scene);
  const std::vector<ir::AssetId> images = images_of(scene);
  const std::vector<Span> spans = spans_of_meshes(scene);
  std::vector<TaskReport> reports(groups.size() + images.size());
  pool.for_each(reports.size(), [&](std::size_t i, unsigned) {
    if (i < groups.size()) {
      prepare_group(groups[i], scene, spans, source, *prepared, reports[i]);
    } else {
      const ir::AssetId asset = images[i - groups.size()];
      prepared->images[asset.value()] = read_picture(scene.assets[asset], source, reports[i]);
    }
  });
  const std::size_t errors_before = sink.error_count();
  for (TaskReport& report : reports) {
    for (Diagnostic& diagnostic : report.diagnostics) sink.report(std::move(diagnostic));
  }
  check_items(scene, sink);
  check_supported(scene, sink);
  return sink.error_count() == errors_before ? std::move(prepared) : nullptr;
}

}  // namespace scenec::backend
