"""geovor mesh: every format read back by another program or by its specification, and held against the .obj, whose
numbers are the doubles of the mesh. Gmsh, meshio, FreeCAD and assimp read; glTF, VTK's XML, PLY and tessellated STEP are
taken apart here as well."""

import base64
import html.parser
import json
import pathlib
import re
import shutil
import struct
import subprocess
import unittest
import xml.etree.ElementTree

from program import ProgramTest, sample
from readers_test import FREECAD_MODULES, SYSTEM_PYTHON, require

ENDINGS = ("obj", "stl", "ply", "vtp", "msh", "inp", "unv", "glb", "html", "brep", "step")

MESHIO_SCRIPT = """
import json, meshio, sys
out = {}
for name in sys.argv[1:]:
    mesh = meshio.read(name)
    cells = [(block.type, len(block.data)) for block in mesh.cells]
    triangles = [[[float(x).hex() for x in mesh.points[i]] for i in t] for block in mesh.cells for t in block.data]
    sets = {key: sum(len(part) for part in parts if part is not None) for key, parts in mesh.cell_sets.items()}
    out[name] = {"types": sorted(set(kind for kind, _ in cells)), "triangles": triangles, "sets": sets,
                 "names": sorted(mesh.field_data)}
print(json.dumps(out))
"""

FREECAD_SCRIPT = """
import json, sys
sys.path += [sys.argv[1], "/usr/share/freecad/Mod/Fem"]
import FreeCAD, Fem, Mesh, Part
out = {}
for name in ("out.ply", "out.obj", "out.stl"):
    mesh = Mesh.Mesh(name)
    out[name] = {"triangles": mesh.CountFacets, "solid": mesh.isSolid(), "volume": mesh.Volume}
for name in ("out.unv", "out.inp"):
    mesh = Fem.read(name)
    groups = {mesh.getGroupName(g): len(mesh.getGroupElements(g)) for g in mesh.Groups}
    out[name] = {"triangles": mesh.TriangleCount, "groups": groups,
                 "nodes": {i: [x.hex() for x in p] for i, p in mesh.Nodes.items()}}
shape = Part.Shape()
shape.read("out.brep")
out["out.brep"] = {"faces": len(shape.Faces), "solids": len(shape.Solids), "valid": shape.isValid(), "volume": shape.Volume}
print(json.dumps(out))
"""

GMSH_SCRIPT = """Merge "{name}";
groups() = Physical Surface{{:}};
Printf("triangles %g nodes %g groups %g", Mesh.NbTriangles, Mesh.NbNodes, #groups());
"""


def read_obj(path):
    """Points, and the triangles of each group."""
    points, groups = [], {}
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:])))
        elif words[:1] == ["g"]:
            group = groups.setdefault(words[1], [])
        elif words[:1] == ["f"]:
            group.append(tuple(int(word) - 1 for word in words[1:]))
    return points, groups


