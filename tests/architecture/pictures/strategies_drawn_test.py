#!/usr/bin/env python3
"""strategies_drawn.py names what has no picture, and what is pictured no more."""

import os
import sys
import types
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import strategies_drawn  # noqa: E402


def drawn(pictures=(("drill", "part", "HOLE drill~2", "time"), ("rings", "part", "RINGS", "above")),
          reasons=None, strategies=None):
    return types.SimpleNamespace(PICTURES=list(pictures), NOT_DRAWN={"measure": "a probe cuts nothing"} if reasons is None else reasons,
                                 STRATEGIES={"kContourParallel": "rings"} if strategies is None else strategies)


PAGE = "![a](strategies/drill.svg)\n![b](strategies/rings.svg)\n"


def faults(actions=("drill", "measure"), strategies=("kContourParallel",), drawing=None, page=PAGE, files=("drill", "rings")):
    return strategies_drawn.faults(set(actions), set(strategies), drawing or drawn(), page, list(files))


class StrategiesDrawn(unittest.TestCase):
    def test_says_nothing_where_all_is_drawn_or_has_a_reason(self):
        self.assertEqual(faults(), [])

    def test_reads_actions_and_strategies_from_the_sources(self):
        source = 'return {{"drill", TypeId::kDrilling, {}, drill},\n {"wall_rough",\n  TypeId::kSide, {{"side", 0.0, ""}}, rough}};'
        self.assertEqual(strategies_drawn.actions_of([source]), {"drill", "wall_rough"})
        header = "enum class StrategyKind : std::uint8_t {\n  kNone,\n  kBidirectional,\n};\nenum class Other { kMore };"
        self.assertEqual(strategies_drawn.strategies_of(header), {"kBidirectional"})

    def test_names_an_action_without_a_picture(self):
        found = faults(actions=("drill", "measure", "ream"))
        self.assertEqual(len(found), 1)
        self.assertIn("action ream", found[0])

    def test_names_a_reason_that_nothing_needs_and_one_that_is_empty(self):
        found = faults(drawing=drawn(reasons={"measure": " ", "drill": "no", "gone": "no"}))
        self.assertEqual(len(found), 3)

    def test_names_a_strategy_without_a_picture(self):
        found = faults(strategies=("kContourParallel", "kContourSpiral"))
        self.assertEqual(len(found), 1)
        self.assertIn("strategy kContourSpiral", found[0])
        self.assertEqual(len(faults(drawing=drawn(strategies={"kContourParallel": "spiral"}))), 1)

    def test_names_a_picture_without_a_file_or_a_place_and_the_other_way(self):
        self.assertEqual(len(faults(files=("drill",))), 1)
        self.assertEqual(len(faults(page=PAGE.splitlines()[0])), 1)
        self.assertEqual(len(faults(files=("drill", "rings", "old"))), 1)
        self.assertEqual(len(faults(page=PAGE + "![c](strategies/old.svg)")), 1)


if __name__ == "__main__":
    unittest.main()
