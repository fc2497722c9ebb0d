"""geovor mesh: what it writes, read back by an independent reader and held against closed forms."""

import math
import unittest

import stl
from program import DONE, ProgramTest, sample


class Mesh(ProgramTest):
    def mesh(self, name, size, *more):
        return self.succeed("mesh", sample(name), "--size", size, "-o", "out.stl", "-o", "out.obj", "--report",
                            "report.json", *more)

    def test_a_sphere_is_closed_and_has_the_spheres_volume(self):
        # A chord of length 1.5 on a circle of radius 10 lies 0.028 below it: the volume may lack three times 0.28 %.
        self.mesh("sphere.step", 1.5)
        triangles, _ = stl.read_binary_stl(self.folder / "out.stl")
        self.assertTrue(stl.is_closed(triangles))
        volume = stl.volume(triangles)
        exact = 4000 * math.pi / 3
        self.assertLess(volume, exact)
        self.assertGreater(volume, 0.99 * exact)

    def test_facet_normals_point_out_of_the_sphere(self):
        self.mesh("sphere.step", 2)
        triangles, normals = stl.read_binary_stl(self.folder / "out.stl")
        for triangle, facet_normal in zip(triangles, normals):
            middle = [sum(p[i] for p in triangle) / 3 for i in range(3)]
            centre = [0, 0, 0]
            self.assertGreater(stl.dot(stl.normal(triangle), stl.minus(middle, centre)), 0)
            self.assertGreater(stl.dot(facet_normal, stl.normal(triangle)), 0)
            self.assertAlmostEqual(stl.dot(facet_normal, facet_normal), 1, delta=1e-5)

    def test_a_plate_with_holes_is_closed_and_has_its_area(self):
        self.mesh("plate.step", 4)
        triangles, _ = stl.read_binary_stl(self.folder / "out.stl")
        self.assertTrue(stl.is_closed(triangles))
        self.assertAlmostEqual(stl.area(triangles) / (14368 + 112 * math.pi), 1, delta=5e-3)

    def test_an_open_face_has_its_border_and_its_area(self):
        self.mesh("cylinder_tube.step", 1.5)
        triangles, _ = stl.read_binary_stl(self.folder / "out.stl")
        self.assertFalse(stl.is_closed(triangles))
        self.assertAlmostEqual(stl.area(triangles) / (600 * math.pi), 1, delta=5e-3)

    def test_a_face_with_a_size_of_its_own_is_finer_and_the_plate_still_closed(self):
        (self.folder / "sizes.csv").write_text("face,size\n# the first one only\nFace1,1\n")
        self.mesh("plate.step", 4)
        plain = {f["face"]: f for f in self.read_json("report.json")["faces"]}
        self.mesh("plate.step", 4, "--sizes", self.folder / "sizes.csv")
        report = self.read_json("report.json")
        own = {f["face"]: f for f in report["faces"]}
        self.assertEqual((own[1]["size"], own[2]["size"]), (1, 4))
        self.assertTrue(report["options"]["sizes"].endswith("sizes.csv"))
        # A size of 1 and not 4: 16 times as many triangles of sixteenth the area, fewer where the edges were fine before.
        self.assertGreater(own[1]["triangles"], 8 * plain[1]["triangles"])
        triangles, _ = stl.read_binary_stl(self.folder / "out.stl")
        self.assertTrue(stl.is_closed(triangles))

    def test_all_formats_hold_the_same_triangles(self):
        self.mesh("cone.step", 2)
        from_stl, _ = stl.read_binary_stl(self.folder / "out.stl")
        from_obj = stl.read_obj(self.folder / "out.obj")
        self.succeed("mesh", sample("cone.step"), "--size", 2, "-o", "text.stl", "--ascii")
        from_text = stl.read_ascii_stl(self.folder / "text.stl")
        self.assertEqual(len(from_stl), len(from_obj))
        self.assertEqual(len(from_stl), len(from_text))
        for a, b, c in zip(from_stl, from_obj, from_text):
            for p, q, r in zip(a, b, c):
                for i in range(3):
                    self.assertAlmostEqual(p[i], q[i], delta=1e-5)
                    self.assertAlmostEqual(p[i], r[i], delta=1e-5)

    def test_chosen_faces_alone_are_meshed(self):
        self.mesh("plate.step", 4, "--faces", "3,Face1,5-6")
        report = self.read_json("report.json")
        self.assertEqual([face["face"] for face in report["faces"]], [1, 3, 5, 6])

    def test_half_the_size_gives_about_four_times_the_triangles(self):
        self.mesh("wave.step", 0.4, "--angle", 90)
        coarse = self.read_json("report.json")["totals"]["topology"]["triangles"]
        self.mesh("wave.step", 0.2, "--angle", 90)
        fine = self.read_json("report.json")["totals"]["topology"]["triangles"]
        self.assertGreater(fine, 3 * coarse)
        self.assertLess(fine, 5 * coarse)

    def test_a_deflection_bounds_the_distance(self):
        self.mesh("sphere.step", 5, "--angle", 90, "--deflection", 0.05)
        self.assertLessEqual(self.read_json("report.json")["totals"]["largest_distance"], 0.05)

    def test_the_result_does_not_depend_on_the_number_of_threads(self):
        self.succeed("mesh", sample("plate.step"), "--size", 5, "-o", "one.obj", "--threads", 1)
        self.succeed("mesh", sample("plate.step"), "--size", 5, "-o", "two.obj", "--threads", 4)
        self.assertEqual((self.folder / "one.obj").read_bytes(), (self.folder / "two.obj").read_bytes())

    def test_an_inch_file_gives_the_same_mesh_as_the_millimetre_file(self):
        self.mesh("plate_inch.step", 5)
        triangles, _ = stl.read_binary_stl(self.folder / "out.stl")
        low, high = stl.box(triangles)
        for i, size in enumerate((100, 60, 8)):
            self.assertAlmostEqual(high[i] - low[i], size, delta=1e-3)