class Glb:
    """A strict reader of what glTF 2.0 asks for, as far as a mesh of triangles goes."""

    SIZES = {"VEC3": 3, "SCALAR": 1}
    TYPES = {5126: "f", 5125: "I"}

    def __init__(self, data):
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data)) and length % 4 == 0
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON" and size % 4 == 0
        self.json = json.loads(data[20:20 + size])
        at = 20 + size
        size, kind = struct.unpack_from("<I4s", data, at)
        self.binary = data[at + 8:]
        assert kind == b"BIN\0" and size == len(self.binary) == self.json["buffers"][0]["byteLength"]
        assert self.json["asset"]["version"] == "2.0"

    def array(self, index, target):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        assert view["target"] == target and view["byteOffset"] % 4 == 0
        n, kind = self.SIZES[accessor["type"]], self.TYPES[accessor["componentType"]]
        assert 4 * n * accessor["count"] == view["byteLength"]
        numbers = struct.unpack_from(f"<{n * accessor['count']}{kind}", self.binary, view["byteOffset"])
        rows = [numbers[i:i + n] for i in range(0, len(numbers), n)] if n > 1 else list(numbers)
        if "min" in accessor:
            assert accessor["min"] == [min(row[k] for row in rows) for k in range(n)]
            assert accessor["max"] == [max(row[k] for row in rows) for k in range(n)]
        return rows

    def faces(self):
        """Name, face number, colour, and triangles as points in metres, z up, with the normals of their corners."""
        json_, out = self.json, []
        root = json_["nodes"][json_["scenes"][json_["scene"]]["nodes"][0]]
        m = root["matrix"]
        for node in (json_["nodes"][i] for i in root["children"]):
            (primitive,) = json_["meshes"][node["mesh"]]["primitives"]
            assert primitive.get("mode", 4) == 4
            points = self.array(primitive["attributes"]["POSITION"], 34962)
            normals = self.array(primitive["attributes"]["NORMAL"], 34962)
            corners = self.array(primitive["indices"], 34963)
            assert len(points) == len(normals) and max(corners) < len(points) and len(corners) % 3 == 0
            for n in normals:
                assert abs(sum(x * x for x in n) - 1) < 1e-5
            placed = [[sum(m[4 * k + i] * p[k] for k in range(3)) + m[12 + i] for i in range(3)] for p in points]
            back = [(x, -z, y) for x, y, z in placed]
            colour = json_["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"]
            out.append({"name": node["name"], "face": node["extras"]["face"], "colour": colour[:3],
                        "triangles": [tuple(back[c] for c in corners[i:i + 3]) for i in range(0, len(corners), 3)]})
        return out


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.open, self.data, self.script = [], "", ""
        self.feed(text)
        assert self.open == [], self.open

    def handle_starttag(self, tag, attributes):
        if tag != "meta":
            self.open.append((tag, dict(attributes).get("id")))

    def handle_endtag(self, tag):
        assert self.open.pop()[0] == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == ("script", "data"):
            self.data += data
        elif self.open and self.open[-1][0] == "script":
            self.script += data


def step_entities(text):
    """Number -> (keyword, parameters) of the simple entities; parameters as nested lists, references as ('#', n)."""
    body = text.split("DATA;\n", 1)[1].rsplit("ENDSEC;", 1)[0]
    out = {}
    for match in re.finditer(r"#(\d+)=([A-Z0-9_]+)?\(((?:'(?:[^']|'')*'|[^';])*)\);\n", body):
        number, keyword, inner = int(match[1]), match[2], match[3]
        if keyword:
            out[number] = (keyword, parameters(inner))
    return out


def parameters(text):
    stack = [[]]
    for word in re.findall(r"'(?:[^']|'')*'|#\d+|\.[A-Z_]+\.|[$*]|[-+0-9.E]+|[(),]|[A-Z_]+", text.replace("\n", "")):
        if word == "(":
            stack.append([])
        elif word == ")":
            done = stack.pop()
            stack[-1].append(done)
        elif word[0] == "#":
            stack[-1].append(("#", int(word[1:])))
        elif word[0] == "'":
            stack[-1].append(word[1:-1])
        elif word != ",":
            stack[-1].append(float(word) if re.fullmatch(r"[-+0-9.E]+", word) else word)
    assert len(stack) == 1
    return stack[0]


