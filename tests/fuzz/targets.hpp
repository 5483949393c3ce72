// The fuzz targets: each takes any bytes and aborts when something that must always hold does not.
// Nothing is read from the disk. The same functions serve libFuzzer (fuzz_entry.cpp, clang) and the
// replay of the kept inputs in the normal build (replay.cpp).
#pragma once

#include <array>
#include <string_view>

namespace scenec::fuzz {

// One or several native files: `// file: NAME` on a line of its own begins the next one.
void fuzz_native(std::string_view bytes);
// One course file.
void fuzz_course(std::string_view bytes);
// The same bytes as an OBJ file and as its material library.
void fuzz_mesh(std::string_view bytes);
void fuzz_ply(std::string_view bytes);
// A picture of any format.
void fuzz_image(std::string_view bytes);
// A command line, one word a line, and behind an empty line the file that its `--params` names.
void fuzz_settings(std::string_view bytes);
// What a client sends to the preview server.
void fuzz_socket(std::string_view bytes);

struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
};
// `fuzz_NAME` is the binary, tests/fuzz/corpus/NAME holds the kept inputs.
inline constexpr std::array<Target, 7> targets{{
    {"native", fuzz_native},
    {"course", fuzz_course},
    {"mesh", fuzz_mesh},
    {"ply", fuzz_ply},
    {"image", fuzz_image},
    {"settings", fuzz_settings},
    {"socket", fuzz_socket},
}};

}  // namespace scenec::fuzz
