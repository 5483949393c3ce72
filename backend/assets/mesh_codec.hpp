// A decoded mesh file as bytes and back, for the cache. Reading back examines every count and
// index: bytes of any origin give a sound mesh or none.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backend/assets/mesh_data.hpp"
#include "base/hash.hpp"

namespace scenec::backend {

// What decides what a reader makes of a file: its bytes, its format, the limits, and the version of
// the readers and of this codec (raise it when either changes).
[[nodiscard]] Hash128 mesh_key(const Hash128& content, std::string_view extension,
                               const MeshLimits& limits);

// The bytes of a mesh in pieces, most of which lie in the mesh itself: it must stay.
class EncodedMesh {
 public:
  explicit EncodedMesh(const MeshData& mesh);
  EncodedMesh(const EncodedMesh&) = delete;
  EncodedMesh& operator=(const EncodedMesh&) = delete;
  [[nodiscard]] std::span<const std::string_view> pieces() const& { return pieces_; }
  void pieces() && = delete;

 private:
  std::string head_;
  std::vector<std::string_view> pieces_;
};

[[nodiscard]] std::optional<MeshData> decode_mesh(std::string_view bytes);

}  // namespace scenec::backend
