#include "tests/golden/runner.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "runtime/cli.hpp"

namespace scenec::test {

namespace {

namespace fs = std::filesystem;

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  bool in_word = false;
  bool in_quotes = false;
  for (const char c : line) {
    if (c == '"') {
      in_quotes = !in_quotes;
    }
    if (c == ' ' && !in_quotes) {
      in_word = false;
      continue;
    }
    if (!in_word) words.emplace_back();
    in_word = true;
    if (c != '"') words.back() += c;
  }
  return words;
}

class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (fs::temp_directory_path() / "scenec-golden-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// `file NAME TEXT`: writes TMP/NAME; in TEXT `\\n` is a line end and `{N*c}` N times c, so that a
// case of a limit need not be a file of that size.
void write_generated(const std::string& directory, const std::string& line) {
  const std::size_t name_end = line.find(' ', 5);
  std::string text;
  for (std::size_t i = name_end + 1; i < line.size(); ++i) {
    if (line[i] == '\\' && line.substr(i, 2) == "\\n") {
      text += '\n';
      ++i;
    } else if (line[i] == '{' && line.find("*", i) != std::string::npos) {
      const std::size_t star = line.find('*', i);
      text.append(std::stoul(line.substr(i + 1, star - i - 1)), line[star + 1]);
      i = star + 2;
    } else {
      text += line[i];
    }
  }
  std::ofstream(fs::path(directory) / line.substr(5, name_end - 5), std::ios::binary) << text;
}

void print_first_difference(const std::string& expected, const std::string& actual) {
  std::istringstream a(expected);
  std::istringstream b(actual);
  std::string line_a;
  std::string line_b;
  for (int number = 1;; ++number) {
    const bool has_a = static_cast<bool>(std::getline(a, line_a));
    const bool has_b = static_cast<bool>(std::getline(b, line_b));
    if (!has_a && !has_b) return;
    if (has_a == has_b && line_a == line_b) continue;
    fmt::print("  line {}\n  expected: {}\n  actual:   {}\n", number, has_a ? line_a : "(end)",
               has_b ? line_b : "(end)");
    return;
  }
}

}  // namespace

RunResult run_scenec(const std::vector<std::string>& words) {
  std::ostringstream out;
  std::ostringstream err;
  const runtime::Environment environment{
      .out = out,
      .err = err,
      .err_is_terminal = false,
      .variable = [](std::string_view) { return std::nullopt; },
      .handle_signals = false,
  };
  const auto code = static_cast<int>(runtime::run(words, environment));
  return {code, out.str(), err.str()};
}

std::string transcript_of(const RunResult& result) {
  std::string text = result.out;
  if (!result.err.empty()) text += "[standard error]\n" + result.err;
  if (result.exit_code != 0) text += fmt::format("[exit {}]\n", result.exit_code);
  return text;
}

std::string transcript_of_args(const fs::path& args_file) {
  const TemporaryDirectory temporary;
  std::istringstream lines(read_text(args_file));
  std::string text;
  std::string line;
  while (std::getline(lines, line)) {
    if (line.empty() || line.starts_with('#')) continue;
    if (!text.empty()) text += '\n';
    text += "$ " + line + "\n";
    if (line.starts_with("file ")) {
      write_generated(temporary.path(), line);
      continue;
    }
    std::string with_directory = line;
    replace_all(with_directory, "TMP", temporary.path());
    std::vector<std::string> words = words_of(with_directory);
    if (words.empty() || words.front() != "scenec") return text + "(a line starts with scenec)\n";
    words.erase(words.begin());
    text += transcript_of(run_scenec(words));
  }
  replace_all(text, temporary.path(), "TMP");
  return text;
}

std::vector<fs::path> files_in(const fs::path& directory,
                               const std::vector<std::string>& extensions) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    const std::string extension = entry.path().extension().string();
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end() &&
        entry.path().filename() != "CMakeLists.txt") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Golden::Golden(int argument_count, char** arguments) {
  for (int i = 1; i < argument_count; ++i) {
    const std::string_view word = arguments[i];
    if (word == "--update") {
      update_ = true;
    } else {
      filter_ = word;
    }
  }
}

bool Golden::wants(const fs::path& input) const {
  return input.string().find(filter_) != std::string::npos;
}

void Golden::compare(const fs::path& input, const std::string& actual) {
  ++cases_;
  const fs::path expected_path = input.string() + ".expected";
  const bool exists = fs::exists(expected_path);
  const std::string expected = read_text(expected_path);
  if (exists && expected == actual) return;
  if (update_) {
    std::ofstream(expected_path, std::ios::binary) << actual;
    fmt::print("updated {}\n", expected_path.filename().string());
    return;
  }
  fail(input, exists ? "differs from what is expected" : "has no expected text; run with --update");
  if (exists) print_first_difference(expected, actual);
}

void Golden::fail(const fs::path& input, std::string_view problem) {
  ++failures_;
  fmt::print("FAILED {}: {}\n", input.string(), problem);
}

int Golden::finish() const {
  fmt::print("{} cases, {} failed\n", cases_, failures_);
  return failures_ == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace scenec::test
