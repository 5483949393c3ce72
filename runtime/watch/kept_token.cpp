#include "runtime/watch/kept_token.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <string_view>

#include "base/file_descriptor.hpp"
#include "runtime/watch/gate.hpp"

namespace scenec::runtime {

namespace {

constexpr std::size_t token_digits = 32;

std::string read_token(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status{};
  if (!file.valid() || ::fstat(file.number(), &status) != 0) return {};
  const bool is_ours =
      S_ISREG(status.st_mode) && status.st_uid == ::geteuid() && (status.st_mode & 077) == 0;
  std::array<char, token_digits + 1> bytes{};
  if (!is_ours || ::read(file.number(), bytes.data(), bytes.size()) != ssize_t{token_digits})
    return {};
  const std::string_view token(bytes.data(), token_digits);
  return token.find_first_not_of("0123456789abcdef") == std::string_view::npos ? std::string(token)
                                                                               : std::string();
}

}  // namespace

std::string kept_token(const Environment& environment, std::uint16_t port) {
  const std::string directory = environment.variable("XDG_RUNTIME_DIR").value_or("");
  if (!directory.starts_with('/')) return random_token();
  const std::string path = fmt::format("{}/scenec-watch-{}", directory, port);
  if (std::string kept = read_token(path); !kept.empty()) return kept;
  const std::string token = random_token();
  ::unlink(path.c_str());
  const Descriptor file(
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (file.valid() && ::write(file.number(), token.data(), token.size()) != ssize_t{token_digits})
    ::unlink(path.c_str());
  return token;
}

}  // namespace scenec::runtime
