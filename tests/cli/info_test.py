"""geovor info, held against what samples/README.md says of the samples."""

import json
import math
import unittest

from program import ProgramTest, sample


class Info(ProgramTest):
    def info(self, name):
        return json.loads(self.succeed("info", sample(name), "--json"))

    def area(self, document):
        return math.fsum(face["area"] for face in document["faces"])

    def check_area(self, name, expected):
        self.assertAlmostEqual(self.area(self.info(name)) / expected, 1.0, delta=1e-9)

    def test_area_of_the_sphere(self):
        self.check_area("sphere.step", 400 * math.pi)

    def test_area_of_the_cylinder(self):
        self.check_area("cylinder.step", 800 * math.pi)

    def test_area_of_the_cone(self):
        self.check_area("cone.step", 200 * math.pi)

    def test_area_of_the_torus(self):
        self.check_area("torus.step", 480 * math.pi**2)

    def test_area_of_the_plate(self):
        self.check_area("plate.step", 14368 + 112 * math.pi)

    def test_the_plate_is_as_large_whatever_unit_its_file_counts_in(self):
        for name in ("plate_inch.step", "plate_metre.step", "plate.iges"):
            document = self.info(name)
            self.assertEqual(document["unit"], "mm")
            self.assertAlmostEqual(self.area(document) / (14368 + 112 * math.pi), 1.0, delta=1e-7)

    def test_faces_are_numbered_from_one_in_order(self):
        self.assertEqual([face["face"] for face in self.info("plate.step")["faces"]], list(range(1, 16)))

    def test_the_plate_has_two_faces_with_six_holes(self):
        holes = sorted(face["holes"] for face in self.info("plate.step")["faces"])
        self.assertEqual(holes, [0] * 13 + [6, 6])

    def test_a_solid_is_one_closed_shell_of_all_its_faces(self):
        self.assertEqual(self.info("plate.step")["shells"], [{"faces": list(range(1, 16)), "closed": True}])

    def test_an_open_face_is_no_closed_shell(self):
        self.assertFalse(any(shell["closed"] for shell in self.info("wave.step")["shells"]))

    def test_kinds_of_the_cylinders_faces(self):
        self.assertEqual(sorted(face["kind"] for face in self.info("cylinder.step")["faces"]),
                         ["cylinder", "plane", "plane"])

    def test_the_sphere_is_periodic_and_has_two_collapsed_sides(self):
        (face,) = self.info("sphere.step")["faces"]
        self.assertEqual(face["kind"], "sphere")
        self.assertAlmostEqual(face["u_period"], 2 * math.pi)
        self.assertIsNone(face["v_period"])
        self.assertEqual(face["collapsed"], 2)

    def test_degree_and_poles_of_the_wave(self):
        (face,) = self.info("wave.step")["faces"]
        self.assertEqual((face["degree"], face["poles"], face["rational"]), ([7, 7], [25, 25], False))

    def test_the_moebius_patch_is_rational(self):
        (face,) = self.info("freeform_moebius.step")["faces"]
        self.assertTrue(face["rational"])

    def test_the_moebius_patch_is_more_stretched_than_the_same_patch_before(self):
        (before,), (after,) = (self.info(name)["faces"] for name in ("freeform.step", "freeform_moebius.step"))
        self.assertGreater(after["stretch"], before["stretch"])
        self.assertAlmostEqual(after["area"] / before["area"], 1.0, delta=1e-9)

    def test_box_of_the_plate(self):
        document = self.info("plate.step")
        for axis, size in enumerate((100, 60, 8)):
            extent = document["box"]["upper"][axis] - document["box"]["lower"][axis]
            self.assertAlmostEqual(extent / size, 1.0, delta=1e-3)

    def test_the_table_has_a_row_a_face_with_the_same_area(self):
        lines = self.succeed("info", sample("cylinder.step")).splitlines()
        rows = {line.split()[0]: line for line in lines if line.startswith("Face")}
        self.assertEqual(sorted(rows), ["Face1", "Face2", "Face3"])
        for face in self.info("cylinder.step")["faces"]:
            self.assertIn(f" {face['area']:.8g} ", rows[f"Face{face['face']}"])

    def test_the_tables_head_says_unit_and_size(self):
        text = self.succeed("info", sample("plate.step"))
        self.assertIn("unit      mm\n", text)
        self.assertIn("faces     15\n", text)
        self.assertIn("shells    1 (1 closed)\n", text)


if __name__ == "__main__":
    unittest.main()
