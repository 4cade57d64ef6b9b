#!/usr/bin/env python3
"""What `cmake --install --strip` lays down: each file, what the libraries export, that programs find and link them,
and that manual pages and completion say what the command's own --help says."""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

GIVEN = None  # the arguments


def run(*command, **more):
    """Standard output; a command that fails is a failure of the test, with what it said."""
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def in_prefix(*parts):
    return os.path.join(GIVEN.scratch, "prefix", *parts)


def library(name):
    return in_prefix(GIVEN.libdir, f"lib{name}.so")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def setUpModule():
    shutil.rmtree(GIVEN.scratch, ignore_errors=True)
    run(GIVEN.cmake, "--install", GIVEN.built, "--prefix", in_prefix(), "--strip")


class Tree(unittest.TestCase):
    def test_holds_the_files_of_the_list_and_no_other(self):
        there = set()
        for folder, _, names in os.walk(in_prefix()):
            there |= {os.path.relpath(os.path.join(folder, name), in_prefix()) for name in names}
        lines = read(os.path.join(GIVEN.source, "tests/install/files.txt"))
        for key, value in {"LIBDIR": GIVEN.libdir, "VERSION": GIVEN.version,
                           "MINOR": GIVEN.version.rpartition(".")[0],
                           "BREP": f"{GIVEN.libexecdir}/capstan/capstan-brep" if GIVEN.brep else "",
                           "POSTGRES": f"{GIVEN.libexecdir}/capstan/capstan-postgres.so" if GIVEN.postgres
                           else "",
                           "PYTHON": f"{GIVEN.python}/capstan/**" if GIVEN.python else ""}.items():
            lines = lines.replace(f"@{key}@", value)
        wanted = {line for line in lines.split("\n") if line and not line.startswith("#")}
        below = {line[:-2] for line in wanted if line.endswith("/**")}
        wanted -= {line + "**" for line in below}
        for folder in below:
            inside = {path for path in there if path.startswith(folder)}
            self.assertTrue(inside, f"{folder} is empty")
            there -= inside
        self.assertEqual(sorted(there), sorted(wanted))

    def test_is_stripped_and_looks_for_libraries_nowhere_else(self):
        for path in (in_prefix("bin/capstan"), library("capstan"), library("capstan_late")):
            sections = run("readelf", "--wide", "--section-headers", path)
            self.assertNotRegex(sections, r"\.symtab|\.debug", path)
            self.assertNotRegex(run("readelf", "--wide", "--dynamic", path), r"\(R(UN)?PATH\)", path)

    def test_needs_neither_mpi_nor_hdf5(self):
        for path in (in_prefix("bin/capstan"), library("capstan"), library("capstan_late")):
            self.assertNotRegex(run("readelf", "--wide", "--dynamic", path), r"NEEDED.*\[lib(mpi|hdf5|flann)", path)

    def test_holds_a_schema_that_is_json(self):
        self.assertIn("$schema", json.loads(read(in_prefix("share/capstan/plan.schema.json"))))


class Exports(unittest.TestCase):
    """What the dynamic linker sees is what the header marks, and the reverse."""

    def exported(self, name):
        lines = run("nm", "--dynamic", "--defined-only", "--demangle", library(name)).splitlines()
        return sorted(re.sub(r"\[abi:\w+\]", "", line.split(" ", 2)[2]).partition("(")[0] for line in lines)

    def marked(self, header, mark):
        text = re.sub(r"#define.*", "", read(in_prefix("include/capstan", header)))
        return sorted(re.findall(mark + r"\s[^;(]*?(\w+)\(", text))

    def test_of_the_library_are_its_header_and_nothing_else(self):
        marked = self.marked("capstan.h", "CAPSTAN_API")
        self.assertIn("plan_file", marked)
        self.assertEqual(self.exported("capstan"), ["capstan::" + name for name in marked])

    def test_of_late_binding_are_its_header_and_nothing_else(self):
        marked = self.marked("capstan_late.h", "CAPSTAN_LATE_API")
        self.assertIn("capstan_late_bind", marked)
        self.assertEqual(self.exported("capstan_late"), marked)


