#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "capstan/capstan.h"

// The public library as a module of Python, `capstan._capstan`; the package around it (capstan/__init__.py)
// is what people import. A call works in a thread of its own while the calling one waits for it and looks at
// Python's signals, so that Ctrl-C ends it as it ends the command (pybind11's documentation, "How can I
// properly handle Ctrl-C in long-running functions?").

namespace py = pybind11;

namespace capstan {
namespace {

/// How often the calling thread looks at Python's signals: well below what a person takes for at once.
constexpr std::chrono::milliseconds kLook(20);

/// Runs `work` with the options' progress and stop tied to Python's. Throws  what `work` and the caller's
/// `progress` throw; KeyboardInterrupt, or what else a handler of a signal raises, when `work` has ended.
template <typename Work>
auto watched(PlanOptions options, const py::object& progress, Work work) {
  std::stop_source stop;
  options.stop = stop.get_token();
  std::optional<py::error_already_set> raised;  // written with Python's lock held
  if (!progress.is_none()) {
    options.progress = [&](std::string_view stage, double fraction) {
      const py::gil_scoped_acquire lock;
      if (raised) return;
      try {
        progress(py::str(stage.data(), stage.size()), fraction);
      } catch (py::error_already_set& e) {
        raised.emplace(std::move(e));
        stop.request_stop();
      }
    };
  }
  auto done = [&] {
    const py::gil_scoped_release unlocked;
    auto running = std::async(std::launch::async, [&] { return work(options); });
    while (running.wait_for(kLook) != std::future_status::ready) {
      const py::gil_scoped_acquire lock;
      if (!raised && PyErr_CheckSignals() != 0) {
        raised.emplace();
        stop.request_stop();
      }
    }
    return running.get();
  }();
  if (raised) throw std::move(*raised);
  return done;
}

/// Texts of a plan are UTF-8 but where a file's own bytes are not: these are kept as Python keeps file names.
py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "surrogateescape"));
}
std::string bytes_of(const py::bytes& b) { return static_cast<std::string>(b); }

py::dict forms_of(const PlanOutput& out) {
  py::dict forms;
  for (const auto& [name, form] : out.forms) forms[text(name)] = py::bytes(form);
  return forms;
}

void bind_options(py::module_& m) {
  py::class_<PlanOptions> options(m, "PlanOptions");
  options.def(py::init<>());
#define CAPSTAN_FIELD(name) options.def_readwrite(#name, &PlanOptions::name)
  CAPSTAN_FIELD(machine);
  CAPSTAN_FIELD(tools);
  CAPSTAN_FIELD(material);
  CAPSTAN_FIELD(rules);
  CAPSTAN_FIELD(objective);
  CAPSTAN_FIELD(feeds);
  CAPSTAN_FIELD(reopen);
  CAPSTAN_FIELD(stock_allowance_mm);
  CAPSTAN_FIELD(revenue);
  CAPSTAN_FIELD(threads);
  CAPSTAN_FIELD(allow_findings);
  CAPSTAN_FIELD(margin);
  CAPSTAN_FIELD(cases);
  CAPSTAN_FIELD(stock);
  CAPSTAN_FIELD(solver);
  CAPSTAN_FIELD(workholding);
  CAPSTAN_FIELD(general_tolerance);
  CAPSTAN_FIELD(assume);
  CAPSTAN_FIELD(batch);
  CAPSTAN_FIELD(edge_break_mm);
  CAPSTAN_FIELD(bind);
  CAPSTAN_FIELD(deadline);
  CAPSTAN_FIELD(strict);
  CAPSTAN_FIELD(profile);
  CAPSTAN_FIELD(schema);
  CAPSTAN_FIELD(cache);
  CAPSTAN_FIELD(may);
  CAPSTAN_FIELD(mesh_unit);
  CAPSTAN_FIELD(time);
  CAPSTAN_FIELD(control);
  CAPSTAN_FIELD(next);
  CAPSTAN_FIELD(stop_at_deadline);
  CAPSTAN_FIELD(measured);
  CAPSTAN_FIELD(set);
  CAPSTAN_FIELD(pin);
  CAPSTAN_FIELD(limit);
  CAPSTAN_FIELD(forbid);
  CAPSTAN_FIELD(order);
  CAPSTAN_FIELD(edits);
  CAPSTAN_FIELD(spindle_power_kw);
  CAPSTAN_FIELD(feed_override);
  CAPSTAN_FIELD(shop);
  CAPSTAN_FIELD(without);
  CAPSTAN_FIELD(tapped);
  CAPSTAN_FIELD(draw);
  CAPSTAN_FIELD(body);
  CAPSTAN_FIELD(features_only);
  CAPSTAN_FIELD(axis_limits);
  CAPSTAN_FIELD(work_offset);
  CAPSTAN_FIELD(tool_state);
#undef CAPSTAN_FIELD
  options.def_readwrite("from_", &PlanOptions::from);  // `from` is a word of the language
}

