// A disk that is full at each of many points of every output: the old file stays whole, the exit
// code is 3, nothing half-written is left. Two ways to run out of room: a limit on the size of a
// file, byte by byte (`prlimit`), and a small file system, page by page (tmpfs in a mount
// namespace of its own). A machine that allows one of them not skips it and says so.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/process/child.hpp"

namespace {

namespace fs = std::filesystem;
using scenec::test::Sandbox;

struct Writer {
  std::string name;
  std::string words;                 // run in the folder `disk`
  std::vector<std::string> outputs;  // what stands there before, and is replaced
  bool is_timed = false;             // its bytes are others each time

  friend std::ostream& operator<<(std::ostream& out, const Writer& writer) {
    return out << writer.name;
  }
};

const std::vector<Writer> writers{
    {"picture", "../scene.sdl -o out.png", {"out.png"}},
    {"layers", "../layers.sdl -o out.exr", {"out.exr"}},
    {"checkpoint", "../scene.sdl -o ../other.png --checkpoint c", {"c"}, true},
    {"statistics", "../scene.sdl -o ../other.png --stats=json:s.json", {"s.json"}, true},
    {"difference", "diff ../a.exr ../b.exr -o d.exr", {"d.exr"}},
    {"difference as PNG", "diff ../a.exr ../b.exr -o d.png", {"d.png"}},
    {"text of a dump", "dump ../scene.sdl -o dump.txt", {"dump.txt"}},
    {"layout", "fmt plain.sdl", {"plain.sdl"}},
    {"stress",
     "stress ../scene.sdl --size 8x6 --samples 4 -o .",
     {"moved.exr", "large.exr", "small.exr", "turned.exr", "jittered.exr"}},
    {"study",
     "study ../scene.sdl --size 8x6 --time 200ms -o .",
     {"report.json", "curves.csv", "report.html"},
     true},
};

// What was found after one attempt: the exit code, and of every file what it holds.
struct Attempt {
  long long room = 0;
  int exit_code = -1;
  std::map<std::string, std::string> files;  // "old", "whole" or its last bytes
};

constexpr std::string_view common_script = R"sh(
set -u
export SCENEC_CACHE=off LC_ALL=C
old='sdl   1;  // the old file'
state() {  # of the file $1
  if echo "$old" | cmp -s - "$1"; then echo old
  elif cmp -s "$1" "../whole/$1"; then echo whole
  elif [ "$(wc -c <"$1")" = "$(wc -c <"../whole/$1")" ]; then echo same-size
  else echo "$(wc -c <"$1"):$(tail -c 9 "$1" | tr -d '\n')"; fi
}
prepare() {
  find . -mindepth 1 -delete
  for name in $outputs; do echo "$old" >"$name"; done
}
report() {  # room, exit code
  printf '%s %s' "$1" "$2"
  for name in $(ls -A | grep -v '^ballast$'); do
    printf ' %s=%s' "$name" "$(state "$name" | tr ' ' '_')"
  done
  echo
}
mkdir -p whole disk
(cd whole && prepare && $scenec $words >/dev/null 2>&1) || { echo "no reference"; exit 1; }
)sh";

// The largest file decides: at most as many bytes as it has are tried.
constexpr std::string_view limit_script = R"sh(
command -v prlimit >/dev/null || { echo skip: no prlimit; exit 0; }
largest=$(cd whole && stat -c %s * | sort -n | tail -1)
cd disk
for room in 0 1 512 $((largest / 4)) $((largest / 2)) $((largest * 3 / 4)) $((largest - 1)) \
            $largest $((largest * 2)); do
  prepare
  said=$(prlimit --fsize=$room: -- $scenec $words 2>&1)
  report $room $?
done
)sh";

// Old files and ballast fill the disk but for the room.
constexpr std::string_view disk_script = R"sh(
mount -t tmpfs -o size=4m tmpfs disk 2>/dev/null || { echo skip: no mount; exit 0; }
largest=$(du -s --apparent-size -B 4096 whole | cut -f 1)
cd disk
step=$(((largest + 5) / 6))
for part in 0 1 2 3 4 5 6 8 16; do
  pages=$((part * step))
  prepare
  head -c 4m /dev/zero >ballast 2>/dev/null
  truncate -s -$((4096 * pages)) ballast
  said=$($scenec $words 2>&1)
  report $((4096 * pages)) $?
done
)sh";

