// Runs the built scenec as a child process and measures it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scenec::test {

struct ChildOptions {
  std::filesystem::path directory = ".";
  std::optional<std::uint64_t> file_size_limit;  // RLIMIT_FSIZE, bytes
  std::string standard_output;                   // a file to write to; else it is captured
};
struct ChildResult {
  int exit_code = -1;  // 128 + n after signal n
  std::string out;
  std::string err;
  double seconds = 0;
  double cpu_seconds = 0;  // of all threads; other than `seconds` no matter of what else runs
  double peak_mebibytes = 0;
};

class Child {
 public:
  Child(const std::vector<std::string>& words, const ChildOptions& options);
  void send(int signal) const;
  [[nodiscard]] ChildResult wait();

 private:
  pid_t process_ = -1;
  std::filesystem::path out_;
  std::filesystem::path err_;
  double start_ = 0;
};

[[nodiscard]] ChildResult run_child(const std::vector<std::string>& words,
                                    const ChildOptions& options = {});

// What no input may exceed: 2 s of work and 256 MiB (B01-B24 of the reliability rules). The clock
// on the wall is given more, since tests share their machine. Nothing is asked of sanitized builds.
void expect_bounded(const ChildResult& result, const std::string& name);

// Errors `NAME:line:column: error[E....]` in messages.
[[nodiscard]] int located_errors(const std::string& messages, const std::string& name);

// An empty directory that vanishes with its owner.
class Sandbox {
 public:
  Sandbox();
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::vector<std::string> names() const;  // of all entries, sorted

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string bytes_of(const std::filesystem::path& path);

// A small scene that renders in no time.
extern const std::string small_scene;

}  // namespace scenec::test
