// Writes the fuzzers' dictionaries into a directory: every word that the tables of the languages
// and formats know. Run by the build, so that a new key or function is never forgotten.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

#include "base/units.hpp"
#include "frontend/course/words.hpp"
#include "frontend/eval/builtins.hpp"
#include "frontend/lower/std_library.hpp"
#include "grammar/scan.hpp"
#include "ir/describe.hpp"
#include "runtime/help.hpp"
#include "runtime/options.hpp"
#include "runtime/verbs.hpp"
#include "tests/fuzz/targets.hpp"

namespace {

using Words = std::set<std::string>;

void add(Words& words, std::initializer_list<std::string_view> more) {
  for (const std::string_view word : more) words.emplace(word);
}

Words native_words() {
  using namespace scenec;
  Words words;
  for (const std::string_view word :
       {"sdl",   "include",  "as",    "param",    "let",    "fn",     "macro",
        "proto", "material", "group", "instance", "light",  "camera", "render",
        "for",   "in",       "if",    "else",     "assert", "true",   "false"}) {
    if (!grammar::scan::is_reserved(word)) std::abort();
    words.emplace(word);
  }
  for (const std::string_view name : frontend::builtin_names())
    words.insert(std::string(name) + "(");
  for (const std::string_view name : frontend::constant_names()) words.emplace(name);
  for (const std::string& name : frontend::library_names()) words.insert('"' + name + '"');
  for (const Unit& unit : all_units()) words.insert("1" + std::string(unit.suffix));
  for (const ir::KindDescription& kind : ir::all_kinds()) {
    words.emplace(kind.name);
    for (const ir::KeyDescription& key : kind.keys) {
      words.insert(std::string(key.name) + " = ");
      for (const std::string_view value : key.legal_values) words.insert("." + std::string(value));
    }
  }
  add(words, {"sdl 1;",  "\n// file: ", "..",         "..<",         "&&",       "||",   "==",
              "!=",      "<=",          ">=",         "///",         "/*",       "*/",   "@allow(",
              "@clock",  "#fff",        "\\u{",       "int",         "num",      "bool", "string",
              "length",  "angle",       "time",       "power",       "color",    "vec2", "vec3",
              "point",   "curve",       "texture",    "1e308",       "1e-308",   "-0.0", "tri.obj",
              "tri.ply", "gray.pgm",    "broken.png", "temperature", "transform"});
  return words;
}

Words course_words() {
  Words words;
  for (const scenec::frontend::course::Word& word : scenec::frontend::course::all_words()) {
    words.emplace(word.text);
  }
  add(words, {"numObjects", "numMaterials", "numLights", "tri.obj", "gray.pgm", "//", "#", "{", "}",
              "[", "]", "1e308", "-1"});
  return words;
}

Words mesh_words() {
  Words words;
  add(words, {"v ",      "vt ",        "vn ",
              "f ",      "g ",         "o ",
              "usemtl ", "mtllib ",    "newmtl ",
              "Kd ",     "Ks ",        "Ke ",
              "Ka ",     "Ns ",        "Ni ",
              "Tr ",     "d ",         "illum ",
              "map_Kd ", "map_d ",     "map_bump ",
              "bump ",   "-s 1 1 1 ",  "-bm ",
              "1/2/3",   "1//2",       "-1",
              "1e308",   "nan",        "inf",
              "\\\n",    "4294967296", "9223372036854775807"});
  return words;
}

Words ply_words() {
  Words words;
  add(words, {"ply\n",
              "format ascii 1.0\n",
              "format binary_little_endian 1.0\n",
              "format binary_big_endian 1.0\n",
              "comment ",
              "obj_info ",
              "element vertex ",
              "element face ",
              "property float x\n",
              "property list uchar int vertex_indices\n",
              "property ",
              "list ",
              "char ",
              "uchar ",
              "short ",
              "ushort ",
              "int ",
              "uint ",
              "float ",
              "double ",
              "int8 ",
              "uint8 ",
              "int16 ",
              "uint16 ",
              "int32 ",
              "uint32 ",
              "float32 ",
              "float64 ",
              "nx\n",
              "ny\n",
              "nz\n",
              "s\n",
              "t\n",
              "u\n",
              "v\n",
              "vertex_index\n",
              "end_header\n",
              "4294967295",
              "9223372036854775808"});
  return words;
}

Words image_words() {
  Words words;
  add(words, {"IHDR",
              "PLTE",
              "IDAT",
              "IEND",
              "tRNS",
              "gAMA",
              "iCCP",
              "zTXt",
              "acTL",
              "#?RADIANCE",
              "FORMAT=32-bit_rle_rgbe",
              "-Y 2 +X 2\n",
              "EXPOSURE=",
              "P2",
              "P3",
              "P5",
              "P6",
              "TRUEVISION-XFILE.",
              "channels",
              "compression",
              "dataWindow",
              "displayWindow",
              "lineOrder",
              "chlist",
              "box2i",
              "pixelAspectRatio",
              "tiles",
              "tiledesc"});
  for (const std::string_view bytes :
       {std::string_view("\x89PNG\r\n\x1a\n"), std::string_view("\xFF\xD8\xFF\xC0"),
        std::string_view("\xFF\xC2"), std::string_view("\xFF\xDA"), std::string_view("\xFF\xC4"),
        std::string_view("\xFF\xDB"), std::string_view("\x76\x2F\x31\x01"), std::string_view("BM"),
        std::string_view("\x2\x2\x0\x8", 4)}) {
    words.emplace(bytes);
  }
  return words;
}

Words settings_words() {
  using namespace scenec;
  Words words = native_words();
  for (const runtime::VerbInfo& verb : runtime::all_verbs()) words.emplace(verb.name);
  for (const runtime::OptionRow& row : runtime::all_options()) {
    for (const std::string_view name : runtime::names_of(row)) {
      words.insert(std::string(name) + (name.starts_with("--") ? "=" : "\n"));
      words.insert(std::string(name) + "\n");
    }
  }
  add(words, {"\n--\n", "scene.sdl\n", "-D\nn=", "{\"n\":", "null", "[[1,2],[3]]", "\\u0000",
              "0..143", "320x200", "0,0,1,1", "500ms"});
  return words;
}

// One entry a line; what is no plain character is written as \xNN.
void write(const std::filesystem::path& path, const Words& words) {
  std::ofstream out(path);
  for (const std::string& word : words) {
    out << '"';
    for (const char c : word) {
      const bool plain = c > ' ' && c < '\x7F' && c != '"' && c != '\\';
      char text[8];
      std::snprintf(text, sizeof text, plain ? "%c" : "\\x%02X", static_cast<unsigned char>(c));
      out << text;
    }
    out << "\"\n";
  }
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return 2;
  const Words all[] = {native_words(), course_words(), mesh_words(),
                       ply_words(),    image_words(),  settings_words()};
  static_assert(std::size(all) == scenec::fuzz::targets.size());
  for (std::size_t i = 0; i < std::size(all); ++i) {
    const std::string name = "fuzz_" + std::string(scenec::fuzz::targets[i].name) + ".dict";
    write(std::filesystem::path(arguments[1]) / name, all[i]);
  }
}
