#pragma once

#include <string>

// Where the built programs are. The paths stand in one object file: the others compile alike in every build
// folder.

namespace capstan::app {

/// The file of the command.
[[nodiscard]] const std::string& command_file();
/// The same, quoted for a shell.
[[nodiscard]] std::string command_quoted();
/// The program that writes parts as CAD systems make them; empty where it is built without OpenCASCADE.
[[nodiscard]] const std::string& parts_file();
/// What runs Python with the module of this build: settings of the environment and the interpreter, for a
/// shell.
[[nodiscard]] std::string python_quoted();

}  // namespace capstan::app
