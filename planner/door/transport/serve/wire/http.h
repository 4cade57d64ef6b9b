#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

/// @file HTTP/1.1 as bytes, without sockets. beast_http.cpp does it by Boost.Beast; a build without Beast
/// has no_beast_http.cpp, and `capstan serve` refuses there.

namespace capstan::transport {

/// Whether this build speaks HTTP.
[[nodiscard]] bool http_is_built();

struct HttpRequest {
  std::string method;  ///< "GET", "POST", ...
  std::string path;    ///< of the target, without a query
  std::string body = {};
};

struct HttpReply {
  unsigned status = 200;
  std::string media = "application/json";
  std::string body = {};
  unsigned retry_after_s = 0;  ///< 0: the header is not sent
};

/// Reads one request from bytes that come in pieces, and keeps what came after it for the next.
///
/// Fails  by a reply: 400 for what is no HTTP/1.x, 413 for a body and 431 for a header that are too long. The
///        connection ends then, for nobody knows where the next request begins.
class RequestReader {
 public:
  enum class State : std::uint8_t { kMore, kWhole, kWrong };

  RequestReader(std::size_t header_bytes, std::size_t body_bytes);
  RequestReader(const RequestReader&) = delete;
  RequestReader& operator=(const RequestReader&) = delete;
  ~RequestReader();

  /// Takes bytes (none: looks at those that came after the last request).
  State take(std::string_view bytes);
  /// Nothing of a request is there yet.
  [[nodiscard]] bool idle() const;
  /// Once, when the header is there and asks whether the body may come ("Expect: 100-continue").
  [[nodiscard]] bool asks_to_continue();
  /// After kWhole: the request; the reader begins the next one.
  [[nodiscard]] HttpRequest request();
  /// Of the last request: the connection stays open after its reply.
  [[nodiscard]] bool keeps_alive() const;
  /// After kWrong.
  [[nodiscard]] const HttpReply& fault() const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// A reply as it is sent.
[[nodiscard]] std::string to_bytes(const HttpReply& reply, bool keep_alive);
/// The header of a reply whose body comes in chunks, one chunk (a text that is not empty), and the last one.
[[nodiscard]] std::string stream_header(const std::string& media);
[[nodiscard]] std::string stream_chunk(const std::string& text);
[[nodiscard]] std::string stream_end();

}  // namespace capstan::transport
