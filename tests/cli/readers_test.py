"""Other programs open what geovor writes: Gmsh, and FreeCAD's own readers, with the right counts and the right size."""

import json
import os
import re
import shutil
import subprocess
import unittest

from program import ProgramTest, sample

FREECAD_MODULES = "/usr/lib/freecad-python3/lib"
SYSTEM_PYTHON = "/usr/bin/python3"  # FreeCAD's modules are built for it

GMSH_SCRIPT = """Merge "{name}";
faces() = Surface{{:}};
solids() = Volume{{:}};
Printf("triangles %g faces %g solids %g", Mesh.NbTriangles, #faces(), #solids());
Printf("box %.17g %.17g %.17g %.17g %.17g %.17g", General.MinX, General.MinY, General.MinZ,
       General.MaxX, General.MaxY, General.MaxZ);
"""

FREECAD_CURVES = """
import json, sys
sys.path.append(sys.argv[1])
import FreeCAD, Part
shape = Part.Shape()
shape.read("path.step")
print(json.dumps([{"length": e.Length, "ends": [list(v.Point) for v in e.Vertexes]} for e in shape.Edges]))
"""

FREECAD_SCRIPT = """
import json, sys
sys.path.append(sys.argv[1])
import FreeCAD, Mesh, Part
mesh = Mesh.Mesh("out.stl")
shape = Part.Shape()
shape.read("out.step")
def box(b):
    return [b.XMin, b.YMin, b.ZMin, b.XMax, b.YMax, b.ZMax]
print(json.dumps({
    "stl": {"triangles": mesh.CountFacets, "box": box(mesh.BoundBox), "solid": mesh.isSolid(), "volume": mesh.Volume},
    "step": {"faces": len(shape.Faces), "solids": len(shape.Solids), "box": box(shape.BoundBox),
             "valid": shape.isValid(), "volume": shape.Volume}}))
"""


def require(test, path, what):
    if path and os.path.exists(path):
        return
    if os.environ.get("CI") == "true":
        test.fail(f"{what} is not installed")
    test.skipTest(f"{what} is not installed")


class Readers(ProgramTest):
    """The plate: 100 x 60 x 8, a solid of 45696 - 1600 pi; the tube: radius 10, height 30, open."""

    def mesh(self, name, size):
        self.succeed("mesh", sample(name), "--size", size, "-o", "out.stl", "-o", "out.step", "--report", "report.json")
        totals = self.read_json("report.json")["totals"]
        return totals["topology"]["triangles"], totals["quality"]["volume"]

    def gmsh(self, name):
        gmsh = shutil.which("gmsh")
        require(self, gmsh, "gmsh")
        self.write("look.geo", GMSH_SCRIPT.format(name=name))
        done = subprocess.run([gmsh, "look.geo", "-parse_and_exit"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        self.assertNotIn("Warning", done.stdout)
        counts = re.search(r"^triangles (\d+) faces (\d+) solids (\d+)$", done.stdout, re.M)
        box = re.search(r"^box (.*)$", done.stdout, re.M)
        return tuple(map(int, counts.groups())), list(map(float, box.group(1).split()))

    def freecad(self, script=FREECAD_SCRIPT):
        require(self, FREECAD_MODULES, "FreeCAD")
        self.write("look.py", script)
        done = subprocess.run([SYSTEM_PYTHON, "look.py", FREECAD_MODULES], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout.splitlines()[-1])

    def check_box(self, box, expected, delta):
        for found, wanted in zip(box, expected):
            self.assertAlmostEqual(found, wanted, delta=delta)

    PLATE = [0, 0, 0, 100, 60, 8]

    def test_gmsh_opens_the_stl_of_the_plate(self):
        triangles, _ = self.mesh("plate.step", 6)
        (found, _, _), box = self.gmsh("out.stl")
        self.assertEqual(found, triangles)
        self.check_box(box, self.PLATE, 1e-4)

    def test_gmsh_opens_the_step_of_the_plate_as_a_solid(self):
        triangles, _ = self.mesh("plate.step", 6)
        (_, faces, solids), box = self.gmsh("out.step")
        self.assertEqual((faces, solids), (triangles, 1))
        self.check_box(box, self.PLATE, 1e-4)

    def test_gmsh_opens_the_step_of_a_part_that_counts_in_inches(self):
        self.mesh("plate_inch.step", 6)
        _, box = self.gmsh("out.step")
        self.check_box(box, self.PLATE, 1e-4)

    def test_freecad_opens_both_files_of_the_plate(self):
        triangles, volume = self.mesh("plate.step", 6)
        seen = self.freecad()
        self.assertEqual((seen["stl"]["triangles"], seen["stl"]["solid"]), (triangles, True))
        self.assertEqual((seen["step"]["faces"], seen["step"]["solids"], seen["step"]["valid"]), (triangles, 1, True))
        for seen_file in seen.values():
            self.check_box(seen_file["box"], self.PLATE, 1e-3)
            self.assertAlmostEqual(seen_file["volume"] / volume, 1, delta=1e-5)

    def test_freecad_opens_both_files_of_an_open_face(self):
        triangles, _ = self.mesh("cylinder_tube.step", 3)
        seen = self.freecad()
        self.assertEqual((seen["stl"]["triangles"], seen["stl"]["solid"]), (triangles, False))
        self.assertEqual((seen["step"]["faces"], seen["step"]["solids"], seen["step"]["valid"]), (triangles, 0, True))

    def test_freecad_opens_the_paths_of_a_distance_at_their_length(self):
        for name, start, end, count in (("sphere.step", "0.1,0.2", "2,-0.5", 1), ("wave.step", "-2,-1", "2,1.5", 1),
                                        ("cylinder_tube.step", "0,5", "3.141592653589793,20", 2)):
            self.succeed("distance", sample(name), "--from", start, "--to", end, "-o", "path.step", "-o", "path.json")
            document = self.read_json("path.json")
            edges = self.freecad(FREECAD_CURVES)
            self.assertEqual(len(edges), count)
            for edge in edges:
                self.assertAlmostEqual(edge["length"] / document["length"], 1, delta=1e-9)
                for vertex, end_name in zip(edge["ends"], ("from", "to")):
                    for found, wanted in zip(vertex, document[end_name]["xyz"]):
                        self.assertAlmostEqual(found, wanted, delta=1e-9)

    def test_gmsh_opens_the_path_of_a_distance(self):
        gmsh = shutil.which("gmsh")
        require(self, gmsh, "gmsh")
        self.succeed("distance", sample("sphere.step"), "--from", "0,0", "--to", "1,0", "-o", "path.step")
        self.write("look.geo", 'Merge "path.step";\ncurves() = Curve{:};\nPrintf("curves %g", #curves());\n')
        done = subprocess.run([gmsh, "look.geo", "-parse_and_exit"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        self.assertIn("\ncurves 1\n", done.stdout)
        self.assertIn("'Shapes/path'", done.stdout)


if __name__ == "__main__":
    unittest.main()
