#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/p21/read/lexer.h"
#include "planner/files/p21/read/parse.h"
#include "planner/files/p21/store.h"

namespace capstan::p21::detail {

/// A stack of nodes.
class NodeStack {
 public:
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  void shrink(std::size_t n) { size_ = n; }
  [[nodiscard]] const Node* from(std::size_t i) const { return nodes_.data() + i; }
  void push(Node n) {
    if (size_ == nodes_.size()) nodes_.resize(2 * size_ + 64);
    nodes_[size_++] = n;
  }

 private:
  std::vector<Node> nodes_;
  std::size_t size_ = 0;
};

/// Where reading stands.
struct Cursor {
  const char* p = nullptr;
  std::uint32_t line = 1;
};

/// What a fault says besides its place.
struct Fault {
  const char* code = "P21-SYNTAX";
  std::string message;
  std::string expected = {};
  std::string hint = {};
};

/// Reads one file into a Store: a single pass, an explicit stack for lists, no recursion.
///
/// Functions that read something return false after they have reported a fault; the caller goes up to
/// the loop over statements, which resumes behind the next ';'.
class Parser {
 public:
  Parser(Store& store, const Limits& limits, Job& job);

  /// Reads it all; the summary of the faults when there were any.
  [[nodiscard]] Status run();

 private:
  struct Frame {
    std::uint32_t start = 0;  ///< its first child on the stack of values
    std::uint32_t typed = 0;  ///< whether KEYWORD(...)
  };

  // sections.cpp
  bool encoding();
  void exchange();
  void header();
  void check_header();
  void data_section();
  void verbatim_section(std::size_t keyword_start, std::size_t keyword_length, std::uint32_t line);
  void signature_section(std::size_t keyword_start, std::uint32_t line);
  bool verbatim_statement(bool references);
  void after_the_end();
  bool peek_word(std::string_view word) const;
  void finish_index();

  // parser.cpp
  bool instance();
  bool record();
  bool instance_id(std::uint64_t& id);
  bool parameters(Node& out);
  [[gnu::always_inline]] const char* quick_value(const char* p, Node& out) const;
  bool open(std::uint32_t typed);
  Node close();

  // values.cpp
  bool simple_value(char first);
  bool number(Node& out);
  bool check_range(const char* start, bool real);
  bool string(Node& out);
  bool check_text(const char* start, std::size_t length, std::uint32_t line);
  bool enumeration(Node& out);
  bool binary(Node& out);

  // parser.cpp
  bool reference(Node& out);
  bool keyword(std::uint32_t& start, std::uint32_t& length);
  bool semicolon();
  bool unexpected(const char* expected);
  void resync();

  /// Goes on to the next byte that is neither space nor within a comment or print control directive.
  void skip() {
    if (class_of(*at_.p) == Class::kSpace) skip_spaces();
  }
  void skip_spaces();
  bool skip_unusual();  ///< false when nothing was skipped

  // faults.cpp
  void fault(Fault f);
  void fault_at(std::uint32_t line, Fault f);
  void warn(const char* code, std::string message, std::string hint = {});
  void report(Severity severity, std::uint32_t line, Fault f);
  [[nodiscard]] Status summary();

  [[nodiscard]] std::uint32_t offset(const char* p) const { return static_cast<std::uint32_t>(p - begin_); }
  [[nodiscard]] bool at_end() const { return at_.p >= end_; }

  Store& store_;
  const Limits limits_;
  Job& job_;
  const char* begin_;
  const char* end_;
  Cursor at_;
  std::uint64_t id_ = 0;  ///< of the instance being read
  std::vector<Frame> frames_;
  NodeStack values_;  ///< stack of finished values whose list is still open
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
  Diagnostic first_error_;
  bool stop_ = false;  ///< no sense in reading on
  bool stopped_by_job_ = false;
  bool seen_open_string_ = false;
  bool warned_bare_cr_ = false;
  bool warned_lower_case_ = false;
};

/// How a byte is named in a message: 'x' or byte 0x07.
[[nodiscard]] std::string name_of(char c);

}  // namespace capstan::p21::detail
