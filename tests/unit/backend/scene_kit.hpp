// Small scenes for tests, written in a few lines: builds the IR, prepares, builds, renders.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>

#include "backend/backend.hpp"
#include "backend/math/color.hpp"
#include "base/elementary.hpp"
#include "ir/builder.hpp"

namespace scenec::backend::test {

class SceneKit {
 public:
  ir::RenderSettings settings;

  SceneKit() {
    settings.size = {16, 16};
    origin_ = builder_.add_origin({});
    identity_ = builder_.add_transform({});
  }
  ir::MaterialId material(ir::MaterialKind kind, ir::MaterialCommon common = {}) {
    return builder_.add_material({std::move(kind), std::move(common)}, declared("m"));
  }
  ir::MaterialId matt(double albedo) {
    return material(ir::Diffuse{{{albedo, albedo, albedo}, {}}});
  }
  ir::MaterialId glowing(double radiance, double albedo = 0) {
    ir::MaterialCommon common;
    common.emission.value = {radiance, radiance, radiance};
    return material(ir::Diffuse{{{albedo, albedo, albedo}, {}}}, common);
  }
  ir::TextureId texture(ir::TextureKind kind) { return builder_.add_texture({std::move(kind)}); }
  ir::TransformId transform(const std::array<double, 16>& rows) {
    ir::Transform t;
    t.m = rows;
    return builder_.add_transform(t);
  }
  template <class Shape>
  void place(Shape shape, ir::MaterialId material) {
    place(std::move(shape), material, identity_);
  }
  template <class Shape>
  void place(Shape shape, ir::MaterialId material, ir::TransformId transform) {
    builder_.place(item(std::move(shape), material, transform));
  }
  template <class Shape>
  ir::Item item(Shape shape, ir::MaterialId material, ir::TransformId transform) {
    return {builder_.add_shape(std::move(shape)), transform, material, origin_, {}};
  }
  [[nodiscard]] ir::TransformId identity() const { return identity_; }
  ir::ProtoId proto(std::vector<ir::Item> items) {
    return builder_.add_proto({std::move(items)}, declared("p"));
  }
  void light(ir::LightKind kind) { builder_.add_light({std::move(kind)}, declared("")); }
  void camera(ir::CameraKind kind) {
    settings.camera = builder_.add_camera({std::move(kind)}, declared("c"));
  }
  void pinhole(ir::Point3 eye, ir::Point3 aim, double fov_degrees, ir::Direction up = {0, 1, 0}) {
    ir::Pinhole camera_kind;
    camera_kind.eye = eye;
    camera_kind.aim = aim;
    camera_kind.up = up;
    camera_kind.fov = Angle{fov_degrees * pi / 180};
    camera(camera_kind);
  }
  ir::AssetId asset(std::string path) { return builder_.add_asset({std::move(path), {}, {}}); }
  ir::SceneBuilder& builder() { return builder_; }

  ir::Scene finish() {
    builder_.set_render(settings, origin_);
    return builder_.finish();
  }

 private:
  ir::Declared declared(const char* name) { return {builder_.add_name(name), origin_}; }
  ir::SceneBuilder builder_;
  ir::OriginId origin_;
  ir::TransformId identity_;
};

// A scene ready to render.
struct Ready {
  ir::Scene scene;
  ThreadPool pool;
  PreparedPtr prepared;
  RenderScenePtr built;

  explicit Ready(ir::Scene source, unsigned threads = 2) : scene(std::move(source)), pool(threads) {
    MemoryFileSystem files;
    make(files);
  }
  Ready(ir::Scene source, FileSystem& files) : scene(std::move(source)), pool(2) { make(files); }
  [[nodiscard]] Picture render(std::stop_token stop = {}, const ProgressFunction& progress = {}) {
    return backend::render(*built, scene.render, pool, std::move(stop), progress);
  }

 private:
  void make(FileSystem& files) {
    DiagnosticSink sink;
    prepared = prepare(scene, files, pool, sink);
    for (const Diagnostic& d : sink.sorted()) ADD_FAILURE() << d.message;
    if (prepared) built = build(*prepared, pool);
  }
};

inline Picture render(SceneKit& kit, unsigned threads = 2) {
  return Ready(kit.finish(), threads).render();
}

inline Rgb pixel(const Picture& picture, int x, int y) {
  const auto i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                      static_cast<std::size_t>(x));
  return {static_cast<double>(picture.rgb[i]), static_cast<double>(picture.rgb[i + 1]),
          static_cast<double>(picture.rgb[i + 2])};
}

inline Rgb mean(const Picture& picture) {
  Rgb sum;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) sum += pixel(picture, x, y);
  }
  return sum / (picture.width * picture.height);
}

}  // namespace scenec::backend::test
