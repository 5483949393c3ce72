#include "runtime/watch/gate.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <stdexcept>

namespace scenec::runtime {

namespace {

// A name that leads here by itself: a page that has its own name point to 127.0.0.1 (DNS
// rebinding) sends that name.
bool is_our_host(std::string_view host, std::uint16_t port) {
  for (const std::string_view name : {"127.0.0.1", "localhost", "[::1]"}) {
    if (host == fmt::format("{}:{}", name, port)) return true;
  }
  return false;
}

bool has_header(const HttpRequest& request, std::string_view name) {
  for (const auto& header : request.headers) {
    if (header.first == name) return true;
  }
  return false;
}

// The page whose script asks, where the browser names it, is ours.
bool is_our_page(const HttpRequest& request, std::string_view host) {
  if (has_header(request, "origin")) {
    const auto origin = request.header("origin");
    if (!origin || *origin != fmt::format("http://{}", host)) return false;
  }
  if (has_header(request, "sec-fetch-site")) {
    const auto site = request.header("sec-fetch-site");
    // `none`: typed, or opened from outside of the browser.
    if (!site || (*site != "same-origin" && *site != "none")) return false;
  }
  return true;
}

std::string_view token_of(const HttpRequest& request) {
  if (const auto token = request.header("x-scenec-token")) return *token;
  std::string_view protocols = request.header("sec-websocket-protocol").value_or("");
  constexpr std::string_view prefix = "token.";
  while (!protocols.empty()) {
    const std::size_t comma = protocols.find(',');
    std::string_view one = protocols.substr(0, comma);
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (one.starts_with(prefix)) return one.substr(prefix.size());
    protocols = comma == std::string_view::npos ? "" : protocols.substr(comma + 1);
  }
  return {};
}

}  // namespace

std::optional<HttpResponse> refusal_of(const Gate& gate, const HttpRequest& request,
                                       Access access) {
  const auto host = request.header("host");
  if (!host || !is_our_host(*host, gate.port))
    return text_response(403, "this server answers to its own name only\n");
  if (!is_our_page(request, *host))
    return text_response(403, "this server answers to its own page only\n");
  if (access == Access::page) return std::nullopt;
  if (!same_secret(token_of(request), gate.token))
    return text_response(403, "open the address that `scenec watch` has printed\n");
  if (access == Access::read) return std::nullopt;
  if (request.method != "POST") return text_response(405, "needs POST\n");
  const std::string_view type = request.header("content-type").value_or("");
  if (type != "application/json") return text_response(415, "needs JSON\n");
  return std::nullopt;
}

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers");
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size() || a.empty()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i])) ^
                  static_cast<unsigned>(static_cast<unsigned char>(b[i]));
  }
  return difference == 0;
}

}  // namespace scenec::runtime