void bind_results(py::module_& m) {
  py::class_<PlanMessage>(m, "Message", "A thing said about the input or the plan, as the command prints it.")
      .def_property_readonly(
          "severity", [](const PlanMessage& x) { return text(x.severity); }, "'note', 'warning' or 'error'")
      .def_property_readonly("code", [](const PlanMessage& x) { return text(x.code); })
      .def_property_readonly("text", [](const PlanMessage& x) { return text(x.text); })
      .def("__str__", [](const PlanMessage& x) { return text(x.text); })
      .def("__repr__", [](const PlanMessage& x) { return text("<" + x.code + ": " + x.text + ">"); });
  py::class_<PlanOutput>(m, "PlanOutput")
      .def_readonly("planned", &PlanOutput::planned)
      .def_readonly("steps", &PlanOutput::steps)
      .def_readonly("unplanned", &PlanOutput::unplanned)
      .def_readonly("time_s", &PlanOutput::time_s)
      .def_readonly("late", &PlanOutput::late)
      .def_readonly("diagnostics", &PlanOutput::diagnostics)
      .def_readonly("findings", &PlanOutput::findings)
      .def_readonly("condemned", &PlanOutput::condemned)
      .def_property_readonly("forms", &forms_of);
  py::class_<CheckOutput>(m, "CheckOutput")
      .def_readonly("checked", &CheckOutput::checked)
      .def_readonly("clean", &CheckOutput::clean)
      .def_readonly("findings", &CheckOutput::findings)
      .def_readonly("diagnostics", &CheckOutput::diagnostics);
  py::class_<ExplainOutput>(m, "ExplainOutput")
      .def_readonly("explained", &ExplainOutput::explained)
      .def_property_readonly("text", [](const ExplainOutput& x) { return text(x.text); })
      .def_readonly("diagnostics", &ExplainOutput::diagnostics);
}

void bind_calls(py::module_& m) {
  m.def("version", &version);
  m.def("option_names", &option_names);
  m.def("plan_file", [](const std::string& path, const PlanOptions& o, const py::object& progress) {
    return watched(o, progress, [&](const PlanOptions& with) { return plan_file(path, with); });
  });
  m.def("plan_bytes",
        [](const py::bytes& part, const std::string& name, const PlanOptions& o, const py::object& progress) {
          return watched(o, progress, [given = bytes_of(part), &name](const PlanOptions& with) {
            return plan_bytes(given, name, with);
          });
        });
  m.def("bind_file", [](const std::string& path, const PlanOptions& o, const py::object& progress) {
    return watched(o, progress, [&](const PlanOptions& with) { return bind_file(path, with); });
  });
  m.def("bind_bytes",
        [](const py::bytes& plan, const std::string& name, const PlanOptions& o, const py::object& progress) {
          return watched(o, progress, [given = bytes_of(plan), &name](const PlanOptions& with) {
            return bind_bytes(given, name, with);
          });
        });
  m.def("check_files",
        [](const std::vector<std::string>& paths, const PlanOptions& o, const py::object& progress) {
          return watched(o, progress, [&](const PlanOptions& with) { return check_files(paths, with); });
        });
  m.def("check_bytes", [](const std::vector<std::pair<std::string, py::bytes>>& files, const PlanOptions& o,
                          const py::object& progress) {
    std::vector<CheckInput> given;
    for (const auto& [name, content] : files) given.push_back({name, bytes_of(content)});
    return watched(o, progress, [&](const PlanOptions& with) { return check_bytes(given, with); });
  });
  m.def("explain_bytes", [](const py::bytes& plan, const std::string& name, const std::string& step,
                            const std::string& attribute) {
    const std::string given = bytes_of(plan);
    const py::gil_scoped_release unlocked;
    return explain_bytes(given, name, step, attribute);
  });
}

}  // namespace
}  // namespace capstan

PYBIND11_MODULE(_capstan, m) {
  capstan::bind_options(m);
  capstan::bind_results(m);
  capstan::bind_calls(m);
}