class Consumer(unittest.TestCase):
    SOURCE = property(lambda self: os.path.join(GIVEN.source, "tests/install/consumer"))
    UNREADABLE = "3"  # CAPSTAN_LATE_UNREADABLE

    def test_is_served_by_find_package(self):
        build = os.path.join(GIVEN.scratch, "build")
        run(GIVEN.cmake, "-S", self.SOURCE, "-B", build, "-G", GIVEN.generator, f"-DCMAKE_CXX_COMPILER={GIVEN.cxx}",
            f"-DCMAKE_C_COMPILER={GIVEN.cc}", f"-DCMAKE_PREFIX_PATH={in_prefix()}",
            "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF", f"-DWANTED={GIVEN.version}")
        run(GIVEN.cmake, "--build", build)
        self.assertEqual(run(os.path.join(build, "consumer")).strip(), GIVEN.version)
        self.assertEqual(run(os.path.join(build, "late_consumer")).strip(), self.UNREADABLE)

    def test_is_served_by_pkg_config(self):
        found = dict(os.environ, PKG_CONFIG_PATH=in_prefix(GIVEN.libdir, "pkgconfig"))
        linked = dict(os.environ, LD_LIBRARY_PATH=in_prefix(GIVEN.libdir))
        for package, compiler, source, says in (
                ("capstan", (GIVEN.cxx, "-std=c++20"), "consumer.cpp", GIVEN.version),  # capstan.h is C++20
                ("capstan_late", (GIVEN.cc,), "late_consumer.c", self.UNREADABLE)):
            self.assertEqual(run("pkg-config", "--modversion", package, env=found).strip(), GIVEN.version)
            flags = run("pkg-config", "--cflags", "--libs", package, env=found).split()
            program = os.path.join(GIVEN.scratch, package + "_by_pkg_config")
            run(*compiler, os.path.join(self.SOURCE, source), "-o", program, *flags)
            self.assertEqual(run(program, env=linked).strip(), says)


class OpenedFiles(unittest.TestCase):
    """What the library opens and runs is found from where the library is installed."""

    # Nobody is there: what is said tells whether that was found out, or could not be asked.
    CASES = "postgresql://nobody@/none?host=/nonexistent"

    def said(self, part, cases):
        program = os.path.join(GIVEN.scratch, "alone", "bin", "opens")  # with nothing of Capstan's beside it
        if not os.path.exists(program):
            os.makedirs(os.path.dirname(program))
            run(GIVEN.cxx, "-std=c++20", os.path.join(GIVEN.source, "tests/install/consumer/opens.cpp"), "-o", program,
                "-I", in_prefix("include"), "-L", in_prefix(GIVEN.libdir), "-lcapstan")
        alone = {name: value for name, value in os.environ.items() if name != "CAPSTAN_BREP"}
        alone.update(LD_LIBRARY_PATH=in_prefix(GIVEN.libdir), CAPSTAN_CASES=os.path.join(GIVEN.scratch, "cases"))
        return run(program, os.path.join(GIVEN.source, "examples", part), cases, env=alone)

    def said_with_and_without(self, file, *asked):
        there = in_prefix(GIVEN.libexecdir, "capstan", file)
        found = self.said(*asked)
        os.rename(there, there + ".away")
        try:
            missed = self.said(*asked)
        finally:
            os.rename(there + ".away", there)
        self.assertIn(os.path.realpath(there), missed)
        return found, missed

    def test_the_library_for_servers_is(self):
        if not GIVEN.postgres:
            self.skipTest("built without PostgreSQL")
        found, missed = self.said_with_and_without("capstan-postgres.so", "bracket.p21", self.CASES)
        self.assertIn("CASE-OPEN", found)
        self.assertIn("CASE-LIBRARY", missed)

    def test_the_program_for_shapes_is(self):
        if not GIVEN.brep:
            self.skipTest("built without OpenCASCADE")
        found, missed = self.said_with_and_without("capstan-brep", "cover.step", "")
        self.assertNotIn("BREP-HELPER", found)
        self.assertIn("BREP-HELPER", missed)

    def test_are_where_the_build_was_told_also_from_folders_below_lib(self):
        script = os.path.join(GIVEN.scratch, "libexec.cmake")
        for libdir, libexecdir, way in (("lib", "libexec", "../libexec/capstan"),
                                        ("lib/x86_64-linux-gnu", "libexec", "../../libexec/capstan"),
                                        ("lib64", "lib/helpers", "../lib/helpers/capstan"),
                                        ("lib", "/opt/libexec", "/opt/libexec/capstan")):
            with open(script, "w", encoding="utf-8") as file:
                file.write(f"include({GIVEN.source}/cmake/LibexecPath.cmake)\n"
                           f"set(CMAKE_INSTALL_LIBEXECDIR {libexecdir})\n"
                           f"set(CMAKE_INSTALL_FULL_LIBEXECDIR {os.path.join('/usr', libexecdir)})\n"
                           f"capstan_libexec_from(way /usr/{libdir})\nmessage(STATUS ${{way}})\n")
            self.assertEqual(run(GIVEN.cmake, "-P", script).split()[-1], way)


