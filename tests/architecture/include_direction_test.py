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
    "planner/ground/base/result.h": "#include <string>\n",
    "planner/model/plan/tool.h": '#include "planner/ground/base/result.h"\n',
    "planner/physics/mechanics/constants.h": "",
    "planner/model/features/shape.h": "",
    "planner/model/features/fit/grade.h": "",
    "planner/model/features/fit/stated.h": "",
    "planner/proof/verify/volumes/form/limits.h": '#include "planner/model/features/fit/grade.h"\n',
    "planner/proof/verify/compared/compare.h": '#include "planner/model/features/shape.h"\n',
    "planner/physics/mechanics/force/force.h": '#include "planner/model/plan/tool.h"\n',
    "planner/door/pipeline/plan.h": '#include "tooling/selection/select.h"\n',
    "tooling/selection/select.h": '#include "planner/physics/mechanics/force/force.h"\n',
    "planner/making/optimise/solver/nlopt.cpp": "#include <nlopt.hpp>\n",
    "planner/proof/verify/load.cpp": '#include "planner/physics/mechanics/constants.h"\n',
    "planner/door/service/plan.h": '#include "planner/door/pipeline/plan.h"\n',
    "planner/door/facade/facade.cpp": '#include "capstan/capstan.h"\n#include "planner/door/service/plan.h"\n',
    "include/capstan/capstan.h": "#include <cstdint>\n#include <string>\n// like tl::expected\n",
    "include/capstan/capstan_late.h": "#include <stdint.h>\n",
    "tests/ground/base/any_test.cpp": '#include "planner/door/app/anything.h"\n',
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
            ("planner/ground/base/up.cpp", '#include <string>\n#include "planner/model/plan/tool.h"\n', 2),
            ("planner/model/plan/up.h", '#include "planner/physics/mechanics/force/force.h"\n', 1),
            ("planner/physics/mechanics/side.h", '\n\n  #  include "tooling/selection/select.h"  // why\n', 3),
            ("rules/engine/up.cpp", '#include "planner/door/pipeline/plan.h"\n', 1),
            ("planner/proof/verify/sweep.cpp", '#include "planner/physics/mechanics/force/force.h"\n', 1),
            ("planner/proof/verify/sweep/target.h", '#include "planner/model/features/shape.h"\n', 1),
            ("planner/proof/verify/volumes/near.h", '#include "planner/model/features/shape.h"\n', 1),
            ("planner/proof/verify/volumes/near.h", '#include "planner/model/features/fit/stated.h"\n', 1),
            ("planner/door/late/session.h", '#include "planner/model/plan/tool.h"\n#include "tooling/selection/select.h"\n', 2),
            ("planner/door/pipeline/up.cpp", '#include "planner/door/facade/facade.cpp"\n', 1),
            ("planner/ground/base/near.cpp", '#include "result.h"\n', 1),
            ("planner/ground/base/gone.cpp", '#include "planner/ground/base/gone.h"\n', 1),
            ("planner/ground/base/json.h", "#include <nlohmann/json.hpp>\n", 1),
            ("planner/attic/old.h", "\n", 1),
            ("include/capstan/more.h", "#include <Eigen/Dense>\n", 1),
            ("include/capstan/more.h", "#include <fmt/core.h>\n", 1),
            ("include/capstan/more.h", '#include "planner/ground/base/result.h"\n', 1),
            ("include/capstan/more.h", "#include <string>\nvoid f(const YAML::Node& node);\n", 2),
        ]:
            with self.subTest(path=path, text=text):
                self.assertEqual(self.faults_with({path: text}), [(path, line)])

    def test_names_files_that_include_each_other_in_a_circle(self):
        planted = {f"planner/ground/base/{a}.h": f'#include "planner/ground/base/{b}.h"\n' for a, b in ("ab", "bc", "ca")}
        self.assertEqual(self.faults_with(planted), [("planner/ground/base/a.h", 1)])

    def test_names_every_user_of_a_library_with_two_fences(self):
        self.assertEqual(
            self.faults_with({"planner/door/app/second.cpp": "\n#include <nlopt.h>\n"}),
            [("planner/door/app/second.cpp", 2), ("planner/making/optimise/solver/nlopt.cpp", 1)])


if __name__ == "__main__":
    unittest.main()