class DiskFull : public testing::TestWithParam<Writer> {
 protected:
  void SetUp() override {
    sandbox_.write("scene.sdl", scenec::test::small_scene);
    std::string layers = scenec::test::small_scene;
    const std::string settings = "samples = 4;";
    layers.replace(layers.find(settings), settings.size(),
                   "samples = 4; aovs = [.albedo, .normal, .variance];");
    sandbox_.write("layers.sdl", layers);
    if (!GetParam().words.starts_with("diff")) return;
    for (const char* const seed : {"1", "2"}) {
      const std::string out = seed == std::string("1") ? "a.exr" : "b.exr";
      ASSERT_EQ(scenec::test::run_child(
                    {"layers.sdl", "-o", out, "--seed", seed},
                    {.directory = sandbox_.path(), .file_size_limit = {}, .standard_output = {}})
                    .exit_code,
                0);
    }
  }

  // Empty when it cannot be done here (`why` then says so).
  [[nodiscard]] std::vector<Attempt> attempts(const std::string& shell, std::string_view script,
                                              std::string& why) const {
    std::string outputs;
    for (const std::string& name : GetParam().outputs) outputs += name + ' ';
    sandbox_.write("script.sh", "cd '" + sandbox_.path().string() +
                                    "'\nscenec='" SCENEC_BINARY "'\nwords='" + GetParam().words +
                                    "'\noutputs='" + outputs + "'\n" + std::string(common_script) +
                                    std::string(script));
    const std::string line =
        shell + " '" + (sandbox_.path() / "script.sh").string() + "' 2>&1 </dev/null";
    std::FILE* const pipe = ::popen(line.c_str(), "r");
    if (pipe == nullptr) return {};
    std::string text;
    std::array<char, 4096> buffer{};
    for (std::size_t size = 0; (size = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      text.append(buffer.data(), size);
    ::pclose(pipe);
    if (text.starts_with("skip") || text.starts_with("unshare")) {
      why = text;
      return {};
    }
    return attempts_of(text);
  }
  [[nodiscard]] static std::vector<Attempt> attempts_of(const std::string& text) {
    std::vector<Attempt> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      Attempt one;
      if (!(words >> one.room >> one.exit_code)) {
        ADD_FAILURE() << line;
        continue;
      }
      for (std::string file; words >> file;) {
        const std::size_t at = file.find('=');
        one.files[file.substr(0, at)] = file.substr(at + 1);
      }
      all.push_back(std::move(one));
    }
    return all;
  }

  [[nodiscard]] static bool is_whole(const std::string& name, const std::string& state) {
    if (state == "whole") return true;
    if (!GetParam().is_timed) return false;
    if (state == "same-size") return true;  // a checkpoint: it holds the time it took
    if (name.ends_with(".html")) return state.ends_with("</html>");
    return name.ends_with(".csv") || (name.ends_with(".json") && state.ends_with("}"));
  }

  void expect_sound(const std::vector<Attempt>& all) const {
    ASSERT_EQ(all.size(), 9U);
    int failed = 0;
    int succeeded = 0;
    for (const Attempt& one : all) {
      SCOPED_TRACE("room for " + std::to_string(one.room) + " bytes");
      EXPECT_TRUE(one.exit_code == 3 || one.exit_code == 0) << one.exit_code;
      failed += one.exit_code == 3 ? 1 : 0;
      succeeded += one.exit_code == 0 ? 1 : 0;
      for (const std::string& name : GetParam().outputs)
        EXPECT_TRUE(one.files.contains(name)) << name;
      for (const auto& [name, state] : one.files) {
        EXPECT_FALSE(name.starts_with(".")) << name << " is left behind";
        const bool whole = is_whole(name, state);
        EXPECT_TRUE(one.exit_code == 0 ? whole || name.ends_with("~") : whole || state == "old")
            << name << " is " << state;
      }
    }
    EXPECT_GT(failed, 0);
    EXPECT_GT(succeeded, 0);
  }

  Sandbox sandbox_;
};

TEST_P(DiskFull, AtALimitOfTheSizeOfAFile) {
  std::string why;
  const std::vector<Attempt> all = attempts("bash", limit_script, why);
  if (all.empty()) GTEST_SKIP() << why;
  expect_sound(all);
}

TEST_P(DiskFull, OnASmallDisk) {
  std::string why;
  const std::vector<Attempt> all = attempts("unshare -Urm bash", disk_script, why);
  if (all.empty()) GTEST_SKIP() << "no file system of its own: " << why;
  expect_sound(all);
}

INSTANTIATE_TEST_SUITE_P(Every, DiskFull, testing::ValuesIn(writers), [](const auto& chosen) {
  std::string name = chosen.param.name;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

}  // namespace
