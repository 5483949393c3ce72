#include "base/rooted_file_system.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <filesystem>
#include <optional>

#include "base/text.hpp"

namespace scenec {

namespace {

constexpr int most_links = 40;  // as the system follows in one path
constexpr int read_flags = O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY;
constexpr int look_flags = O_PATH | O_CLOEXEC;  // opens nothing: no permission, no side effect

// What `path` is called from `directory`, both absolute: "" for the directory itself, nullopt
// outside it. Names are compared, nothing is followed.
std::optional<std::string_view> find_beneath(std::string_view path, std::string_view directory) {
  if (directory == "/") return path.substr(std::min(path.find_first_not_of('/'), path.size()));
  if (!path.starts_with(directory)) return std::nullopt;
  path.remove_prefix(directory.size());
  if (!path.empty() && path.front() != '/') return std::nullopt;
  return path.substr(std::min(path.find_first_not_of('/'), path.size()));
}

std::optional<std::string_view> find_beneath(std::string_view path,
                                             const std::vector<std::string>& directories) {
  for (const std::string& directory : directories) {
    if (const auto rest = find_beneath(path, directory)) return rest;
  }
  return std::nullopt;
}

int open_beneath(int root, const std::string& path, int flags) {
  open_how how{};
  how.flags = static_cast<decltype(how.flags)>(flags);
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  return static_cast<int>(::syscall(SYS_openat2, root, path.c_str(), &how, sizeof how));
}

// Refusals that say nothing about the file: no such call, a filter in front of it, a directory
// renamed meanwhile (EAGAIN), and links that are absolute or not plain, which lead nowhere outside
// when we follow their text ourselves.
bool walks_better_by_name(int error_number) {
  return error_number == ENOSYS || error_number == EPERM || error_number == EINVAL ||
         error_number == EAGAIN || error_number == EXDEV || error_number == ELOOP;
}

// The names of a path still to be followed, the next one last.
class Steps {
 public:
  void push(std::string_view path) {
    const std::size_t before = names_.size();
    while (!path.empty()) {
      const std::size_t slash = path.find('/');
      const std::string_view name = path.substr(0, slash);
      path.remove_prefix(slash == std::string_view::npos ? path.size() : slash + 1);
      if (!name.empty() && name != ".") names_.emplace_back(name);
    }
    std::reverse(names_.begin() + static_cast<std::ptrdiff_t>(before), names_.end());
  }
  std::string take() {
    std::string name = std::move(names_.back());
    names_.pop_back();
    return name;
  }
  [[nodiscard]] bool empty() const { return names_.empty(); }

 private:
  std::vector<std::string> names_;
};

std::string target_of(const Descriptor& link) {
  std::array<char, PATH_MAX> buffer;
  const ssize_t size = ::readlinkat(link.number(), "", buffer.data(), buffer.size());
  return {buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

}  // namespace

RootedFileSystem::RootedFileSystem(const std::string& root, Walk walk)
    : root_(::open(root.c_str(), look_flags | O_DIRECTORY)), walk_(walk) {
  if (!root_.valid()) root_error_ = file_error_of(errno);
  std::error_code ignored;
  working_directory_ = std::filesystem::current_path(ignored).string();
  names_.push_back(joined_path(working_directory_, root));
  const std::string real = std::filesystem::canonical(root, ignored).string();
  if (!real.empty() && real != names_.front()) names_.push_back(real);
  const auto below = find_beneath(names_.front(), working_directory_);
  shown_root_ = normalized_path(below ? *below : root);
}

bool RootedFileSystem::is_permitted(const std::string& path) const {
  return std::find(permitted_.begin(), permitted_.end(), path) != permitted_.end();
}

Result<Descriptor, FileError> RootedFileSystem::open(const std::string& path,
                                                     Purpose purpose) const {
  if (path.empty() || path.find('\0') != std::string::npos) return Failure{FileError::not_found};
  const std::string absolute = joined_path(working_directory_, path);
  const auto below = find_beneath(absolute, names_);
  if (!below) return Failure{FileError::outside_root};
  if (!root_.valid()) return Failure{root_error_};
  if (walk_ == Walk::by_system) {
    const std::string from_root(below->empty() ? "." : *below);
    Descriptor file(open_beneath(root_.number(), from_root,
                                 purpose == Purpose::read ? read_flags : look_flags));
    if (file.valid()) return file;
    if (!walks_better_by_name(errno)) return Failure{file_error_of(errno)};
  }
  return open_by_name(*below, purpose);
}

// Each name is opened without following it and then seen for what it is; `..` goes back to the
// directory we came from, which is never above the root.
Result<Descriptor, FileError> RootedFileSystem::open_by_name(std::string_view path,
                                                             Purpose purpose) const {
  std::vector<Descriptor> directories;  // below the root
  const auto here = [&] {
    return directories.empty() ? root_.number() : directories.back().number();
  };
  Steps steps;
  steps.push(path);
  int links = 0;
  while (!steps.empty()) {
    const std::string name = steps.take();
    if (name == "..") {
      if (directories.empty()) return Failure{FileError::outside_root};
      directories.pop_back();
      continue;
    }
    Descriptor entry(::openat(here(), name.c_str(), look_flags | O_NOFOLLOW));
    struct stat info{};
    if (!entry.valid() || ::fstat(entry.number(), &info) != 0) return Failure{file_error_of(errno)};
    if (S_ISLNK(info.st_mode)) {
      if (++links > most_links) return Failure{FileError::not_found};
      const std::string target = target_of(entry);
      std::string_view rest = target;
      if (target.empty()) return Failure{FileError::not_found};
      if (target.front() == '/') {
        const auto below = find_beneath(target, names_);
        if (!below) return Failure{FileError::outside_root};
        directories.clear();
        rest = *below;
      }
      steps.push(rest);
    } else if (S_ISDIR(info.st_mode)) {
      directories.push_back(std::move(entry));
    } else if (!steps.empty()) {
      return Failure{FileError::not_found};  // a file in the place of a directory
    } else if (!S_ISREG(info.st_mode)) {
      return Failure{FileError::not_regular};
    } else if (purpose == Purpose::look) {
      return entry;
    } else {
      // Another file may have the name by now: what is opened is looked at again when it is read.
      Descriptor file(::openat(here(), name.c_str(), read_flags | O_NOFOLLOW));
      if (!file.valid()) return Failure{file_error_of(errno)};
      return file;
    }
  }
  return Failure{FileError::is_directory};
}

Result<FileContent, FileError> RootedFileSystem::read(const std::string& path,
                                                      std::uint64_t size_limit) {
  if (is_permitted(path)) return disk_.read(path, size_limit);
  const auto file = open(path, Purpose::read);
  if (!file) return Failure{file.error()};
  struct stat info{};
  if (refuses_hard_links_ && ::fstat(file.value().number(), &info) == 0 && info.st_nlink > 1)
    return Failure{FileError::outside_root};
  return read_descriptor(file.value(), size_limit);
}

bool RootedFileSystem::is_file(const std::string& path) {
  if (is_permitted(path)) return disk_.is_file(path);
  const auto file = open(path, Purpose::look);
  struct stat info{};
  return file && ::fstat(file.value().number(), &info) == 0 && S_ISREG(info.st_mode);
}

std::string RootedFileSystem::reason_of(FileError error) const {
  if (error != FileError::outside_root) return std::string(text_of(error));
  return fmt::format("lies outside the root `{}` (`--root DIR` moves it){}",
                     printable(shown_root_, shown_root_.size()),
                     refuses_hard_links_ ? " or is a hard link, which `--strict-links` refuses" : "");
}

}  // namespace scenec
