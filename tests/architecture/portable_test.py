#!/usr/bin/env python3
"""portable.py finds a planted option, intrinsic and shared definition, and lets the dispatched files alone."""

import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import portable  # noqa: E402

AVX2 = "planner/physics/stock/sweep/rows_avx2.cpp"


class Portable(unittest.TestCase):
    def test_finds_an_option_for_one_kind_of_processor(self):
        self.assertEqual(
            portable.flag_faults([("a.cpp", ["g++", "-O2", "-march=x86-64-v2"]), ("b.cpp", ["g++", "-MD", "-Wall"])]),
            ["a.cpp: compiled with -march=x86-64-v2, and called on any processor"])

    def test_lets_a_dispatched_file_have_one(self):
        self.assertEqual(portable.flag_faults([(AVX2, ["g++", "-mavx2"])]), [])

    def test_finds_an_intrinsic_outside_of_the_kernels(self):
        for line in ("#include <immintrin.h>", "x = _mm_sqrt_ps(y);", '__attribute__((target("avx2"))) void f();',
                     'asm volatile("nop");', "if (__builtin_cpu_supports(name)) f();", "#include <arm_neon.h>"):
            self.assertEqual(len(portable.source_faults("a.cpp", f"#ifdef __AVX2__\n{line}\n#endif")), 1, line)

    def test_finds_an_intrinsic_of_a_kernel_that_nothing_guards(self):
        guarded = "#if defined(__AVX2__)\n_mm256_x();\n#elif defined(__SSE2__)\n_mm_x();\n#else\nplain();\n#endif\n"
        self.assertEqual(portable.source_faults(AVX2, guarded), [])
        self.assertEqual(len(portable.source_faults(AVX2, guarded + "_mm_x();")), 1)
        self.assertEqual(len(portable.source_faults(AVX2, guarded.replace("plain", "_mm_x"))), 1)

    def test_finds_a_definition_that_a_dispatched_object_shares(self):
        symbols = ("0000 T capstan::avx2()\n0000 t local\n0000 W std::vector<int>::~vector()\n"
                   "0000 u guard\n0000 r table\n")
        self.assertEqual(len(portable.object_faults(AVX2, symbols)), 2)


if __name__ == "__main__":
    unittest.main()
