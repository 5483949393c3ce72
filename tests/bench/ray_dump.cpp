#include "tests/bench/ray_dump.hpp"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "backend/assets/ply.hpp"

namespace scenec::bench {
namespace {

template <class T>
bool read(std::istream& in, T& value) {
  return static_cast<bool>(in.read(reinterpret_cast<char*>(&value), sizeof value));
}
template <class T>
bool read(std::istream& in, std::vector<T>& values, std::size_t count) {
  values.resize(count);
  return static_cast<bool>(in.read(reinterpret_cast<char*>(values.data()),
                                   static_cast<std::streamsize>(count * sizeof(T))));
}

backend::TriangleMesh read_obj_as_recorded(std::istream& in) {
  backend::TriangleMesh mesh;
  std::string line;
  std::vector<std::uint32_t> polygon;
  while (std::getline(in, line)) {
    if (line.size() < 2 || line[1] != ' ') continue;
    char* at = line.data() + 1;
    if (line[0] == 'v') {
      double p[3];
      for (double& x : p) x = static_cast<double>(std::strtof(at, &at));
      mesh.positions.push_back({p[0], p[1], p[2]});
    } else if (line[0] == 'f') {
      polygon.clear();
      while (true) {
        char* end = nullptr;
        const long i = std::strtol(at, &end, 10);
        if (end == at) break;
        const long zero_based = i > 0 ? i - 1 : static_cast<long>(mesh.positions.size()) + i;
        polygon.push_back(static_cast<std::uint32_t>(zero_based));
        at = end;
        while (*at != 0 && std::strchr(" \t\r\n", *at) == nullptr) ++at;
      }
      for (std::size_t k = 2; k < polygon.size(); ++k)
        mesh.faces.push_back({polygon[0], polygon[k - 1], polygon[k]});
    }
  }
  return mesh;
}

}  // namespace

std::optional<RayDump> read_ray_dump(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  char magic[8] = {};
  std::uint32_t head[3] = {};
  float box[6] = {};
  if (!in || !read(in, magic) || std::memcmp(magic, "SRAYS01", 8) != 0 || !read(in, head) ||
      !read(in, box))
    return std::nullopt;
  RayDump dump;
  dump.triangles = head[1];
  for (std::uint32_t i = 0; i < head[0]; ++i) {
    char name[17] = {};
    std::uint32_t counts[2] = {};
    if (!in.read(name, 16) || !read(in, counts)) return std::nullopt;
    DumpSet set{name, counts[0] != 0, {}, {}};
    if (!read(in, set.rays, counts[1]) || !read(in, set.hits, counts[1])) return std::nullopt;
    dump.sets.push_back(std::move(set));
  }
  return dump;
}

std::optional<backend::TriangleMesh> read_bench_mesh(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  if (!path.ends_with(".ply")) return read_obj_as_recorded(in);
  std::stringstream bytes;
  bytes << in.rdbuf();
  auto data = backend::read_ply(bytes.str());
  if (!data) return std::nullopt;
  backend::TriangleMesh mesh;
  mesh.positions = data.value().positions;
  mesh.faces = data.value().triangles;
  return mesh;
}

}  // namespace scenec::bench
