"""Each bad use gives one clear line, the exit code, and no output file."""

import pathlib
import unittest

from program import UNREADABLE, UNWRITABLE, USAGE, ProgramTest, sample

# A STEP file that is whole and holds a point, but no face.
FACELESS_STEP = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','2026-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
#1=CARTESIAN_POINT('',(0.,0.,0.));
ENDSEC;
END-ISO-10303-21;
"""


class BadInput(ProgramTest):
    def mesh_fails(self, name, words):
        return self.fail_with(UNREADABLE, words, "mesh", name, "--size", 1, "-o", "out.stl")

    def test_a_missing_file_is_named(self):
        self.mesh_fails("missing.step", "missing.step: ")

    def test_an_empty_path_names_no_file(self):
        self.mesh_fails("", "the path is empty; name a CAD file")

    def test_a_missing_file_is_named_by_info(self):
        self.fail_with(UNREADABLE, "missing.step: ", "info", "missing.step")

    def test_a_missing_file_is_named_by_voronoi(self):
        self.fail_with(UNREADABLE, "missing.step: ", "voronoi", "missing.step", "--count", 5, "-o", "out.json")

    def test_a_text_file_is_no_step_file(self):
        self.mesh_fails(self.write("text.step", "Dear reader,\nthis is no CAD file.\n"), "text.step: ")

    def test_a_text_file_is_no_iges_file(self):
        self.mesh_fails(self.write("text.igs", "Dear reader,\nthis is no CAD file.\n"), "text.igs: ")

    def test_a_text_file_is_no_brep_file(self):
        self.mesh_fails(self.write("text.brep", "Dear reader,\nthis is no CAD file.\n"), "text.brep: ")

    def test_an_empty_file_is_no_step_file(self):
        self.mesh_fails(self.write("empty.step", ""), "empty.step: ")

    def test_a_file_of_bytes_is_no_step_file(self):
        self.mesh_fails(self.write("bytes.step", bytes(range(256)) * 16), "bytes.step: ")

    def test_a_truncated_step_file_is_found_out(self):
        whole = pathlib.Path(sample("plate.step")).read_bytes()
        self.mesh_fails(self.write("cut.step", whole[: len(whole) // 2]), "cut.step: ")

    def test_a_truncated_iges_file_is_found_out(self):
        whole = pathlib.Path(sample("plate.iges")).read_bytes()
        self.mesh_fails(self.write("cut.iges", whole[: len(whole) // 2]), "cut.iges: ")

    def test_a_step_file_without_a_face_is_found_out(self):
        self.mesh_fails(self.write("faceless.step", FACELESS_STEP), "face")

    def test_an_unknown_ending_is_named(self):
        self.mesh_fails(self.write("part.doc", "x"), "part.doc: ")

    def test_a_folder_is_no_cad_file(self):
        (self.folder / "folder.step").mkdir()
        self.mesh_fails("folder.step", "folder.step: ")

    def test_a_line_stays_one_line_whatever_the_files_name(self):
        self.mesh_fails("two\nlines.step", "two lines.step: ")


class BadCommandLine(ProgramTest):
    def mesh_fails(self, words, *arguments):
        return self.fail_with(USAGE, words, "mesh", sample("sphere.step"), *arguments)

    def test_no_command(self):
        self.fail_with(USAGE, "--help")

    def test_an_unknown_command(self):
        self.fail_with(USAGE, "'fly' is no command", "fly")

    def test_an_unknown_flag_is_named(self):
        self.mesh_fails("--colour", "--size", 1, "-o", "out.stl", "--colour", "red")

    def test_step_form_has_two_names(self):
        self.mesh_fails("--step-form: 'brep' won't do; give faceted or tessellated", "--size", 1, "-o", "out.step",
                        "--step-form", "brep")

    def test_a_negative_size(self):
        self.mesh_fails("'-1' won't do; give a number greater than 0", "--size", -1, "-o", "out.stl")

    def test_a_size_of_zero(self):
        self.mesh_fails("--size: '0' won't do", "--size", 0, "-o", "out.stl")

    def test_a_size_that_is_no_number(self):
        self.mesh_fails("--size: 'big' won't do", "--size", "big", "-o", "out.stl")

    def test_a_size_that_is_nan(self):
        self.mesh_fails("--size: 'nan' won't do", "--size", "nan", "-o", "out.stl")

    def test_a_size_that_is_infinite(self):
        self.mesh_fails("--size: 'inf' won't do", "--size", "inf", "-o", "out.stl")

    def test_no_size(self):
        self.mesh_fails("--size is required", "-o", "out.stl")

    def test_a_negative_deflection(self):
        self.mesh_fails("--deflection: '-0.1' won't do", "--size", 1, "--deflection", "-0.1", "-o", "out.stl")

    def test_a_smallest_size_above_the_size(self):
        self.mesh_fails("--min-size", "--size", 1, "--min-size", 2, "-o", "out.stl")

    def test_no_thread(self):
        self.mesh_fails("--threads: '0' won't do", "--size", 1, "--threads", 0, "-o", "out.stl")

    def test_no_output(self):
        self.mesh_fails("--output is required", "--size", 1)

    def test_an_output_of_unknown_ending(self):
        self.mesh_fails("out.doc: the ending '.doc'", "--size", 1, "-o", "out.doc")

    def test_an_output_without_ending(self):
        self.mesh_fails("the ending ''", "--size", 1, "-o", "out")

    def test_one_unknown_ending_among_good_ones(self):
        self.mesh_fails("out.xyz", "--size", 1, "-o", "out.stl", "-o", "out.xyz")

    def test_an_output_given_twice(self):
        self.mesh_fails("given twice", "--size", 1, "-o", "out.stl", "-o", "./out.stl")

    def test_an_output_that_is_the_input(self):
        name = self.write("part.step", pathlib.Path(sample("sphere.step")).read_bytes())
        self.fail_with(USAGE, "is the input itself", "mesh", name, "--size", 1, "-o", name)

    def test_an_output_that_is_the_sizes_file(self):
        name = self.write("sizes.stl", "face,size\n1,2\n")
        self.mesh_fails("is the sizes file", "--size", 5, "--sizes", name, "-o", name)

    def test_a_face_that_is_not_there(self):
        self.mesh_fails("Face2 is not there", "--size", 5, "-o", "out.stl", "--faces", "1-2")

    def test_a_list_of_faces_that_is_none(self):
        self.mesh_fails("sphere.step: 'x' names no face", "--size", 5, "-o", "out.stl", "--faces", "1,x")

    def test_a_face_of_number_zero(self):
        self.mesh_fails("'0' names no face", "--size", 5, "-o", "out.stl", "--faces", "0")

    def test_a_range_of_faces_that_runs_backwards(self):
        self.mesh_fails("write 2-9", "--size", 5, "-o", "out.stl", "--faces", "9-2")

    def test_a_list_of_faces_that_is_empty(self):
        self.mesh_fails("'' names no face", "--size", 5, "-o", "out.stl", "--faces", "")

    def test_a_report_of_another_ending(self):
        self.mesh_fails("report.stl: the ending '.stl'", "--size", 5, "-o", "out.stl", "--report", "report.stl")


class BadOutput(ProgramTest):
    def mesh_fails(self, words, *arguments):
        return self.fail_with(UNWRITABLE, words, "mesh", sample("sphere.step"), "--size", 5, *arguments)

    def test_a_folder_that_does_not_exist(self):
        self.mesh_fails("there is no folder 'missing'", "-o", "missing/out.stl")

    def test_a_folder_in_the_place_of_the_file(self):
        (self.folder / "out.stl").mkdir()
        self.mesh_fails("is a folder", "-o", "out.stl")

    def test_a_file_in_the_place_of_the_folder(self):
        self.write("file", "")
        self.mesh_fails("there is no folder 'file'", "-o", "file/out.stl")

    def test_a_folder_that_nobody_can_write_to(self):
        self.mesh_fails("can't be written", "-o", "/proc/out.stl")

    def test_one_bad_output_among_good_ones_leaves_none(self):
        self.mesh_fails("missing", "-o", "out.stl", "-o", "missing/out.step")

    def test_a_report_in_a_folder_that_does_not_exist(self):
        self.mesh_fails("there is no folder", "-o", "out.stl", "--report", "missing/report.json")


class BadSites(ProgramTest):
    """The face of wave.step is the graph of sin u cos v over [-3,3]^2."""

    def voronoi_fails(self, words, *arguments, model="wave.step"):
        return self.fail_with(USAGE, words, "voronoi", sample(model), "-o", "out.json", *arguments)

    def sites_fail(self, words, text):
        return self.voronoi_fails(words, "--sites", self.write("sites.csv", text))

    def test_neither_sites_nor_a_count(self):
        self.voronoi_fails("give --sites FILE, --count N or --spacing LENGTH")

    def test_both_sites_and_a_count(self):
        self.voronoi_fails("--count", "--sites", "sites.csv", "--count", 3)

    def test_both_a_count_and_a_spacing(self):
        self.voronoi_fails("--spacing", "--count", 3, "--spacing", 1)

    def test_a_negative_spacing(self):
        self.voronoi_fails("--spacing: '-1' won't do", "--spacing", -1)

    def test_a_count_of_zero(self):
        self.voronoi_fails("--count: '0' won't do", "--count", 0)

    def test_a_sizes_file_that_does_not_fit_the_file(self):
        self.write("sizes.csv", "face,size\n# two lines\nnobody,1\n")
        for name, words in (("sizes.csv", "sizes.csv: line 3: no face is named 'nobody'"),
                            ("missing.csv", "missing.csv: the sizes file can't be read"), ("", "--sizes names no file")):
            self.fail_with(USAGE, words, "mesh", sample("wave.step"), "--size", 1, "--sizes", name, "-o", "a.stl")

    def test_a_sites_file_that_is_missing(self):
        self.voronoi_fails("missing.csv", "--sites", "missing.csv")

    def test_a_sites_file_that_is_a_folder(self):
        (self.folder / "sites.csv").mkdir()
        self.voronoi_fails("sites.csv: is a folder", "--sites", "sites.csv")

    def test_an_output_that_is_the_sites_file(self):
        name = self.write("sites.json", "u,v\n0.1,0.2\n")
        self.fail_with(USAGE, "sites.json: is the sites file", "voronoi", sample("wave.step"), "--sites", name,
                       "-o", "./sites.json")
        self.assertEqual((self.folder / name).read_text(), "u,v\n0.1,0.2\n")

    def test_snapping_of_sites_that_are_parameters(self):
        name = self.write("sites.csv", "u,v\n0.1,0.2\n")
        self.voronoi_fails("sites.csv: --snap moves sites in space, and these are u,v", "--sites", name, "--snap")

    def test_a_count_beyond_the_largest(self):
        self.voronoi_fails("'99999999999' won't do; give a whole number from 1 to 2147483647", "--count", 99999999999)

    def test_a_face_that_is_no_number_names_the_file_too(self):
        self.voronoi_fails("wave.step: 'Facex' names no face", "--count", 3, "--face", "Facex")

    def test_a_sites_file_without_header(self):
        self.sites_fail("sites.csv: line 1: the header is missing", "0.1,0.2\n")

    def test_a_sites_file_without_sites(self):
        self.sites_fail("sites.csv: holds no site", "u,v\n# nothing\n")

    def test_a_number_that_is_none(self):
        self.sites_fail("sites.csv: line 3: 'x' is no number", "u,v\n0.1,0.2\n0.3,x\n")

    def test_too_few_numbers(self):
        self.sites_fail("sites.csv: line 2: 1 numbers", "u,v\n0.1\n")

    def test_a_site_that_is_nan(self):
        self.sites_fail("sites.csv: line 2: 'nan' is no number", "u,v\nnan,0\n")

    def test_a_site_outside_the_face(self):
        self.sites_fail("sites.csv: line 3: ", "u,v\n0.1,0.2\n7,0\n")

    def test_a_site_above_the_face(self):
        self.sites_fail("sites.csv: line 2: ", "x,y,z\n0,0,0.5\n")

    def test_two_equal_sites_of_a_hundred_thousand(self):
        rows = [f"{-2.9 + 5.8 * i / 400!r},{-2.9 + 5.8 * k / 250!r}\n" for i in range(400) for k in range(250)]
        self.sites_fail("sites.csv: lines 2 and 100002: ", "u,v\n" + "".join(rows) + rows[0])

    def test_two_equal_sites(self):
        self.sites_fail("sites.csv: lines 2 and 4: ", "u,v\n0.1,0.2\n0.5,0.5\n0.1,0.2\n")

    def test_the_face_must_be_named_where_there_are_several(self):
        self.voronoi_fails("--face", "--count", 3, model="plate.step")

    def test_a_face_that_is_not_there(self):
        self.voronoi_fails("Face2 is not there", "--count", 3, "--face", "Face2")

    def test_an_output_of_unknown_ending(self):
        self.fail_with(USAGE, "out.stl: the ending '.stl'", "voronoi", sample("wave.step"), "--count", 3, "-o", "out.stl")


if __name__ == "__main__":
    unittest.main()
