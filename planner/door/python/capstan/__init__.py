"""Capstan from Python: plan, bind, check, explain and edit process plans of STEP-NC and CAD parts.

    plan = capstan.plan("bracket.p21", machine="generic_vmc", set=["POCKET*/tool=T5"])
    plan.steps, plan.time_s, plan.path(1).xyz, plan.program, plan.explain(), plan.check()

Options are the fields of PlanOptions in include/capstan/capstan.h, by name. Lengths are mm, in the frame of the
step's set-up; feeds mm/min; times s. Ctrl-C ends a call.
"""

import difflib
import functools
import json
import os
import threading

from . import _capstan
from ._capstan import Message
from .paths import Path

__all__ = ["Checked", "Error", "Message", "Path", "Plan", "bind", "check", "explain", "plan", "version"]

version = _capstan.version

# A word of the language is taken with a line below, as the language's own style has it.
_OPTIONS = sorted(name for name in dir(_capstan.PlanOptions) if not name.startswith("__"))


class Error(Exception):
    """There is no plan, no check or no explanation. `diagnostics` are all messages; the text is the errors'."""

    def __init__(self, diagnostics):
        errors = [m.text for m in diagnostics if m.severity == "error"]
        super().__init__("\n".join(errors or [m.text for m in diagnostics]) or "the call was stopped")
        self.diagnostics = diagnostics


def _options(given):
    """PlanOptions of keyword arguments. TypeError for a name or a type that is none of theirs."""
    options = _capstan.PlanOptions()
    for name, value in given.items():
        if name not in _OPTIONS:
            near = difflib.get_close_matches(name, _OPTIONS, 1)
            raise TypeError(f"'{name}' is no option; " +
                            (f"did you mean '{near[0]}'?" if near else "options are " + ", ".join(_OPTIONS)))
        if isinstance(value, os.PathLike):
            value = os.fspath(value)
        try:
            setattr(options, name, value)
        except TypeError:
            wanted = type(getattr(options, name)).__name__
            raise TypeError(f"option '{name}' is a {wanted}, not {value!r}") from None
    return options


def _content(plan):
    """The bytes of a plan and what messages call it: of a Plan, of bytes or of a file."""
    if isinstance(plan, Plan):
        return plan.forms["json"], plan.name
    if isinstance(plan, (bytes, bytearray)):
        return bytes(plan), "plan"
    with open(plan, "rb") as file:
        return file.read(), os.fspath(plan)


def _counted(messages):
    errors = sum(m.severity == "error" for m in messages)
    return f"{errors} errors, {len(messages) - errors} warnings and notes"