class ModuleOfPython(unittest.TestCase):
    def test_plans_from_where_it_is_installed_also_when_that_was_moved(self):
        if not GIVEN.python:
            self.skipTest("built without pybind11")
        program = ("import capstan, sys\nprint(capstan.version(), capstan.__file__)\n"
                   "print(len(capstan.plan(sys.argv[1]).path(1).xyz) > 0)\n")
        moved = os.path.join(GIVEN.scratch, "moved")
        alone = {name: value for name, value in os.environ.items() if name not in ("LD_LIBRARY_PATH", "CAPSTAN_BREP")}
        shutil.rmtree(moved, ignore_errors=True)
        shutil.copytree(in_prefix(), moved, symlinks=True)
        for prefix in (in_prefix(), moved):
            folder = os.path.join(prefix, GIVEN.python)
            said = run(GIVEN.interpreter, "-B", "-c", program, os.path.join(GIVEN.source, "examples/reference_pocket.p21"),
                       env=dict(alone, PYTHONPATH=folder))
            self.assertEqual(said.split(), [GIVEN.version, os.path.join(folder, "capstan/__init__.py"), "True"])


class Identity(unittest.TestCase):
    """What capstan-postgres.so and who opens it are held together by."""

    def identity(self, version="1.2.3", **headers):
        root = os.path.join(GIVEN.scratch, "identity")
        os.makedirs(root, exist_ok=True)
        files = {"door.h": '#pragma once\n\n#include <string>\n\n#include "inner.h"\n', "inner.h": "struct A {};\n"}
        files.update({name + ".h": text for name, text in headers.items()})
        for name, text in files.items():
            with open(os.path.join(root, name), "w", encoding="utf-8") as file:
                file.write(text)
        script = os.path.join(root, "identity.cmake")
        with open(script, "w", encoding="utf-8") as file:
            file.write(f"cmake_minimum_required(VERSION 3.25)\nset(CMAKE_SOURCE_DIR {root})\n"
                       f"set(PROJECT_VERSION {version})\ninclude({GIVEN.source}/cmake/BuildIdentity.cmake)\n"
                       "capstan_build_identity(it door.h)\nmessage(STATUS ${it})\n")
        return run(GIVEN.cmake, "-P", script).split()[-1]

    def test_is_of_the_version_and_of_all_headers_between(self):
        first = self.identity()
        self.assertRegex(first, r"^1\.2\.3-[0-9a-f]{16}$")
        self.assertEqual(self.identity(), first)
        self.assertNotEqual(self.identity(inner="struct A { int more; };\n"), first)
        self.assertNotEqual(self.identity(door='#include "inner.h"\n'), first)
        self.assertEqual(self.identity(version="1.2.4"), first.replace("1.2.3", "1.2.4"))

    def test_of_what_is_installed_is_the_same_in_all_that_hold_it(self):
        if not GIVEN.postgres:
            self.skipTest("built without PostgreSQL")
        found = set()
        for path in (in_prefix("bin/capstan"), library("capstan"),
                     in_prefix(GIVEN.libexecdir, "capstan", "capstan-postgres.so")):
            with open(path, "rb") as file:
                stated = set(re.findall(rb"%s-[0-9a-f]{16}(?![0-9a-f])" % re.escape(GIVEN.version.encode()), file.read()))
            self.assertEqual(len(stated), 1, path)
            found |= stated
        self.assertEqual(len(found), 1)


