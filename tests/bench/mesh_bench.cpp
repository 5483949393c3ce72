// Mesh readers on a sheet of 100,000 triangles made in memory.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

#include "backend/assets/mesh_codec.hpp"
#include "backend/assets/obj.hpp"
#include "backend/assets/ply.hpp"
#include "tests/bench/mesh_files.hpp"

namespace {

using namespace scenec;

const bench::Sheet sheet;

template <class Reader>
void measure(benchmark::State& state, const std::string& bytes, Reader read) {
  for (auto _ : state) {
    const auto mesh = read(bytes);
    if (!mesh || mesh->triangles.size() != sheet.triangle_count()) {
      state.SkipWithError("the mesh was not read");
    }
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

std::optional<backend::MeshData> value_of(Result<backend::MeshData, AssetProblem> mesh) {
  if (!mesh) return std::nullopt;
  return std::move(mesh).value();
}

void read_obj_100k(benchmark::State& state) {
  measure(state, bench::obj_of(sheet),
          [](const std::string& bytes) { return value_of(backend::read_obj(bytes)); });
}
BENCHMARK(read_obj_100k)->Unit(benchmark::kMillisecond);

void read_ply_ascii_100k(benchmark::State& state) {
  measure(state, bench::ascii_ply_of(sheet),
          [](const std::string& bytes) { return value_of(backend::read_ply(bytes)); });
}
BENCHMARK(read_ply_ascii_100k)->Unit(benchmark::kMillisecond);

void read_ply_binary_100k(benchmark::State& state) {
  measure(state, bench::binary_ply_of(sheet),
          [](const std::string& bytes) { return value_of(backend::read_ply(bytes)); });
}
BENCHMARK(read_ply_binary_100k)->Unit(benchmark::kMillisecond);

void decode_from_cache_100k(benchmark::State& state) {
  const auto mesh = backend::read_ply(bench::binary_ply_of(sheet));
  const backend::EncodedMesh encoded(mesh.value());
  std::string bytes;
  for (const std::string_view piece : encoded.pieces()) bytes += piece;
  measure(state, bytes, [](const std::string& entry) { return backend::decode_mesh(entry); });
}
BENCHMARK(decode_from_cache_100k)->Unit(benchmark::kMillisecond);

}  // namespace
