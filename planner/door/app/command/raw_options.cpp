#include "planner/door/app/command/raw_options.h"

#include "planner/door/service/options.h"
#include "planner/making/optimise/solver/solvers.h"

namespace capstan::app {

std::string understand(const RawOptions& raw, Options& out) {
  if (!raw.file.empty()) out.files = {raw.file};
  service::Request& request = out.inputs;
  const auto take = [&](const service::Option& o, const std::string& text) -> std::string {
    if (auto ok = service::set(request, o.name, text); !ok) return ok.error().message;
    if (out.command == Command::kServe) out.serve.session.emplace_back(o.name, text);
    return {};
  };
  for (const service::Option& o : service::options()) {
    if (const auto list = raw.lists.find(o.name); list != raw.lists.end()) {
      for (const std::string& text : list->second) {
        if (std::string wrong = take(o, text); !wrong.empty()) return wrong;
      }
      continue;
    }
    std::string text;
    if (const auto flag = raw.flags.find(o.name); flag != raw.flags.end() && flag->second) text = "yes";
    if (const auto at = raw.of.find(o.name); at != raw.of.end()) text = at->second;
    if (text.empty()) continue;
    if (std::string wrong = take(o, text); !wrong.empty()) return wrong;
  }
  if (std::string wrong = service::contradiction(request); !wrong.empty()) return wrong;
  request.backends = optimise::all_backends();
  out.json_diagnostics = raw.diagnostics == "json";
  out.progress = raw.progress == "json"   ? ProgressForm::kJson
                 : raw.progress == "none" ? ProgressForm::kNone
                                          : ProgressForm::kAuto;
  return {};
}

}  // namespace capstan::app
