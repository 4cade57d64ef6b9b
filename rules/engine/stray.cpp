#include "rules/engine/stray.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <optional>
#include <sstream>

namespace capstan::rules {
namespace {

/// Sees where each document begins. One that begins where another began was not read.
class Begins final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& at) override {
    if (last_ && *last_ == at.pos) stray = static_cast<std::uint64_t>(at.line + 1);
    last_ = at.pos;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*at*/, YAML::anchor_t /*anchor*/) override {}
  void OnAlias(const YAML::Mark& /*at*/, YAML::anchor_t /*anchor*/) override {}
  void OnScalar(const YAML::Mark& /*at*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {}
  void OnSequenceStart(const YAML::Mark& /*at*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& /*at*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {}
  void OnMapEnd() override {}

  std::uint64_t stray = 0;

 private:
  std::optional<int> last_;
};

}  // namespace

std::uint64_t stray_sign(const std::string& text) {
  Begins begins;
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    while (begins.stray == 0 && parser.HandleNextDocument(begins)) {
    }
  } catch (const YAML::Exception&) {
    return 0;
  }
  return begins.stray;
}

}  // namespace capstan::rules
