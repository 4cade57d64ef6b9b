#pragma once

#include <string>
#include <vector>

namespace capstan::app {

/// An option, flag or positional argument of a command, as --help has it.
struct OptionText {
  std::vector<std::string> names;     ///< with their dashes; a positional has one, without
  std::string value;                  ///< what kind of value, e.g. "TEXT"; empty: a flag
  std::string limits;                 ///< of the value, e.g. "UINT in [1 - 256]"; empty: any
  std::vector<std::string> choices;   ///< values that are taken; empty: any
  bool open = false;                  ///< other values are taken beside the choices
  std::vector<std::string> excludes;  ///< options that exclude this one
  std::string help;
  bool positional = false, required = false, repeatable = false;
};

/// A command, its options in order, and the commands below it.
struct CommandText {
  std::string name;  ///< the word on the command line
  std::string help;  ///< one sentence
  std::string notes;
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

/// The whole command line, read from the parser's own options, so that each option is described once.
[[nodiscard]] CommandText command_reference();

}  // namespace capstan::app