class Report(ProgramTest):
    def report(self, name, size, *more):
        self.summary = self.succeed("mesh", sample(name), "--size", size, "-o", "out.stl", "--report", "report.json", *more)
        return self.read_json("report.json")

    def test_totals_are_those_of_the_file_that_was_written(self):
        totals = self.report("sphere.step", 2)["totals"]
        triangles, _ = stl.read_binary_stl(self.folder / "out.stl")
        self.assertEqual(totals["topology"]["triangles"], len(triangles))
        self.assertTrue(totals["topology"]["closed"])
        self.assertEqual(totals["topology"]["euler_number"], 2)
        self.assertAlmostEqual(totals["mesh_area"] / stl.area(triangles), 1, delta=1e-5)
        self.assertAlmostEqual(totals["face_area"] / (400 * math.pi), 1, delta=1e-9)

    def test_euler_number_of_a_plate_with_six_holes(self):
        self.assertEqual(self.report("plate.step", 4)["totals"]["topology"]["euler_number"], -10)

    def test_every_face_has_its_row_and_they_add_up(self):
        report = self.report("plate.step", 5)
        self.assertEqual([face["face"] for face in report["faces"]], list(range(1, 16)))
        self.assertEqual({face["status"] for face in report["faces"]}, {"meshed"})
        self.assertEqual(sum(face["triangles"] for face in report["faces"]), report["totals"]["topology"]["triangles"])
        self.assertEqual(sum(face["inverted"] for face in report["faces"]), 0)

    def test_input_options_and_version_are_told(self):
        report = self.report("cone.step", 3, "--gradation", 0.4)
        self.assertEqual((report["format"], report["version"]), ("geovor-mesh-report", 1))
        self.assertEqual(report["input"], sample("cone.step"))
        self.assertEqual((report["options"]["size"], report["options"]["gradation"]), (3, 0.4))
        self.assertIsNone(report["options"]["deflection"])
        self.assertEqual(report["unit"], "mm")
        self.assertEqual(sorted(report["seconds"]), ["borders", "checks", "faces", "read", "write"])

    def test_the_summary_says_what_the_report_says(self):
        totals = self.report("sphere.step", 2)["totals"]
        self.assertIn(f"triangles         {totals['topology']['triangles']} (", self.summary)
        self.assertIn("closed            yes, Euler number 2\n", self.summary)
        self.assertIn("wrote             out.stl\n", self.summary)
        self.assertIn("wrote             report.json\n", self.summary)


class Progress(ProgramTest):
    def stderr_of(self, *flags):
        done = self.run_program("mesh", sample("cylinder.step"), "--size", 4, "-o", "out.stl", *flags)
        self.assertEqual(done.returncode, DONE)
        return done.stderr

    def test_it_is_silent_where_stderr_is_no_terminal(self):
        self.assertEqual(self.stderr_of(), "")

    def test_it_prints_a_line_a_face_where_asked(self):
        self.assertEqual(self.stderr_of("--progress").splitlines(),
                         [f"geovor: faces meshed {n}/3" for n in (1, 2, 3)])

    def test_it_can_be_forbidden(self):
        self.assertEqual(self.stderr_of("--no-progress"), "")


if __name__ == "__main__":
    unittest.main()
