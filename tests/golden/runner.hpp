// What the golden tests share: the program run inside the test, and expected texts that are
// compared or, with `--update`, written anew (the diff is then read before it is committed).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scenec::test {

struct RunResult {
  int exit_code = 0;
  std::string out;
  std::string err;
};
// Runs scenec as on a command line: no terminal, no environment variables, the process's working
// directory.
[[nodiscard]] RunResult run_scenec(const std::vector<std::string>& words);
// Standard output, standard error and exit code as one text; what says "ok" leaves no line.
[[nodiscard]] std::string transcript_of(const RunResult& result);

// Runs each line of an `.args` file (`scenec WORD...`, or `file NAME TEXT`; `TMP` is an empty
// directory made for it; blank lines and `#` comments are skipped) and joins the transcripts. `"a
// b"` is one word.
[[nodiscard]] std::string transcript_of_args(const std::filesystem::path& args_file);

// Files of `directory` with one of the extensions, sorted.
[[nodiscard]] std::vector<std::filesystem::path> files_in(
    const std::filesystem::path& directory, const std::vector<std::string>& extensions);
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

class Golden {
 public:
  // Words: `--update`, and part of a case's name to run only those.
  Golden(int argument_count, char** arguments);

  [[nodiscard]] bool wants(const std::filesystem::path& input) const;
  // Compares with `<input>.expected`.
  void compare(const std::filesystem::path& input, const std::string& actual);
  void fail(const std::filesystem::path& input, std::string_view problem);
  // Prints the count; the test's exit code.
  [[nodiscard]] int finish() const;

 private:
  bool update_ = false;
  std::string filter_;
  int cases_ = 0;
  int failures_ = 0;
};

}  // namespace scenec::test
