# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What bench/retexture.py makes of what it measured."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).parents[2] / "bench")]
import retexture  # noqa: E402

FIGURES = {"kept": ["W0", "W2"], "replaced": ["W1"], "filled": [], "painted": [], "named": ["W1"],
           "is_named": True, "other_bytes": [], "photos": 10, "posed": 9,
           "run": {"cpu_s": 400.0, "in_part": False}, "cpu_s": 20.0, "ssim_before": 0.5,
           "ssim_after": None, "foreign": "refused"}


class Flight(unittest.TestCase):
    PLAN = {"facades": [{"id": name} for name in "ABCD"],
            "views": [{"facades": ["A"]}, {"facades": ["B", "D"]}, {"facades": []}]}

    def test_begins_at_what_is_repainted_and_leaves_out_what_no_view_is_for(self):
        self.assertEqual(retexture.facades_to_fly(self.PLAN, ["B"], 3), ["B", "D", "A"])
        self.assertEqual(retexture.facades_to_fly(self.PLAN, ["C"], 2), ["D"])
        self.assertEqual(retexture.facades_to_fly(self.PLAN, [], 2), ["A", "B"])


class Bytes(unittest.TestCase):
    def test_finds_kept_facets_with_other_bytes(self):
        with tempfile.TemporaryDirectory() as root:
            first, epoch = pathlib.Path(root) / "first", pathlib.Path(root) / "epoch"
            facets = [{"id": name, "image": f"textures/{name}.png", "label_image": "",
                       "orthophoto": f"orthophotos/{name}.png"} for name in ("W0", "W1", "W2")]
            for folder in (first / "texture", epoch):
                for kind in ("textures", "orthophotos"):
                    (folder / kind).mkdir(parents=True)
                for facet in facets:
                    for name in retexture.files_of(facet):
                        (folder / name).write_text(name)
            (first / "texture/textures.json").write_text(json.dumps({"facets": facets}))
            kept = {"W0", "W1"}
            self.assertEqual(retexture.other_bytes(first, epoch, kept), [])
            (epoch / "orthophotos/W1.pgw").write_text("0.01")
            (epoch / "textures/W2.png").write_text("another")  # not said to be kept
            self.assertEqual(retexture.other_bytes(first, epoch, kept), ["W1"])
            (epoch / "textures/W0.png").unlink()
            self.assertEqual(retexture.other_bytes(first, epoch, kept), ["W0", "W1"])


class Table(unittest.TestCase):
    def test_says_what_holds_and_what_does_not(self):
        row = retexture.row("hamlet-1", ["B1/F0"], FIGURES)
        self.assertEqual(len(row), len(retexture.HEAD))
        self.assertIn("5.0 %", row)
        self.assertIn("B1/F0: named", row)
        worse = dict(FIGURES, cpu_s=60.0, is_named=False, named=["W7"], other_bytes=["W2"])
        row = retexture.row("hamlet-1", ["B1/F0"], worse)
        self.assertIn("15.0 % (too much)", row)
        self.assertIn("B1/F0: named wrongly: W7", row)
        self.assertIn("W2", row)


if __name__ == "__main__":
    unittest.main()
