#include "tests/bench/mesh_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string_view>

namespace scenec::bench {
namespace {

// Calls f(a, b, c) with 0-based indices of each triangle.
template <class F>
void for_each_triangle(const Sheet& sheet, F&& f) {
  for (int row = 0; row < sheet.rows; ++row) {
    for (int column = 0; column < sheet.columns; ++column) {
      const int a = row * (sheet.columns + 1) + column;
      const int b = a + sheet.columns + 1;
      f(a, b, a + 1);
      f(a + 1, b, b + 1);
    }
  }
}

template <class F>
void for_each_point(const Sheet& sheet, F&& f) {
  for (int row = 0; row <= sheet.rows; ++row) {
    for (int column = 0; column <= sheet.columns; ++column) {
      const double x = 2.5 * column / sheet.columns;
      const double z = 2.0 * row / sheet.rows;
      f(std::array<double, 3>{x, 0.1 * std::sin(7 * x) * std::cos(5 * z), z});
    }
  }
}

template <class T>
void append_bytes(std::string& out, T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  out.append(bytes.data(), bytes.size());
}

std::string ply_header(const Sheet& sheet, std::string_view format) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, (sheet.columns + 1) * (sheet.rows + 1), sheet.triangle_count());
}

}  // namespace

std::string obj_of(const Sheet& sheet) {
  std::string text;
  for_each_point(sheet, [&](const std::array<double, 3>& p) {
    fmt::format_to(std::back_inserter(text), "v {:.6f} {:.6f} {:.6f}\n", p[0], p[1], p[2]);
  });
  for_each_triangle(sheet, [&](int a, int b, int c) {
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", a + 1, b + 1, c + 1);
  });
  return text;
}

std::string ascii_ply_of(const Sheet& sheet) {
  std::string text = ply_header(sheet, "ascii");
  for_each_point(sheet, [&](const std::array<double, 3>& p) {
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f} {:.6f}\n", p[0], p[1], p[2]);
  });
  for_each_triangle(sheet, [&](int a, int b, int c) {
    fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", a, b, c);
  });
  return text;
}

std::string binary_ply_of(const Sheet& sheet) {
  std::string bytes = ply_header(sheet, "binary_little_endian");
  for_each_point(sheet, [&](const std::array<double, 3>& p) {
    for (const double value : p) append_bytes(bytes, static_cast<float>(value));
  });
  for_each_triangle(sheet, [&](int a, int b, int c) {
    append_bytes(bytes, std::uint8_t{3});
    for (const int index : {a, b, c}) append_bytes(bytes, static_cast<std::int32_t>(index));
  });
  return bytes;
}

}  // namespace scenec::bench
