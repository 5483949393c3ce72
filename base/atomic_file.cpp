#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <ctime>
#include <system_error>

namespace scenec {

namespace {

constexpr int longest_link_chain = 40;        // what Linux follows
constexpr int temporary_name_attempts = 100;  // names left over by processes of our id
constexpr mode_t any_write_bit = S_IWUSR | S_IWGRP | S_IWOTH;
constexpr mode_t permission_bits = 07777;

std::string text_of_errno(int error_number) {
  std::string text = std::generic_category().message(error_number);
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z')
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

// Not normalised: `..` behind a symbolic link is for the system to walk.
std::string parent_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}
std::string name_of_file(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

// Where the bytes go: the end of the chain of symbolic links that starts at `path`, which need not
// exist. Empty when the chain does not end.
std::string target_of(std::string path) {
  for (int link = 0; link < longest_link_chain; ++link) {
    std::array<char, PATH_MAX> buffer;
    const ssize_t size = ::readlink(path.c_str(), buffer.data(), buffer.size());
    if (size < 0) return path;  // no link; whatever else is wrong shows when it is used
    const std::string next(buffer.data(), static_cast<std::size_t>(size));
    path = next.starts_with('/') ? next : parent_of(path) + '/' + next;
  }
  return {};
}

std::optional<std::string> find_directory_problem(const std::string& directory) {
  struct stat info{};
  if (::stat(directory.c_str(), &info) != 0) {
    if (errno == ENOENT) return "directory `" + directory + "` does not exist";
    return "directory `" + directory + "`: " + text_of_errno(errno);
  }
  if (!S_ISDIR(info.st_mode)) return "`" + directory + "` is not a directory";
  // access() lets root write everywhere; permission bits without any `w` say what the owner meant.
  const bool writable = (info.st_mode & any_write_bit) != 0;
  if (!writable || ::access(directory.c_str(), W_OK | X_OK) != 0) {
    return "directory `" + directory + "` is not writable";
  }
  return std::nullopt;
}

std::optional<std::string> find_existing_problem(const std::string& path, const struct stat& info) {
  if (S_ISDIR(info.st_mode)) return "is a directory";
  if (!S_ISREG(info.st_mode)) return "is not a regular file";
  const bool writable = (info.st_mode & any_write_bit) != 0;
  if (!writable || ::access(path.c_str(), W_OK) != 0) return "is read-only";
  return std::nullopt;
}

// A file that vanishes with its owner unless it was renamed into place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& target) {
    // The name is cut so that the longest legal file name still has room for what is added.
    const std::string stem = parent_of(target) + "/." + name_of_file(target).substr(0, 200) +
                             ".tmp-" + std::to_string(::getpid());
    for (int attempt = 0; attempt < temporary_name_attempts && descriptor_ < 0; ++attempt) {
      path_ = attempt == 0 ? stem : stem + '-' + std::to_string(attempt);
      descriptor_ =
          ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
      error_ = descriptor_ < 0 ? errno : 0;
      if (error_ != 0 && error_ != EEXIST) break;
    }
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (exists_on_disk()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  // Each step returns 0 or the errno of its failure.
  [[nodiscard]] int opening_error() const { return error_; }
  [[nodiscard]] int set_mode(mode_t mode) { return ::fchmod(descriptor_, mode) == 0 ? 0 : errno; }
  [[nodiscard]] int write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count =
          ::write(descriptor_, bytes.data(), std::min(bytes.size(), largest_write));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return errno;
      if (count == 0) return EIO;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
  }
  [[nodiscard]] int flush_and_close(Durability durability) {
    // Some file systems have no fsync and say EINVAL; every other failure means lost bytes.
    if (durability == Durability::immediate && ::fsync(descriptor_) != 0 && errno != EINVAL)
      return errno;
    const int closing = ::close(descriptor_);
    descriptor_ = -1;
    return closing == 0 ? 0 : errno;
  }
  [[nodiscard]] int rename_to(const std::string& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) return errno;
    renamed_ = true;
    return 0;
  }

 private:
  static constexpr std::size_t largest_write = std::size_t{1}
                                               << 30;  // write() takes a bit less than 2 GiB

  [[nodiscard]] bool exists_on_disk() const { return error_ == 0 && !renamed_; }

  std::string path_;
  int descriptor_ = -1;
  int error_ = EEXIST;
  bool renamed_ = false;
};

// While it lives, a file size limit (`ulimit -f`) is an error of write() in this thread and not a
// signal that would end the process with the temporary file left behind.
class SizeSignalHeld {
 public:
  SizeSignalHeld() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGXFSZ);
    ::pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
  }
  ~SizeSignalHeld() {
    const timespec no_wait{};
    if (sigismember(&previous_, SIGXFSZ) == 0) ::sigtimedwait(&signals_, nullptr, &no_wait);
    ::pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
  }
  SizeSignalHeld(const SizeSignalHeld&) = delete;
  SizeSignalHeld& operator=(const SizeSignalHeld&) = delete;

 private:
  sigset_t signals_;
  sigset_t previous_;
};

// Makes the rename last through a power cut. A failure is not reported: the name already holds the
// complete new bytes.
void flush_directory(const std::string& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

int replace(const std::string& target, std::span<const std::string_view> pieces,
            Durability durability) {
  TemporaryFile file(target);
  if (file.opening_error() != 0) return file.opening_error();
  struct stat existing{};
  if (::stat(target.c_str(), &existing) == 0) {
    if (const int error = file.set_mode(existing.st_mode & permission_bits)) return error;
  }
  const SizeSignalHeld held;
  for (const std::string_view piece : pieces) {
    if (const int error = file.write(piece)) return error;
  }
  if (const int error = file.flush_and_close(durability)) return error;
  return file.rename_to(target);
}

}  // namespace

std::optional<std::string> find_output_problem(const std::string& path) {
  if (path.empty()) return "the path is empty";
  if (path.find('\0') != std::string::npos) return "the path holds a NUL byte";
  struct stat info{};
  if (::stat(path.c_str(), &info) == 0) {
    if (auto problem = find_existing_problem(path, info)) return problem;
  } else if (errno != ENOENT && errno != ENOTDIR) {
    return text_of_errno(errno);
  }
  const std::string target = target_of(path);
  if (target.empty()) return text_of_errno(ELOOP);
  if (auto problem = find_directory_problem(parent_of(target))) return problem;
  if (name_of_file(target).empty()) return "names a directory, not a file";
  return std::nullopt;
}

std::optional<std::string> write_file_atomically(const std::string& path, std::string_view bytes) {
  return write_file_atomically(path, std::span(&bytes, 1), Durability::immediate);
}

std::optional<std::string> write_file_atomically(const std::string& path,
                                                 std::span<const std::string_view> pieces,
                                                 Durability durability) {
  if (auto problem = find_output_problem(path)) return problem;
  const std::string target = target_of(path);
  if (const int error = replace(target, pieces, durability)) return text_of_errno(error);
  if (durability == Durability::immediate) flush_directory(parent_of(target));
  return std::nullopt;
}

}  // namespace scenec
