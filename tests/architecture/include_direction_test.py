#!/usr/bin/env python3
"""include_direction.py passes a clean tree and names each planted include by file and line."""

import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import include_direction  # noqa: E402

CLEAN = {
    "planner/base/result.h": "#include <string>\n",
    "planner/model/tool.h": '#include "planner/base/result.h"\n',
    "planner/mechanics/constants.h": "",
    "planner/mechanics/force.h": '#include "planner/model/tool.h"\n',
    "planner/pipeline/plan.h": '#include "tooling/select/select.h"\n',
    "tooling/select/select.h": '#include "planner/mechanics/force.h"\n',
    "planner/optimise/solver/nlopt.cpp": "#include <nlopt.hpp>\n",
    "planner/verify/load.cpp": '#include "planner/mechanics/constants.h"\n',
    "planner/facade/facade.cpp": '#include "capstan/capstan.h"\n#include "planner/pipeline/plan.h"\n',
    "include/capstan/capstan.h": "#include <cstdint>\n#include <string>\n// like tl::expected\n",
    "include/capstan/capstan_late.h": "#include <stdint.h>\n",
    "tests/base/any_test.cpp": '#include "planner/app/anything.h"\n',
}


class IncludeDirection(unittest.TestCase):
    def faults_with(self, planted):
        with tempfile.TemporaryDirectory() as root:
            for path, text in {**CLEAN, **planted}.items():
                path = os.path.join(root, path)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
            return [(path, line) for path, line, _ in include_direction.faults(root)]

    def test_passes_a_clean_tree(self):
        self.assertEqual(self.faults_with({}), [])

    def test_names_each_planted_include(self):
        for path, text, line in [
            ("planner/base/up.cpp", '#include <string>\n#include "planner/model/tool.h"\n', 2),
            ("planner/model/up.h", '#include "planner/mechanics/force.h"\n', 1),
            ("planner/mechanics/side.h", '\n\n  #  include "tooling/select/select.h"  // why\n', 3),
            ("rules/engine/up.cpp", '#include "planner/pipeline/plan.h"\n', 1),
            ("planner/verify/sweep.cpp", '#include "planner/mechanics/force.h"\n', 1),
            ("planner/late/session.h", '#include "planner/model/tool.h"\n#include "tooling/select/select.h"\n', 2),
            ("planner/pipeline/up.cpp", '#include "planner/facade/facade.cpp"\n', 1),
            ("planner/base/near.cpp", '#include "result.h"\n', 1),
            ("planner/base/gone.cpp", '#include "planner/base/gone.h"\n', 1),
            ("planner/base/json.h", "#include <nlohmann/json.hpp>\n", 1),
            ("planner/attic/old.h", "\n", 1),
            ("include/capstan/more.h", "#include <Eigen/Dense>\n", 1),
            ("include/capstan/more.h", "#include <fmt/core.h>\n", 1),
            ("include/capstan/more.h", '#include "planner/base/result.h"\n', 1),
            ("include/capstan/more.h", "#include <string>\nvoid f(const YAML::Node& node);\n", 2),
        ]:
            with self.subTest(path=path, text=text):
                self.assertEqual(self.faults_with({path: text}), [(path, line)])

    def test_names_every_user_of_a_library_with_two_fences(self):
        self.assertEqual(
            self.faults_with({"planner/app/second.cpp": "\n#include <nlopt.h>\n"}),
            [("planner/app/second.cpp", 2), ("planner/optimise/solver/nlopt.cpp", 1)])


if __name__ == "__main__":
    unittest.main()