class Plan:
    """A plan in each of its forms, and what was said of it."""

    def __init__(self, output, name):
        if not output.planned:
            raise Error(output.diagnostics)
        self.name = name
        self.forms = output.forms  # bytes by the name of the form: "json", "iso14649", "ap238", "linuxcnc", ...
        self.time_s = output.time_s  # of the whole program; 0 where something is open
        self.unplanned = output.unplanned  # how many features are not planned; `diagnostics` says why
        self.late = output.late  # of bind: the deadline was past
        self.diagnostics = output.diagnostics
        self.findings = output.findings  # of checking plan and program; errors condemn them
        self.condemned = output.condemned  # why there is no program, or why it stops

    def __repr__(self):
        return f"<Plan of {self.name}: {len(self.steps)} steps, {self.time_s:.1f} s, {_counted(self.findings)}>"

    @functools.cached_property
    def data(self):
        """All of the plan, as docs/plan.schema.json describes it."""
        return json.loads(self.forms["json"])

    @property
    def steps(self):
        """The workingsteps in the order of execution: dicts with id, feature, operation, tool_number, feeds, times."""
        return self.data["steps"]

    @property
    def control(self):
        """The control that the program is for: "linuxcnc", "siemens", ..."""
        return self.data["machine"]["control"]["dialect"]

    @property
    def program(self):
        """The program of the machine's control, bytes; None where the check condemns it or something is open."""
        return self.forms.get(self.control)

    def step(self, step):
        """The step of that id, or of that number in the order of execution, from 1. KeyError: there is none.
        ValueError: decisions are open, and no step is made yet."""
        if not self.steps:
            raise ValueError("the plan has no steps, for its decisions are open; bind it first (Plan.bind)")
        if isinstance(step, int) and 1 <= step <= len(self.steps):
            return self.steps[step - 1]
        for s in self.steps:
            if s["id"] == step:
                return s
        raise KeyError(f"no step {step!r}; steps are " + ", ".join(s["id"] for s in self.steps))

    def path(self, step):
        """The path of a step (see `step`) as arrays: a Path. ValueError: the step is not bound and has no path."""
        s = self.step(step)
        if not s.get("path"):
            raise ValueError(f"step '{s['id']}' has no path, for its decisions are open; bind the plan first (Plan.bind)")
        return Path.of(self.data["paths"][_row(s["path"])],
                       self.data["schedules"][_row(s["schedule"])] if s.get("schedule") else None)

    def _form_of(self, path):
        ending = os.path.splitext(path)[1].lower()
        known = {".json": "json", ".p21": "iso14649", ".stp": "iso14649", ".stpnc": "ap238", ".238": "ap238",
                 ".tbl": "linuxcnc_tools", ".html": "report", ".svg": "svg", ".png": "png",
                 **{e: self.control for e in (".ngc", ".nc", ".mpf", ".h", ".gcode")}}
        if ending not in known:
            raise ValueError(f"the ending of '{path}' names no form; give form=..., one of " +
                             ", ".join(sorted(self.forms)))
        return known[ending]

    def explain(self, step="", attribute=""):
        """Why each value is what it is: of the whole plan, of a step (id or number), of one of its attributes."""
        return explain(self, step, attribute)

    def check(self, **options):
        """Plan and program checked anew: Checked."""
        files = [(self.name + " (plan)", self.forms["json"])]
        if self.program is not None:
            files.append((self.name + " (program)", self.program))
        for form, content in sorted(self.forms.items()):
            if form == self.control + "_tools":
                files.append((self.name + " (tool table)", content))
        return Checked(_capstan.check_bytes(files, _options(options), None))

    def edited(self, *, progress=None, **options):
        """The plan after a person's decisions (set, pin, limit, forbid, order): what depends on them is planned anew."""
        return plan(self.forms["json"], name=self.name, progress=progress, **options)

    def bind(self, *, progress=None, **options):
        """What is open, or no longer holds, closed with the tools of `tools`: Plan."""
        return bind(self, progress=progress, **options)

    def write(self, path, form=None):
        """Writes a form, whole or not at all; without `form` the one that the file's ending names (of a program's
        ending that of the plan's control). ValueError: the ending names none, or the file is the part itself. KeyError: the plan has no such form."""
        path = os.fspath(path)
        if form is None:
            form = self._form_of(path)
        if form not in self.forms:
            raise KeyError(f"no form {form!r}; the plan has " + ", ".join(sorted(self.forms)) +
                           ("" if self.program is not None else "; it has no program, see condemned"))
        if os.path.exists(path) and os.path.exists(self.name) and os.path.samefile(path, self.name):
            raise ValueError(f"'{path}' is the part that was planned; name another file")
        folder = os.path.dirname(os.path.abspath(path))
        part = os.path.join(folder, f".capstan-{os.getpid()}-{threading.get_ident()}")
        handle = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(self.forms[form])
                file.flush()
                os.fsync(file.fileno())
            os.replace(part, path)
        except BaseException:
            os.unlink(part)
            raise


class Checked:
    """What a check came to. `clean`: no finding that condemns plan or program, and nothing unplanned."""

    def __init__(self, output):
        if not output.checked:
            raise Error(output.diagnostics)
        self.clean = output.clean
        self.findings = output.findings
        self.diagnostics = output.diagnostics

    def __repr__(self):
        return f"<Checked: {'clean' if self.clean else 'not clean'}, {_counted(self.findings)}>"


def _row(reference):
    """The row that 'path:3' names, from 0."""
    return int(reference.rpartition(":")[2]) - 1


def plan(part, *, name="part", progress=None, **options):
    """Plans a part: a STEP-NC or CAD file, an STL mesh, a plan, by path, or its content as bytes (then `name` is what
    messages call it). `progress(stage, fraction)` is called along the way. Error: there is no plan."""
    given = _options(options)
    if isinstance(part, (bytes, bytearray)):
        return Plan(_capstan.plan_bytes(bytes(part), name, given, progress), name)
    return Plan(_capstan.plan_file(os.fspath(part), given, progress), os.fspath(part))


def bind(plan, *, progress=None, **options):  # pylint: disable=redefined-outer-name
    """Closes at the machine what a plan (a Plan, bytes or a path) leaves open. Error: there is no plan to run."""
    content, name = _content(plan)
    return Plan(_capstan.bind_bytes(content, name, _options(options), progress), name)


def check(*files, progress=None, **options):
    """Proves plans and programs safe, by path, or says what is wrong with them: Checked. Error: nothing could be
    checked."""
    return Checked(_capstan.check_files([os.fspath(f) for f in files], _options(options), progress))


def explain(plan, step="", attribute=""):  # pylint: disable=redefined-outer-name
    """Why each value of a plan (a Plan, bytes or a path) is what it is, as text."""
    content, name = _content(plan)
    out = _capstan.explain_bytes(content, name, str(step), attribute)
    if not out.explained:
        raise Error(out.diagnostics)
    return out.text
