#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Feeds check_architecture.py broken trees and proves that each of its rules fires."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import check_architecture

SPDX = ("// SPDX-FileCopyrightText: 2026 the Stucco authors\n"
        "// SPDX-License-Identifier: GPL-3.0-or-later\n")


class CheckArchitectureTest(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, path, text, spdx=SPDX):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(spdx + text)

    def include(self, path, *includes):
        self.write(path, "".join(f"#include {include}\n" for include in includes))

    def assert_clean(self):
        self.assertEqual(check_architecture.problems(self.root), [])

    def assert_problem(self, *parts):
        """Exactly one problem, which holds every part."""
        found = check_architecture.problems(self.root)
        self.assertEqual(len(found), 1, found)
        for part in parts:
            self.assertIn(part, found[0])

    def assert_refused(self, path, include, *parts):
        self.include(path, include)
        self.assert_problem(path, *parts)
        (self.root / path).unlink()

    def assert_allowed(self, path, include):
        self.include(path, include)
        self.assert_clean()
        (self.root / path).unlink()

    def test_link_lists_follow_the_arrows(self):
        self.write("calib/CMakeLists.txt", "add_module(calib SOURCES plan.cpp PUBLIC survey site"
                   " PRIVATE Ceres::ceres)", SPDX.replace("// ", "# "))
        self.write("calib/README.md", "")
        self.assert_clean()
        self.write("calib/CMakeLists.txt", "add_module(calib PUBLIC survey PRIVATE plan)",
                   SPDX.replace("// ", "# "))
        self.assert_problem("calib/CMakeLists.txt", "may not link plan")

    def test_nothing_counts_on_the_virtual_drone(self):
        comment = SPDX.replace("// ", "# ")
        linked = "target_link_libraries(calib_test PRIVATE simulate)"
        self.write("tests/calib/CMakeLists.txt", f"if(STUCCO_SIMULATE)\n{linked}\nendif()", comment)
        self.write("tests/simulate/CMakeLists.txt", "add_module_test(simulate LINK simulate)", comment)
        self.assert_clean()
        self.write("tests/calib/CMakeLists.txt", linked, comment)
        self.assert_problem("tests/calib/CMakeLists.txt", "simulate", "STUCCO_SIMULATE")

    def test_a_good_tree_is_clean(self):
        self.include("survey/pose.h", "<Eigen/Core>", "<vector>", '"survey/ids.h"')
        self.include("calib/adjust.h", "<opencv2/core.hpp>", "<opencv2/core/types.hpp>")
        self.include("calib/adjust.cpp", '"calib/adjust.h"', "<ceres/ceres.h>",
                     '"calib/internal/costs.h"', '"survey/pose.h"')
        self.include("calib/internal/costs.h", "<ceres/ceres.h>")
        self.include("pipeline/default_stages.cpp", '"calib/adjust.h"', '"texture/texture.h"')
        self.include("pipeline/engine/run.cpp", '"pipeline/engine/lock.h"', '"survey/error.h"',
                     "<fmt/format.h>")
        self.include("pipeline/verbs/plan.cpp", '"pipeline/verbs/init.h"', '"plan/make_plan.h"',
                     '"pipeline/engine/lock.h"', '"survey/error.h"')
        self.include("cli/main.cpp", '"pipeline/engine/engine.h"', '"pipeline/verbs/init.h"',
                     '"pipeline/default_stages.h"', '"survey/error.h"', '"simulate/fly.h"')
        self.include("simulate/fly.cpp", '"survey/pose.h"', '"plan/views.h"')
        self.include("evaluate/poses.cpp", '"survey/pose.h"', '"site/site.h"')
        self.include("site/site.cpp", '"site/site.h"', '"survey/plan.h"')
        for stage in ("plan", "calib", "proxy", "texture"):
            self.include(f"{stage}/walls.cpp", '"site/site.h"', '"survey/plan.h"')
        self.include("tests/calib/adjust_test.cpp", '"calib/internal/costs.h"',
                     '"tests/calib/scene.h"', '"simulate/fly.h"', "<gtest/gtest.h>")
        self.include("tests/end_to_end/run_test.cpp", '"calib/adjust.h"', '"pipeline/run.h"')
        self.write("calib/CMakeLists.txt", "", SPDX.replace("//", "#"))
        (self.root / "calib/README.md").write_text("Calibration")
        self.write("scripts/a.py", "", "#!/usr/bin/env python3\n" + SPDX.replace("//", "#"))
        self.assert_clean()

    def test_arrows_point_one_way(self):
        may_not = "may not include"
        self.assert_refused("survey/pose.cpp", '"calib/adjust.h"', may_not)
        self.assert_refused("survey/pose.h", '"pipeline/run.h"', may_not)
        self.assert_refused("site/site.cpp", '"plan/make_plan.h"', may_not)
        self.assert_refused("survey/pose.h", '"site/site.h"', may_not)
        self.assert_refused("dense/densify.cpp", '"site/site.h"', may_not)
        self.assert_refused("evaluate/poses.cpp", '"plan/make_plan.h"', may_not)
        self.assert_refused("calib/adjust.cpp", '"dense/densify.h"', may_not)
        self.assert_refused("calib/adjust.cpp", "<dense/densify.h>", may_not)
        self.assert_refused("calib/internal/a.h", '"texture/texture.h"', may_not)
        self.assert_refused("texture/texture.cpp", '"pipeline/run.h"', may_not)
        self.assert_refused("calib/adjust.cpp", '"simulate/fly.h"', may_not)
        self.assert_refused("pipeline/run.cpp", '"simulate/fly.h"', may_not)
        self.assert_refused("pipeline/run.cpp", '"cli/arguments.h"', may_not)
        self.assert_refused("cli/main.cpp", '"calib/adjust.h"', may_not)
        self.assert_refused("simulate/fly.cpp", '"calib/adjust.h"', may_not)
        self.assert_refused("simulate/fly.cpp", '"evaluate/evaluate.h"', may_not)
        self.assert_refused("tests/calib/a_test.cpp", '"dense/densify.h"', may_not)
        self.assert_refused("calib/adjust.cpp", '"tests/calib/scene.h"', "only tests")

    def test_arrows_between_folders_point_one_way(self):
        may_not = "may not include"
        self.assert_refused("pipeline/engine/run.cpp", '"pipeline/verbs/check.h"',
                            "pipeline/engine " + may_not)
        self.assert_refused("pipeline/engine/run.h", '"pipeline/verbs/check.h"', may_not)
        self.assert_refused("pipeline/engine/internal/a.h", '"pipeline/verbs/check.h"', may_not)
        self.assert_refused("pipeline/engine/run.cpp", '"pipeline/default_stages.h"', may_not)
        self.assert_refused("pipeline/engine/run.cpp", '"calib/adjust.h"', may_not)
        self.assert_refused("pipeline/engine/run.cpp", "<plan/make_plan.h>", may_not)
        self.assert_refused("pipeline/verbs/init.cpp", '"pipeline/default_stages.h"', may_not)
        self.assert_refused("pipeline/verbs/init.cpp", '"calib/adjust.h"', may_not)
        self.assert_refused("cli/run.cpp", '"pipeline/engine/lock.h"', "cli " + may_not)

    def test_folders_of_a_module_stand_on_each_other(self):
        below = "stands below"
        self.assert_refused("calib/scene/scene.cpp", '"calib/adjust/adjust.h"', below)
        self.assert_refused("calib/scene/scene.h", '"calib/calibrate.h"', below)
        self.assert_refused("calib/adjust/internal/costs.h", '"calib/mapping/mapper.h"', below)
        self.assert_refused("simulate/random.cpp", '"simulate/scene/scene.h"', below)
        self.assert_allowed("calib/adjust/adjust.cpp", '"calib/scene/scene.h"')
        self.assert_allowed("calib/adjust/adjust.cpp", '"calib/adjust/internal/costs.h"')
        self.assert_allowed("calib/calibrate.cpp", '"calib/results/summarize.h"')
        self.assert_refused("calib/unheard/a.cpp", '"survey/pose.h"', "do not know this folder")

    def test_arrows_cannot_be_walked_around(self):
        self.assert_refused("calib/adjust.cpp", '"../dense/densify.h"', '"module/file.h"')
        self.assert_refused("calib/adjust.cpp", '"adjust.h"', '"module/file.h"')
        self.write("calib/adjust.cpp", "  #  include   \"dense/densify.h\"\n")
        self.assert_problem("may not include")

    def test_internal_headers_stay_inside(self):
        self.assert_refused("calib/a.cpp", '"survey/internal/json.h"', "internal to survey")
        self.assert_refused("tests/calib/a_test.cpp", '"survey/internal/json.h"', "internal to")
        self.assert_refused("bench/a.cpp", '"survey/internal/json.h"', "internal to survey")
        self.assert_refused("survey/a.h", '"survey/internal/json.h"', "public header")

    def test_public_headers_are_light(self):
        for header in ("CGAL/Simple_cartesian.h", "opencv2/imgproc.hpp", "opencv2/opencv.hpp",
                       "ceres/ceres.h", "pcl/point_types.h", "assimp/scene.h", "embree3/rtcore.h",
                       "nlohmann/json.hpp", "gdal_priv.h", "gdal/gdal.h", "ogrsf_frmts.h",
                       "cpl_conv.h"):
            self.assert_refused("proxy/abstract.h", f"<{header}>", "heavy", header)
            self.include("proxy/internal/a.h", f"<{header}>")
            self.include("proxy/a.cpp", f"<{header}>")
            self.include("tests/proxy/support.h", f"<{header}>")
            self.assert_clean()

    def test_types_have_names_of_their_own(self):
        self.write("calib/a.h", "namespace stucco {\nstruct Scene {\n};\nclass Other;\n}\n")
        self.write("proxy/b.h", "namespace stucco {\nclass Other final : Base {\n};\n}\n")
        self.write("simulate/c.h", "namespace stucco::simulate {\nstruct Scene {\n};\n}\n")
        self.write("tests/proxy/d.h", "namespace stucco {\nstruct Scene {\n};\n}\n")
        self.assert_clean()
        self.write("proxy/a.h", "namespace stucco {\nclass Scene {\n};\n}\n")
        self.assert_problem("proxy/a.h", "stucco::Scene", "calib/a.h")

    def test_folders_and_files_do_not_include_each_other_in_circles(self):
        self.include("dense/internal/b.h", '"dense/c.h"')
        self.include("dense/b.cpp", '"dense/internal/b.h"', '"dense/deep/d.h"')
        self.include("dense/deep/d.cpp", '"dense/deep/d.h"', '"survey/e.h"')
        self.include("tests/dense/deep/d_test.cpp", '"dense/b.h"')
        self.assert_clean()
        self.include("dense/c.cpp", '"dense/b.h"')
        self.assert_problem("files that include each other in a circle: dense/b, dense/c")
        self.include("dense/c.cpp", '"dense/c.h"')
        self.include("dense/deep/internal/f.h", '"dense/c.h"')
        self.assert_problem("folders that include each other in a circle: dense, dense/deep")

    def write_module(self, module, headers):
        (self.root / module).mkdir(exist_ok=True)
        (self.root / module / "README.md").write_text("What it does")
        self.write(f"{module}/CMakeLists.txt",
                   f"add_module({module} HEAVY\n  HEADERS {headers} # all\n  SOURCES a.cpp)\n",
                   SPDX.replace("//", "#"))

    def test_modules_show_what_others_use_and_nothing_else(self):
        self.write_module("calib", "calibrate.h scene/options.h")
        self.include("calib/calibrate.h", '"calib/scene/options.h"')
        self.include("calib/calibrate.cpp", '"calib/adjust.h"')
        self.include("tests/calib/adjust_test.cpp", '"calib/adjust.h"')
        self.include("pipeline/run.cpp", '"calib/calibrate.h"')
        self.assert_clean()
        self.assert_refused("pipeline/a.cpp", '"calib/adjust.h"', "not among the HEADERS")
        self.include("calib/scene/options.h", '"calib/scene/limits.h"')
        self.assert_problem("calib/scene/options.h", "not among the HEADERS")
        self.include("calib/scene/options.h")
        self.write_module("calib", "calibrate.h scene/options.h adjust.h")
        self.assert_problem("calib/adjust.h", "no other module includes it")

    def test_files_are_short(self):
        for name in ("calib/a.cpp", "calib/a.h", "scripts/a.py", "scripts/a.sh", "cmake/a.cmake",
                     "tests/calib/a.cpp", "CMakeLists.txt"):
            self.write(name, "\n" * 498)
            self.assert_clean()
            self.write(name, "\n" * 499)
            self.assert_problem(name, "501 lines")
            (self.root / name).unlink()

    def test_files_begin_with_spdx(self):
        for name in ("calib/a.cpp", "calib/a.h", "scripts/a.py", "scripts/a.sh", "cmake/a.cmake",
                     "calib/internal/CMakeLists.txt"):
            self.write(name, "", spdx="")
            self.assert_problem(name, "SPDX")
            self.write(name, "", spdx=SPDX.splitlines()[0])
            self.assert_problem(name, "SPDX")
            self.write(name, "", spdx="\n\n" + SPDX)
            self.assert_problem(name, "SPDX")
            (self.root / name).unlink()

    def test_modules_have_a_readme(self):
        self.write("dense/CMakeLists.txt", "")
        self.assert_problem("dense", "README.md")

    def test_build_trees_and_hidden_folders_are_left_alone(self):
        for name in ("build/dev/a.cpp", ".cache/a.cpp", "calib/node_modules/a.py", "out/x/a.cpp"):
            self.write(name, "", spdx="")
        self.write("out/CMakeCache.txt", "")
        self.assert_clean()

    def test_the_program_reports_by_text_and_exit_code(self):
        def run(*arguments):
            return subprocess.run([sys.executable, check_architecture.__file__, *arguments],
                                  capture_output=True, text=True, check=False)
        self.assertEqual(run(str(self.root)).returncode, 0)
        self.include("survey/pose.cpp", '"calib/adjust.h"')
        result = run(str(self.root))
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stdout,
                         "survey/pose.cpp: survey may not include calib/adjust.h\n")
        self.assertEqual(run().returncode, 2)


if __name__ == "__main__":
    unittest.main()