class MeshFormats(ProgramTest):
    """The plate: a closed part of 15 faces."""

    def write_all(self, *more, source=None):
        outputs = [word for ending in ENDINGS for word in ("-o", f"out.{ending}")]
        self.succeed("mesh", source or sample("plate.step"), "--size", 9, *outputs, *more)
        self.points, self.groups = read_obj(self.folder / "out.obj")
        self.count = sum(map(len, self.groups.values()))
        self.triangles = [[self.points[i] for i in t] for group in self.groups.values() for t in group]
        self.sizes = {name: len(group) for name, group in self.groups.items()}

    def check_same(self, found, expected, what):
        """As assertEqual, which would take minutes to tell how long lists differ."""
        self.assertTrue(found == expected, what)

    def python(self, script, *arguments):
        self.write("look.py", script)
        done = subprocess.run([SYSTEM_PYTHON, "-W", "ignore", "look.py", *arguments], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout.splitlines()[-1])

    def test_meshio_reads_msh_and_inp_as_the_same_doubles_and_groups(self):
        require(self, "/usr/lib/python3/dist-packages/meshio", "meshio")
        self.write_all()
        read = self.python(MESHIO_SCRIPT, "out.msh", "out.inp")
        for name, mesh in read.items():
            self.assertEqual(mesh["types"], ["triangle"], name)
            triangles = [[tuple(map(float.fromhex, p)) for p in t] for t in mesh["triangles"]]
            if name == "out.inp":
                # Numbers of at most 20 characters: 1e-18 beside 0 is lost.
                for found, expected in zip(triangles, self.triangles):
                    for p, q in zip(found, expected):
                        for x, y in zip(p, q):
                            self.assertTrue(x == y or abs(y) < 0.01 and abs(x - y) <= 1e-17, (x, y))
            else:
                self.check_same(triangles, [[tuple(p) for p in t] for t in self.triangles], name)
            sets = {key: size for key, size in mesh["sets"].items() if not key.startswith("gmsh:")}
            self.assertEqual(sets, self.sizes, name)
        self.assertEqual(read["out.msh"]["names"], sorted(self.sizes))

    def test_gmsh_opens_msh_and_unv(self):
        gmsh = shutil.which("gmsh")
        require(self, gmsh, "gmsh")
        self.write_all()
        for name in ("out.msh", "out.unv"):
            self.write("look.geo", GMSH_SCRIPT.format(name=name))
            done = subprocess.run([gmsh, "look.geo", "-parse_and_exit"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
            self.assertNotIn("Warning", done.stdout)
            counts = re.search(r"^triangles (\d+) nodes (\d+) groups (\d+)$", done.stdout, re.M).groups()
            self.assertEqual(tuple(map(int, counts[:2])), (self.count, len(self.points)), name)
            if name == "out.msh":
                self.assertEqual(int(counts[2]), len(self.groups))

    def test_freecad_opens_ply_obj_unv_inp_and_brep(self):
        require(self, FREECAD_MODULES, "FreeCAD")
        self.write_all()
        read = self.python(FREECAD_SCRIPT, FREECAD_MODULES)
        for name in ("out.ply", "out.obj", "out.stl"):
            self.assertEqual((read[name]["triangles"], read[name]["solid"]), (self.count, True), name)
            self.assertAlmostEqual(read[name]["volume"] / read["out.brep"]["volume"], 1, delta=1e-5)
        self.assertEqual((read["out.brep"]["faces"], read["out.brep"]["solids"], read["out.brep"]["valid"]),
                         (self.count, 1, True))
        for name in ("out.unv", "out.inp"):
            self.assertEqual((read[name]["triangles"], len(read[name]["nodes"])), (self.count, len(self.points)), name)
        self.assertEqual(read["out.unv"]["groups"], self.sizes)
        nodes = [tuple(map(float.fromhex, read["out.unv"]["nodes"][str(i + 1)])) for i in range(len(self.points))]
        self.check_same(nodes, self.points, "nodes")

    def test_assimp_opens_the_glb_in_metres_with_y_up(self):
        assimp = shutil.which("assimp")
        require(self, assimp, "assimp")
        self.write_all()
        done = subprocess.run([assimp, "info", "out.glb"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        facts = dict(re.findall(r"^(Nodes|Meshes|Faces|Materials): +(\d+)$", done.stdout, re.M))
        self.assertEqual(facts, {"Nodes": "16", "Meshes": "15", "Faces": str(self.count), "Materials": "1"})
        self.assertIn("Minimum point      (0.000000 0.000000 -0.060000)", done.stdout)
        self.assertIn("Maximum point      (0.100000 0.008000 0.000000)", done.stdout.replace("-0.000000", "0.000000"))

    def test_glb_holds_each_face_as_the_specification_asks(self):
        self.write_all()
        faces = Glb((self.folder / "out.glb").read_bytes()).faces()
        self.assertEqual({face["name"]: len(face["triangles"]) for face in faces}, self.sizes)
        self.assertEqual([face["face"] for face in faces], list(range(1, 16)))
        found = [t for face in faces for t in face["triangles"]]
        for t, expected in zip(found, self.triangles):
            for p, q in zip(t, expected):
                for x, y in zip(p, q):
                    self.assertAlmostEqual(1000 * x, y, delta=1e-5)

    def test_ply_holds_doubles_and_face_numbers(self):
        self.write_all()
        head, _, data = (self.folder / "out.ply").read_bytes().partition(b"end_header\n")
        self.assertTrue(head.startswith(b"ply\nformat binary_little_endian 1.0\n"))
        self.assertIn(b"\ncomment face 3 Face3\n", head)
        n = len(self.points)
        self.check_same(list(struct.iter_unpack("<3d", data[:24 * n])), self.points, "points")
        rows = list(struct.iter_unpack("<B4i", data[24 * n:]))
        expected = [(3, *t, int(name[4:])) for name, group in self.groups.items() for t in group]
        self.check_same(rows, expected, "triangles")

    def test_vtp_holds_doubles_face_numbers_and_names(self):
        self.write_all()
        data = xml.etree.ElementTree.parse(self.folder / "out.vtp").getroot().find("PolyData")
        piece = data.find("Piece")
        arrays = {}
        for array in piece.iter("DataArray"):
            text = array.text.strip()
            (size,) = struct.unpack("<Q", base64.b64decode(text[:12], validate=True))
            raw = base64.b64decode(text[12:], validate=True)
            self.assertEqual(size, len(raw))
            kind = {"Float64": "d", "Int32": "i", "Int64": "q"}[array.get("type")]
            arrays[array.get("Name")] = [x for x, in struct.iter_unpack("<" + kind, raw)]
        self.assertEqual((piece.get("NumberOfPoints"), piece.get("NumberOfPolys")), (str(len(self.points)), str(self.count)))
        self.check_same(arrays["points"], [x for p in self.points for x in p], "points")
        self.check_same(arrays["connectivity"], [i for group in self.groups.values() for t in group for i in t], "corners")
        self.check_same(arrays["offsets"], [3 * (i + 1) for i in range(self.count)], "offsets")
        self.check_same(arrays["face"], [int(name[4:]) for name, group in self.groups.items() for _ in group], "faces")
        names = bytes(map(int, data.find("FieldData/Array").text.split())).decode().split("\0")[:-1]
        self.assertEqual(names, list(self.groups))
        self.check_same([names[g] for g in arrays["group"]], [name for name, group in self.groups.items() for _ in group], "groups")

    def test_tessellated_step_holds_the_same_triangles_over_one_list_of_points(self):
        self.write_all("--step-form", "tessellated")
        entities = step_entities((self.folder / "out.step").read_text())
        kinds = {}
        for number, (keyword, _) in entities.items():
            kinds.setdefault(keyword, []).append(number)
        (points,) = (entities[n][1] for n in kinds["COORDINATES_LIST"])
        self.check_same((points[1], [tuple(p) for p in points[2]]), (len(self.points), self.points), "points")
        groups = {}
        for number in kinds["TRIANGULATED_FACE"]:
            name, list_, largest, normals, link, index, triangles = entities[number][1]
            self.assertEqual((list_, link), (("#", kinds["COORDINATES_LIST"][0]), "$"))
            self.assertEqual((largest, len(normals)), (len(index), len(index)))
            groups[name] = [tuple(int(index[int(c) - 1]) - 1 for c in t) for t in triangles]
        self.check_same(groups, self.groups, "triangles")
        (solid,) = (entities[n][1] for n in kinds["TESSELLATED_SOLID"])
        self.assertEqual(solid[1], [("#", n) for n in kinds["TRIANGULATED_FACE"]])
        (shape,) = (entities[n][1] for n in kinds["TESSELLATED_SHAPE_REPRESENTATION"])
        self.assertIn(("#", kinds["TESSELLATED_SOLID"][0]), shape[1])
        (link,) = (entities[n][1] for n in kinds["SHAPE_DEFINITION_REPRESENTATION"])
        self.assertEqual(link[1], ("#", kinds["TESSELLATED_SHAPE_REPRESENTATION"][0]))

    def test_faceted_step_shares_each_edge_between_two_faces_that_run_through_it_both_ways(self):
        # Readers mend what is wrong here: the file itself is looked at.
        self.write_all()
        entities = step_entities((self.folder / "out.step").read_text())
        place = {n: tuple(p[1]) for n, (keyword, p) in entities.items() if keyword == "CARTESIAN_POINT"}
        uses, groups = set(), {}
        for keyword, face in entities.values():
            if keyword != "ADVANCED_FACE":
                continue
            ((_, bound),) = face[1]
            corners, ends = [], []
            for _, oriented in entities[entities[bound][1][1][1]][1][1]:
                _, _, _, (_, edge), sense = entities[oriented][1]
                self.assertNotIn((edge, sense), uses)
                uses.add((edge, sense))
                pair = [place[entities[end[1]][1][1][1]] for end in entities[edge][1][1:3]]
                first, last = pair if sense == ".T." else pair[::-1]
                corners.append(first)
                ends.append(last)
            self.assertEqual(ends, corners[1:] + corners[:1])
            groups.setdefault(face[0], []).append(sorted(corners))
        self.assertEqual(len(uses), 3 * self.count)
        expected = {name: sorted(sorted(self.points[i] for i in t) for t in group) for name, group in self.groups.items()}
        self.check_same({name: sorted(group) for name, group in groups.items()}, expected, "triangles")
        self.assertEqual([keyword for keyword, _ in entities.values()].count("MANIFOLD_SOLID_BREP"), 1)

    def test_the_page_needs_nothing_from_outside_and_holds_every_triangle(self):
        self.write_all()
        text = (self.folder / "out.html").read_text()
        self.assertNotRegex(text, r"(?i)https?:|src=|@import|url\(|@[A-Z]+@")
        page = Page(text)
        data = json.loads(page.data)
        words = {name: base64.b64decode(data[name], validate=True) for name in ("points", "normals", "owners", "triangles")}
        triangles = list(struct.iter_unpack("<3I", words["triangles"]))
        points = list(struct.iter_unpack("<3f", words["points"]))
        self.assertEqual((len(triangles), data["names"]), (self.count, list(self.groups)))
        owner = [x // 16 for x, in struct.iter_unpack("<I", words["owners"])]
        self.assertEqual([owner[t[0]] for t in triangles], [i for i, n in enumerate(self.sizes.values()) for _ in range(n)])
        middle = [(min(p[k] for p in self.points) + max(p[k] for p in self.points)) / 2 for k in range(3)]
        for t, expected in zip(triangles, self.triangles):
            for i, q in zip(t, expected):
                for k in range(3):
                    self.assertAlmostEqual(points[i][k] * data["size"] + middle[k], q[k], delta=1e-4)

    def test_the_script_of_the_page_runs(self):
        node = shutil.which("node")
        if not node:
            self.skipTest("node is not installed")
        self.write_all()
        page = Page((self.folder / "out.html").read_text())
        self.write("data.json", page.data)
        self.write("run.js", NODE_STAGE + page.script + "\ndraw();\nprocess.stdout.write(String(drawn));\n")
        done = subprocess.run([node, "run.js"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreaterEqual(int(done.stdout), 3 * self.count)

    def test_the_same_mesh_gives_the_same_bytes(self):
        self.write_all("--threads", 1)
        first = {ending: (self.folder / f"out.{ending}").read_bytes() for ending in ENDINGS}
        self.write_all("--threads", 3)
        for ending in ENDINGS:
            self.check_same((self.folder / f"out.{ending}").read_bytes(), first[ending], ending)

    def test_a_large_faceted_step_is_written_with_a_warning(self):
        done = self.run_program("mesh", sample("flat.step"), "--size", 0.0145, "-o", "out.step", "--report", "r.json")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (0, 1), done.stderr)
        report = self.read_json("r.json")
        self.assertGreater(report["totals"]["topology"]["triangles"], 50000)
        self.assertRegex(done.stderr, r"^geovor: warning: \d+ triangles are many for a faceted \.step; ")
        # Bar: 10,000 triangles in 3 s. Five times as many take a small part of that.
        self.assertLess(report["seconds"]["write"], 3)


# What a browser offers to the page, as far as its script needs it to start and draw once.
NODE_STAGE = """
let drawn = 0;
const stage = new Proxy({}, { get: (_, name) => name === 'drawElements' ? (mode, n) => { drawn += n; }
  : name === 'getShaderParameter' ? () => true : name === 'getAttribLocation' ? () => 0
  : typeof name === 'string' && name === name.toUpperCase() ? 1 : () => ({}) });
const element = { getContext: () => stage, addEventListener: () => {}, style: {}, clientWidth: 800, clientHeight: 600, width: 0, height: 0 };
globalThis.document = { getElementById: id => id === 'data'
  ? { textContent: require('fs').readFileSync('data.json', 'utf8') } : Object.assign({}, element) };
globalThis.window = { addEventListener: () => {}, devicePixelRatio: 1 };
globalThis.requestAnimationFrame = () => {};
"""


class MeshGroups(ProgramTest):
    """Names and colours of the STEP file's faces, under the rules of each format."""

    NAMES = ["top side", "top side", "Bohrung \u00d8", "", "3 mm", "Face1"]
    LINEAR = 0.21404114  # of sRGB's 0.5

    def setUp(self):
        super().setUp()
        names = iter(["top side", "top side", "Bohrung \\X2\\00D8\\X0\\", "", "3 mm", "Face1"])
        faces = []

        def named(match):
            faces.append(match[1])
            return f"#{match[1]}{match[2]}'{next(names, '')}'"

        text = pathlib.Path(sample("plate.step")).read_text()
        text = re.sub(r"#(\d+)(\s*=\s*ADVANCED_FACE\s*\(\s*)'[^']*'", named, text)
        colour = ("#900001=COLOUR_RGB('',1.,0.5,0.);#900002=FILL_AREA_STYLE_COLOUR('',#900001);"
                  "#900003=FILL_AREA_STYLE('',(#900002));#900004=SURFACE_STYLE_FILL_AREA(#900003);"
                  "#900005=SURFACE_SIDE_STYLE('',(#900004));#900006=SURFACE_STYLE_USAGE(.BOTH.,#900005);"
                  "#900007=PRESENTATION_STYLE_ASSIGNMENT((#900006));"
                  f"#900008=STYLED_ITEM('',(#900007),#{faces[2]});"
                  "#900009=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#900008),$);\n")
        at = text.rindex("ENDSEC;")
        self.write("named.step", text[:at] + colour + text[at:])
        outputs = [word for ending in ENDINGS for word in ("-o", f"out.{ending}")]
        self.succeed("mesh", "named.step", "--size", 12, *outputs)

    def text(self, ending):
        return (self.folder / f"out.{ending}").read_bytes().decode(errors="replace")

    def test_names_are_unique_and_in_each_formats_alphabet(self):
        plain = ["top_side_Face1", "top_side_Face2", "Bohrung__", "Face4", "N_3_mm", "Face1"]
        self.assertEqual(re.findall(r"ELSET=(.*)", self.text("inp"))[:6], plain)
        free = ["top side_Face1", "top side_Face2", "Bohrung \u00d8", "Face4", "3 mm", "Face1"]
        self.assertEqual(re.findall(r'^2 \d+ "(.*)"$', self.text("msh"), re.M)[:6], free)
        self.assertEqual([re.sub(" ", "_", name) for name in free], re.findall(r"^g (.*)$", self.text("obj"), re.M)[:6])
        faces = Glb((self.folder / "out.glb").read_bytes()).faces()
        self.assertEqual([face["name"] for face in faces][:6], free)
        self.assertEqual(json.loads(Page(self.text("html")).data)["names"][:6], free)

    def test_colours_reach_glb_ply_vtp_page_and_step(self):
        faces = Glb((self.folder / "out.glb").read_bytes()).faces()
        for found, expected in zip(faces[2]["colour"], (1, self.LINEAR, 0)):
            self.assertAlmostEqual(found, expected, delta=1e-5)
        self.assertNotEqual(faces[0]["colour"], faces[2]["colour"])
        head, _, data = (self.folder / "out.ply").read_bytes().partition(b"end_header\n")
        self.assertIn(b"property uchar green\n", head)
        points = int(re.search(rb"element vertex (\d+)", head)[1])
        rows = struct.iter_unpack("<B4i3B", data[24 * points:])
        self.assertEqual({row[5:] for row in rows if row[4] == 3}, {(255, 128, 0)})
        self.assertEqual(json.loads(Page(self.text("html")).data)["tints"][2], [255, 128, 0])
        self.assertIn('Name="colour"', self.text("vtp"))
        red, green, blue = map(float, re.search(r"=COLOUR_RGB\('',([^,]+),([^,]+),([^,]+)\);", self.text("step")).groups())
        for found, expected in zip((red, green, blue), (1, 0.5, 0)):
            self.assertAlmostEqual(found, expected, delta=1e-5)
        facets = len(re.findall(r"=ADVANCED_FACE\('Bohrung \\X2\\00D8\\X0\\',", self.text("step")))
        self.assertEqual(len(re.findall("=STYLED_ITEM", self.text("step"))), facets)
        self.assertGreater(facets, 0)


if __name__ == "__main__":
    unittest.main()
