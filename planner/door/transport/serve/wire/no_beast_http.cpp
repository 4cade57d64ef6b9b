#include "planner/door/transport/serve/wire/http.h"

// A build without Boost.Beast: `serve` asks http_is_built and refuses, so that none of the others is called.

namespace capstan::transport {

bool http_is_built() { return false; }

struct RequestReader::Parser {
  HttpReply wrong{.status = 501};
};
RequestReader::RequestReader(std::size_t /*header_bytes*/, std::size_t /*body_bytes*/)
    : parser_(std::make_unique<Parser>()) {}
RequestReader::~RequestReader() = default;
RequestReader::State RequestReader::take(std::string_view /*bytes*/) { return State::kWrong; }
bool RequestReader::idle() const { return true; }
bool RequestReader::asks_to_continue() { return false; }
HttpRequest RequestReader::request() { return {}; }
bool RequestReader::keeps_alive() const { return false; }
const HttpReply& RequestReader::fault() const { return parser_->wrong; }

std::string to_bytes(const HttpReply& /*reply*/, bool /*keep_alive*/) { return {}; }
std::string stream_header(const std::string& /*media*/) { return {}; }
std::string stream_chunk(const std::string& /*text*/) { return {}; }
std::string stream_end() { return {}; }

}  // namespace capstan::transport
