#include <boost/asio/buffer.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <optional>
#include <sstream>
#include <utility>

#include "planner/door/transport/serve/replies.h"
#include "planner/door/transport/serve/wire/http.h"

// The one file that knows Boost.Beast: its parser and its spelling of messages. Sockets are not its business
// (server.cpp), so that every limit in time stands in one place.

namespace capstan::transport {

namespace http = boost::beast::http;

bool http_is_built() { return true; }

struct RequestReader::Parser {
  using Message = http::request_parser<http::string_body>;

  Parser(std::size_t header, std::size_t body) : header_bytes(header), body_bytes(body) { begin(); }
  void begin() {
    message.emplace();
    message->eager(true);
    message->header_limit(static_cast<std::uint32_t>(header_bytes));
    message->body_limit(body_bytes);
    continued = false;
  }

  std::size_t header_bytes, body_bytes;
  std::optional<Message> message;
  std::string pending;  ///< came, and is not parsed yet
  bool continued = false, keep = false;
  HttpReply wrong;
};

RequestReader::RequestReader(std::size_t header_bytes, std::size_t body_bytes)
    : parser_(std::make_unique<Parser>(header_bytes, body_bytes)) {}
RequestReader::~RequestReader() = default;

namespace {

/// Of the peer's bytes nothing is repeated: the words are Beast's and ours.
HttpReply fault_of(const boost::beast::error_code& ec, std::size_t header, std::size_t body) {
  if (ec == http::error::header_limit || ec == http::error::buffer_overflow)
    return refused(431, "SERVE-HTTP", "the header is longer than " + std::to_string(header) + " bytes");
  if (ec == http::error::body_limit)
    return refused(413, "SERVE-HTTP", "the body is longer than " + std::to_string(body) + " bytes");
  return refused(400, "SERVE-HTTP", "this is no HTTP/1.1 request: " + ec.message());
}

}  // namespace

RequestReader::State RequestReader::take(std::string_view bytes) {
  Parser& p = *parser_;
  p.pending.append(bytes);
  while (!p.message->is_done()) {
    if (p.pending.empty()) return State::kMore;
    boost::beast::error_code ec;
    const std::size_t used = p.message->put(boost::asio::buffer(p.pending), ec);
    p.pending.erase(0, used);
    if (ec == http::error::need_more) {
      // Beast looks at its limit when the end of the header, or of a chunk's first line, is there; a peer may
      // never send it.
      if (p.pending.size() <= p.header_bytes) return State::kMore;
      ec = http::error::header_limit;
    }
    if (ec) {
      p.wrong = fault_of(ec, p.header_bytes, p.body_bytes);
      return State::kWrong;
    }
    if (used == 0) return State::kMore;
  }
  return State::kWhole;
}

bool RequestReader::idle() const { return parser_->pending.empty() && !parser_->message->got_some(); }

bool RequestReader::asks_to_continue() {
  Parser& p = *parser_;
  if (p.continued || !p.message->is_header_done() || p.message->is_done()) return false;
  p.continued = true;
  return boost::beast::iequals(p.message->get()[http::field::expect], "100-continue");
}

HttpRequest RequestReader::request() {
  Parser& p = *parser_;
  auto message = p.message->release();
  p.keep = message.keep_alive();
  p.begin();
  const std::string_view target(message.target().data(), message.target().size());
  return {std::string(message.method_string()), std::string(target.substr(0, target.find('?'))),
          std::move(message.body())};
}

bool RequestReader::keeps_alive() const { return parser_->keep; }
const HttpReply& RequestReader::fault() const { return parser_->wrong; }

namespace {

template <class Message>
std::string spelled(const Message& message) {
  std::ostringstream out;
  out << message;
  return out.str();
}

}  // namespace

std::string to_bytes(const HttpReply& reply, bool keep_alive) {
  http::response<http::string_body> message(static_cast<http::status>(reply.status), 11);
  message.set(http::field::content_type, reply.media);
  if (reply.retry_after_s > 0) message.set(http::field::retry_after, std::to_string(reply.retry_after_s));
  message.body() = reply.body;
  message.keep_alive(keep_alive);
  message.prepare_payload();
  return spelled(message);
}

std::string stream_header(const std::string& media) {
  http::response<http::empty_body> message(http::status::ok, 11);
  message.set(http::field::content_type, media);
  message.keep_alive(false);
  message.chunked(true);
  return spelled(message.base());
}

std::string stream_chunk(const std::string& text) {
  std::ostringstream out;
  out << std::hex << text.size() << "\r\n" << text << "\r\n";
  return out.str();
}

std::string stream_end() { return "0\r\n\r\n"; }

}  // namespace capstan::transport
