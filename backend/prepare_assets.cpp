#include "backend/prepare_assets.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "backend/assets/mesh_codec.hpp"
#include "backend/assets/obj.hpp"
#include "backend/assets/ply.hpp"
#include "backend/image/read_image.hpp"
#include "base/text.hpp"

namespace scenec::backend {

namespace {

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
// What is in the cache stands for the bytes whose hash it is kept under. Scenes made without the
// front end have no hash.
std::optional<MeshData> find_cached(ContentCache& cache, const Hash128& key) {
  const auto entry = cache.find(key);
  if (!entry) return std::nullopt;
  auto mesh = decode_mesh(entry->bytes);
  if (!mesh) cache.refuse();
  return mesh;
}

}  // namespace

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
  if (image) {
    source.budget.take(memory_of(image.value()));
    return std::make_shared<DecodedImage>(std::move(image).value());
  }
  report.diagnostics.push_back(broken(DiagnosticKind::image_broken, asset, image.error()));
  return nullptr;
}

}  // namespace scenec::backend
