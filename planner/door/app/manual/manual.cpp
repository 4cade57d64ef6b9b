#include "planner/door/app/manual/manual.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "planner/door/app/command/run.h"

namespace capstan::app {
namespace {

/// Text for troff: no dash becomes a hyphen, no line a request.
std::string plain(const std::string& text) {
  std::string out;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else {
      if (c == '-') out += '\\';
      out += c;
    }
    begins = c == '\n';
  }
  return out;
}
std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

template <class Of>
std::string joined(const std::vector<std::string>& words, const char* between, Of of) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + of(word);
  return out;
}

/// The value of an option, as shown behind its name.
std::string value_of(const OptionText& o) {
  if (o.choices.empty()) return italic(o.value);
  return joined(o.choices, "|", bold) + (o.open ? "|" + italic(o.value) : "");
}

std::string synopsis(const std::string& called, const CommandText& command) {
  std::string out = bold(called);
  if (!command.commands.empty()) return out + " " + italic("COMMAND") + " ...\n";
  out += " [" + italic("OPTION") + "]...";
  for (const OptionText& o : command.options) {
    if (!o.positional && !o.required) continue;
    std::string one = o.positional ? italic(o.names.front()) : bold(o.names.front()) + " " + value_of(o);
    if (!o.required) one = "[" + one + "]";
    out += " " + one + (o.repeatable ? "..." : "");
  }
  return out + "\n";
}

std::string option(const OptionText& o) {
  std::string out = ".TP\n" + joined(o.names, ", ", o.positional ? italic : bold);
  if (!o.positional && !o.value.empty()) out += " " + value_of(o);
  out += "\n" + plain(o.help);
  if (!o.limits.empty()) out += " (" + plain(o.limits) + ")";
  if (o.positional && !o.choices.empty()) out += " (" + value_of(o) + ")";
  if (!o.excludes.empty()) out += "; not beside " + joined(o.excludes, ", ", bold);
  if (o.required) out += "; must be given";
  return out + "\n";
}

std::string options(const CommandText& command) {
  std::string out;
  for (const OptionText& o : command.options) out += option(o);
  return out;
}

std::string notes(const CommandText& command) {
  if (command.notes.empty()) return {};
  return ".SH NOTES\n.nf\n" + plain(command.notes) + "\n.fi\n";
}

std::string page_name(const CommandText& capstan, const CommandText* command) {
  return command == nullptr ? capstan.name : capstan.name + "-" + command->name;
}

std::string page(const CommandText& capstan, const CommandText* of, const std::string& version) {
  const CommandText& command = of == nullptr ? capstan : *of;
  const std::string name = page_name(capstan, of);
  const std::string called = of == nullptr ? capstan.name : capstan.name + " " + of->name;
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string out = ".\\\" Generated from the options of the command.\n.TH \"" + plain(title) +
                    "\" 1 \"\" \"capstan " + plain(version) + "\" \"User Commands\"\n.SH NAME\n" +
                    plain(name) + " \\- " + plain(command.help) + "\n.SH SYNOPSIS\n" +
                    synopsis(called, command);
  if (!command.commands.empty()) {
    out += ".SH COMMANDS\n";
    for (const CommandText& sub : command.commands) {
      if (of == nullptr) {
        out += ".TP\n.BR " + plain(page_name(capstan, &sub)) + " (1)\n" + plain(sub.help) + "\n";
      } else {
        out += ".SS " + plain(called + " " + sub.name) + "\n" + plain(sub.help) + ".\n.PP\n" +
               synopsis(called + " " + sub.name, sub) + options(sub);
      }
    }
  }
  out += ".SH OPTIONS\n";
  out += of == nullptr ? "Each command takes these, too.\n"
                       : "Beside those of every command, see\n.BR " + plain(capstan.name) + " (1).\n";
  out += options(command) + notes(command) + ".SH \"EXIT STATUS\"\n";
  for (const ExitText& exit : kExitTexts)
    out += ".TP\n" + bold(std::to_string(exit.code)) + "\n" + plain(exit.meaning) + "\n";
  out += ".SH \"SEE ALSO\"\n";
  std::vector<const CommandText*> others;
  if (of != nullptr) others.push_back(nullptr);
  for (const CommandText& other : capstan.commands) {
    if (&other != of) others.push_back(&other);
  }
  for (const CommandText* other : others) {
    out += ".BR " + plain(page_name(capstan, other)) + " (1)" + (other == others.back() ? "\n" : ",\n");
  }
  return out;
}

bool is_long(const std::string& name) { return name.starts_with("--"); }

/// A command's arms of the script's three questions.
struct Arms {
  std::string commands, values, words;
};

void gather(const CommandText& command, const std::string& path, std::vector<std::string> words, Arms& into) {
  // `path` is the command so far, "tools list"; that of `capstan` itself is empty. `words` are the long names
  // of the options above, which serve here, too.
  for (const OptionText& o : command.options) {
    if (o.positional) continue;
    for (const std::string& name : o.names) {
      if (is_long(name) && std::find(words.begin(), words.end(), name) == words.end()) words.push_back(name);
      if (o.value.empty()) continue;
      // Without a list of values, files are completed.
      into.values += (path.empty() ? "    *" : "    ") + ("'" + path + " " + name) + "') values='" +
                     joined(o.choices, " ", std::identity{}) + "' valued=1 ;;\n";
    }
  }
  std::string below;
  for (const CommandText& sub : command.commands) {
    below += (below.empty() ? "" : " ") + sub.name;
    into.commands += "      '" + path + " " + sub.name + "') command='" + (path.empty() ? "" : path + " ") +
                     sub.name + "' ;;\n";
  }
  into.words +=
      "    '" + path + "') options='" + joined(words, " ", std::identity{}) + "' below='" + below + "' ;;\n";
  for (const CommandText& sub : command.commands)
    gather(sub, path.empty() ? sub.name : path + " " + sub.name, words, into);
}

}  // namespace

std::vector<ManualPage> manual_pages(const CommandText& capstan, const std::string& version) {
  std::vector<ManualPage> out{{page_name(capstan, nullptr) + ".1", page(capstan, nullptr, version)}};
  for (const CommandText& command : capstan.commands)
    out.push_back({page_name(capstan, &command) + ".1", page(capstan, &command, version)});
  return out;
}

std::string bash_completion(const CommandText& capstan) {
  Arms arms;
  gather(capstan, "", {}, arms);
  return "# Completes the command line of capstan in bash; generated from the options of the command.\n"
         "_capstan() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
         "  local command='' values='' valued='' options='' below='' i\n"
         "  # bash takes --option=value for three words.\n"
         "  if [[ $current == '=' ]]; then\n"
         "    current=''\n"
         "  elif [[ $previous == '=' ]]; then\n"
         "    previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
         "  fi\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case \"$command ${COMP_WORDS[i]}\" in\n" +
         arms.commands +
         "    esac\n"
         "  done\n"
         "  case \"$command $previous\" in\n" +
         arms.values +
         "  esac\n"
         "  case $command in\n" +
         arms.words +
         "  esac\n"
         "  COMPREPLY=()\n"
         "  if [[ -n $valued ]]; then\n"
         "    options=$values\n"
         "  elif [[ $current != -* ]]; then\n"
         "    options=$below\n"
         "  fi\n"
         "  # Nothing here leaves the word to the completion of file names.\n"
         "  [[ -z $options ]] || mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _capstan " +
         capstan.name + "\n";
}

}  // namespace capstan::app
