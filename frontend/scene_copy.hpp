// Copies rows of one scene, with all they refer to, into the builder of another, each row once.
// What a module declares goes this way from a compilation into the cache, and from there into the
// next.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>

#include "frontend/eval/value.hpp"
#include "ir/builder.hpp"

namespace scenec::frontend {

// Which row of one scene is which of another, for every table whose rows are referred to.
struct RowMap {
  std::unordered_map<std::uint32_t, std::uint32_t> assets, textures, materials, protos, origins;
};

class SceneCopy {
 public:
  struct Ends {
    const ir::Scene& from;
    ir::SceneBuilder& to;
    RowMap& rows;                                  // of `from` to `to`, known and new
    RowMap& back;                                  // the inverse
    const std::function<FileId(FileId)>& file_of;  // invalid: the place has no counterpart
  };
  explicit SceneCopy(const Ends& ends) : ends_(ends) {}

  // The value with the ids of the other scene.
  [[nodiscard]] Value operator()(const Value& value);
  // False: something could not be copied, and the results are of no use.
  [[nodiscard]] bool sound() const { return sound_; }

 private:
  using Rows = std::unordered_map<std::uint32_t, std::uint32_t> RowMap::*;
  template <class Tag, class Make>
  Id<Tag> once(Rows rows, Id<Tag> id, Make&& make);

  ir::AssetId copy(ir::AssetId id);
  ir::TextureId copy(ir::TextureId id);
  ir::MaterialId copy(ir::MaterialId id);
  ir::ProtoId copy(ir::ProtoId id);
  ir::OriginId copy(ir::OriginId id);
  ir::NameId copy(ir::NameId id);
  ir::Declared copy(const ir::Declared& declared);
  ir::Item copy(const ir::Item& item);
  Span copy(Span span);
  template <class Fields>
  void renumber_keys(Fields& fields);
  template <class Texture>
  void renumber_texture(Texture& texture);

  Ends ends_;
  std::uint32_t depth_ = 0;
  bool sound_ = true;
};

}  // namespace scenec::frontend
