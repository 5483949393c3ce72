// Mesh readers on a grid of 100,000 triangles made in memory.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>

#include "backend/assets/obj.hpp"
#include "backend/assets/ply.hpp"

namespace {

constexpr int columns = 250;
constexpr int rows = 200;
constexpr std::size_t triangle_count = std::size_t{2} * columns * rows;

std::array<double, 3> grid_point(int column, int row) {
  const double x = column * 0.01;
  const double z = row * 0.01;
  return {x, 0.1 * std::sin(7 * x) * std::cos(5 * z), z};
}

// Calls f(a, b, c) with 0-based indices of each triangle.
template <class F>
void for_each_triangle(F&& f) {
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int a = row * (columns + 1) + column;
      const int b = a + columns + 1;
      f(a, b, a + 1);
      f(a + 1, b, b + 1);
    }
  }
}

template <class F>
void for_each_point(F&& f) {
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) f(grid_point(column, row));
  }
}

std::string obj_text() {
  std::string text;
  for_each_point([&](const std::array<double, 3>& p) {
    fmt::format_to(std::back_inserter(text), "v {:.6f} {:.6f} {:.6f}\n", p[0], p[1], p[2]);
  });
  for_each_triangle([&](int a, int b, int c) {
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", a + 1, b + 1, c + 1);
  });
  return text;
}

template <class T>
void append_bytes(std::string& out, T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  out.append(bytes.data(), bytes.size());
}

std::string ply_header(std::string_view format) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, (columns + 1) * (rows + 1), triangle_count);
}

std::string ascii_ply() {
  std::string text = ply_header("ascii");
  for_each_point([&](const std::array<double, 3>& p) {
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f} {:.6f}\n", p[0], p[1], p[2]);
  });
  for_each_triangle([&](int a, int b, int c) {
    fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", a, b, c);
  });
  return text;
}

std::string binary_ply() {
  std::string bytes = ply_header("binary_little_endian");
  for_each_point([&](const std::array<double, 3>& p) {
    for (const double value : p) append_bytes(bytes, static_cast<float>(value));
  });
  for_each_triangle([&](int a, int b, int c) {
    append_bytes(bytes, std::uint8_t{3});
    for (const int index : {a, b, c}) append_bytes(bytes, static_cast<std::int32_t>(index));
  });
  return bytes;
}

template <class Reader>
void measure(benchmark::State& state, const std::string& bytes, Reader read) {
  for (auto _ : state) {
    const auto mesh = read(bytes);
    if (!mesh || mesh.value().triangles.size() != triangle_count) {
      state.SkipWithError("the mesh was not read");
    }
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

void read_obj_100k(benchmark::State& state) {
  measure(state, obj_text(),
          [](const std::string& bytes) { return scenec::backend::read_obj(bytes); });
}
BENCHMARK(read_obj_100k)->Unit(benchmark::kMillisecond);

void read_ply_ascii_100k(benchmark::State& state) {
  measure(state, ascii_ply(),
          [](const std::string& bytes) { return scenec::backend::read_ply(bytes); });
}
BENCHMARK(read_ply_ascii_100k)->Unit(benchmark::kMillisecond);

void read_ply_binary_100k(benchmark::State& state) {
  measure(state, binary_ply(),
          [](const std::string& bytes) { return scenec::backend::read_ply(bytes); });
}
BENCHMARK(read_ply_binary_100k)->Unit(benchmark::kMillisecond);

}  // namespace
