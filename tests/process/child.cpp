#include "tests/process/child.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace scenec::test {

namespace {

namespace fs = std::filesystem;

double now_in_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

fs::path capture_file() {
  std::string name = (fs::temp_directory_path() / "scenec-capture-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) std::abort();
  ::close(descriptor);
  return name;
}

void redirect(const std::string& file, int descriptor) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (opened < 0 || ::dup2(opened, descriptor) < 0) ::_exit(127);
}

}  // namespace

const std::string small_scene = R"(sdl 1;
material matt: diffuse { color = gray(0.6); }
sphere ball { radius = 1m; material = matt; }
light: point { position = [2, 3, 4]; power = 900W; }
camera main: pinhole { eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }
render { size = [32, 24]; samples = 4; }
)";

Child::Child(const std::vector<std::string>& words, const ChildOptions& options)
    : out_(options.standard_output.empty() ? capture_file() : fs::path()), err_(capture_file()) {
  std::vector<std::string> storage{SCENEC_BINARY};
  storage.insert(storage.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : storage) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string out = out_.empty() ? options.standard_output : out_.string();
  start_ = now_in_seconds();
  process_ = ::fork();
  if (process_ != 0) return;
  redirect(out, STDOUT_FILENO);
  redirect(err_.string(), STDERR_FILENO);
  if (::chdir(options.directory.c_str()) != 0) ::_exit(127);
  if (options.file_size_limit) {
    const rlimit limit{*options.file_size_limit, *options.file_size_limit};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  const rlimit seconds{60, 60};  // a hang is a failure, not a stuck machine
  ::setrlimit(RLIMIT_CPU, &seconds);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

void Child::send(int signal) const {
  ::kill(process_, signal);
}

ChildResult Child::wait() {
  int status = 0;
  rusage usage{};
  ::wait4(process_, &status, 0, &usage);
  ChildResult result;
  result.seconds = now_in_seconds() - start_;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const auto seconds_of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  result.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  result.peak_mebibytes = static_cast<double>(usage.ru_maxrss) / 1024;
  if (!out_.empty()) result.out = bytes_of(out_);
  result.err = bytes_of(err_);
  std::error_code ignored;
  if (!out_.empty()) fs::remove(out_, ignored);
  fs::remove(err_, ignored);
  return result;
}

ChildResult run_child(const std::vector<std::string>& words, const ChildOptions& options) {
  return Child(words, options).wait();
}

void expect_bounded(const ChildResult& result, const std::string& name) {
  constexpr double most_seconds = 2;
  constexpr double most_seconds_of_waiting = 30;
  constexpr double most_mebibytes = 256;
  std::printf("%s: exit %d, %.2f s, %.0f MiB\n", name.c_str(), result.exit_code, result.cpu_seconds,
              result.peak_mebibytes);
  if (SCENEC_IS_SANITIZED) return;
  EXPECT_LE(result.cpu_seconds, most_seconds) << name;
  EXPECT_LE(result.seconds, most_seconds_of_waiting) << name;
  EXPECT_LE(result.peak_mebibytes, most_mebibytes) << name;
}

int located_errors(const std::string& messages, const std::string& name) {
  int count = 0;
  for (std::size_t at = messages.find(": error[E"); at != std::string::npos;
       at = messages.find(": error[E", at + 1)) {
    const std::size_t line = messages.rfind('\n', at) + 1;  // npos + 1 is 0
    if (messages.compare(line, name.size() + 1, name + ":") == 0) ++count;
  }
  return count;
}

Sandbox::Sandbox() {
  std::string name = (fs::temp_directory_path() / "scenec-process-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) std::abort();
  path_ = name;
}

Sandbox::~Sandbox() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path Sandbox::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path_ / name;
}

std::vector<std::string> Sandbox::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace scenec::test