class Manual(unittest.TestCase):
    """The pages and the completion are generated; --help is the other way from the same options to a reader."""

    @staticmethod
    def help_of(*command):
        """Commands below, and option -> its values, as --help lists them."""
        text = run(in_prefix("bin/capstan"), *command, "--help")
        below = re.search(r"^Subcommands:\n((?:  .*\n?)+)", text, re.M)
        commands = re.findall(r"^  (\w+)  ", below[1], re.M) if below else []
        options = {}
        for name, rest in re.findall(r"^  (?:-\w,)?(--[\w-]+)(.*)", text, re.M):
            values = re.search(r"\{([^}]*)\}", rest)
            options[name] = values[1].split(",") if values else []
        return commands, options, "-o,--output" in text

    def every_command(self):
        """(words, options) of each command; a page for each first word."""
        first, options, _ = self.help_of()
        yield [], options
        for name in first:
            below, options, _ = self.help_of(name)
            yield [name], options
            for sub in below:
                yield [name, sub], self.help_of(name, sub)[1]

    @staticmethod
    def page(command):
        text = read(in_prefix("share/man/man1", "-".join(["capstan"] + command[:1]) + ".1"))
        return text.replace("\\-", "-")

    def complete(self, *words):
        script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _capstan; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        return run("bash", "-c", script, "bash", in_prefix("share/bash-completion/completions/capstan"),
                   "capstan", *words).split()

    def test_says_of_each_command_every_option_and_value_of_its_help(self):
        seen = 0
        for command, options in self.every_command():
            page = self.page(command)
            if len(command) == 2:  # a section of its parent's page
                page = page.partition(f".SS capstan {' '.join(command)}\n")[2].partition("\n.S")[0]
            for option, values in options.items():
                if option == "--help" or command and option in ("--diagnostics", "--threads", "--version"):
                    continue
                seen += 1
                self.assertIn(f"\\fB{option}\\fR", page, command)
                for value in values:
                    self.assertIn(f"\\fB{value}\\fR", page, (command, option))
        self.assertGreater(seen, 60)

    def test_names_every_exit_status_of_the_readme(self):
        table = read(in_prefix("share/doc/capstan/README.md")).partition("## Exit status")[2].partition("\n## ")[0]
        wanted = re.findall(r"^\| (\d+) \|", table, re.M)
        status = self.page([]).partition('.SH "EXIT STATUS"')[2]
        self.assertEqual(re.findall(r"^\\fB(\d+)\\fR$", status, re.M), wanted)

    def test_is_set_without_a_complaint(self):
        if shutil.which("groff") is None:
            self.skipTest("groff is not there (Debian: groff-base)")
        pages = in_prefix("share/man/man1")
        for name in sorted(os.listdir(pages)):
            done = subprocess.run(["groff", "-man", "-ww", "-z", "-Tutf8", os.path.join(pages, name)],
                                  capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)

    def test_completes_every_command_option_and_value_of_the_help(self):
        for command, options in self.every_command():
            if len(command) < 2 and (below := self.help_of(*command)[0]):
                self.assertEqual(sorted(self.complete(*command, "")), sorted(below))
            self.assertLessEqual(set(options), set(self.complete(*command, "--")), command)
            for option, values in options.items():
                if values:
                    self.assertEqual(self.complete(*command, option, ""), values)
                    self.assertEqual(self.complete(*command, option, "=", ""), values)

    def test_completes_file_names_where_the_command_takes_any_word(self):
        self.assertEqual(self.complete("plan", ""), [])
        self.assertEqual(self.complete("plan", "part.p21", "--machine", ""), [])
        self.assertEqual(self.complete("plan", "part.p21", "--margin", "b"), ["bold"])
        self.assertEqual(self.complete("--threads", "2", "tools", "l"), ["list"])


if __name__ == "__main__":
    arguments = argparse.ArgumentParser()
    for name in ("source", "built", "scratch", "libdir", "libexecdir", "version", "cmake", "generator", "cxx", "cc"):
        arguments.add_argument("--" + name, required=True)
    arguments.add_argument("--brep", action="store_true")
    arguments.add_argument("--postgres", action="store_true")
    arguments.add_argument("--python", default="", help="where modules of Python are, below the prefix")
    arguments.add_argument("--interpreter", default="", help="of Python, that the module is for")
    GIVEN, rest = arguments.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)
